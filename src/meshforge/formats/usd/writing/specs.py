"""Prims of collision shapes as specs of a layer: a native shape where the space allows it, else a mesh."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from meshforge.formats.numbers import tidy
from meshforge.formats.usd.reading.colliders import COLLISION, DRAWN, MESH_COLLISION
from meshforge.geometry import Box, Capsule, Cylinder, Floats, Ints, Pose, Shape, Sphere

_SHEAR = 1e-9
_EVEN = 1e-9
_NOT_IN_NAMES = re.compile(r"[^\w]+")


@dataclass(frozen=True, eq=False, slots=True)
class Space:
    """The space that a prim is put in: its map (3, 3), (3,) to the root frame in metres."""

    linear: Floats
    offset: Floats

    def to_local(self, points: Floats) -> Floats:
        """Points (n, 3) of the root frame in this space."""
        return np.asarray(np.linalg.solve(self.linear, (points - self.offset).T).T)

    def split_pose(self, pose: Pose) -> tuple[Floats, Floats, Floats] | None:
        """A pose of the root frame here: translation (3,), rotation (3, 3), scales (3,); None where it would shear."""
        linear = np.linalg.solve(self.linear, pose.rotation)
        scales = np.linalg.norm(linear, axis=0)
        turn = linear / scales
        if np.abs(turn.T @ turn - np.eye(3)).max() > _SHEAR:
            return None
        if np.linalg.det(turn) < 0:  # the shapes that ask are symmetric
            turn = turn * np.array([1.0, 1.0, -1.0])
        return self.to_local(pose.translation[None])[0], turn, scales


def new_prim(holder: Any, name: str, kind: str) -> Any:
    """A new prim in a layer below the spec of another one, under a name that no child of it has."""
    from pxr import Sdf

    return Sdf.PrimSpec(holder, name, Sdf.SpecifierDef, kind)


def prim_name(wanted: str, taken: Iterable[str]) -> str:
    """An identifier like the wanted name that is not taken."""
    plain = _NOT_IN_NAMES.sub("_", wanted).strip("_") or "hull"
    if plain[0].isdigit():
        plain = f"_{plain}"
    used, name, number = set(taken), plain, 2
    while name in used:
        name, number = f"{plain}_{number}", number + 1
    return name


def value(spec: Any, name: str, kind: str, default: Any, *, uniform: bool = False) -> None:
    """Author an attribute of a type of `Sdf.ValueTypeNames`."""
    from pxr import Sdf

    variability = Sdf.VariabilityUniform if uniform else Sdf.VariabilityVarying
    attribute = spec.attributes.get(name) or Sdf.AttributeSpec(
        spec, name, getattr(Sdf.ValueTypeNames, kind), variability
    )
    attribute.default = default


def apply_schemas(spec: Any, names: Iterable[str]) -> None:
    """Put applied schemas before those that a spec prepends already."""
    from pxr import Sdf

    old = spec.GetInfo("apiSchemas") if spec.HasInfo("apiSchemas") else Sdf.TokenListOp()
    wanted = [name for name in dict.fromkeys(names) if name not in old.GetAddedOrExplicitItems()]
    if old.isExplicit:
        old.explicitItems = [*old.explicitItems, *wanted]
    else:
        old.prependedItems = [*old.prependedItems, *wanted]
        old.deletedItems = [item for item in old.deletedItems if item not in wanted]
    if wanted:
        spec.SetInfo("apiSchemas", old)


def place(spec: Any, translation: Floats, rotation: Floats | None = None, scales: Floats | None = None) -> None:
    """Author where a prim is, in the order translate, orient, scale; what is none is left out."""
    from pxr import Gf

    order = []
    at = tidy(translation)
    if at.any():
        value(spec, "xformOp:translate", "Double3", Gf.Vec3d(*at.tolist()))
        order.append("xformOp:translate")
    if rotation is not None and not np.array_equal(tidy(rotation), np.eye(3)):
        w, x, y, z = Pose(rotation, np.zeros(3)).to_quaternion().tolist()
        value(spec, "xformOp:orient", "Quatd", Gf.Quatd(w, x, y, z))
        order.append("xformOp:orient")
    if scales is not None and not np.array_equal(scales, np.ones(3)):
        value(spec, "xformOp:scale", "Double3", Gf.Vec3d(*scales.tolist()))
        order.append("xformOp:scale")
    if order:
        value(spec, "xformOpOrder", "TokenArray", order, uniform=True)


def native(holder: Any, name: str, shape: Shape, space: Space) -> Any | None:
    """The prim of a box, sphere, cylinder or capsule; None where USD lacks the shape, or would shear it here."""
    if not isinstance(shape, Box | Sphere | Cylinder | Capsule):
        return None
    found = space.split_pose(shape.pose)
    if found is None:
        return None
    at, turn, scales = found
    even = np.ptp(scales) <= _EVEN * scales.max()
    factor, left = (float(scales.mean()), np.ones(3)) if even else (1.0, scales)
    if isinstance(shape, Box):
        return _cube(new_prim(holder, name, "Cube"), at, turn, 2 * shape.half * (factor * left))
    kind = type(shape).__name__
    spec = new_prim(holder, name, kind)
    place(spec, at, turn, left)
    radius = shape.radius * factor
    value(spec, "radius", "Double", radius)
    half = radius
    if not isinstance(shape, Sphere):
        half = shape.half_length * factor
        value(spec, "height", "Double", 2 * half)
        value(spec, "axis", "Token", "Z", uniform=True)
        half += radius if isinstance(shape, Capsule) else 0.0
    _extent(spec, np.array([-radius, -radius, -half]), np.array([radius, radius, half]))
    return spec


def mesh(holder: Any, name: str, points: Floats, faces: Ints, space: Space) -> Any:
    """The prim of triangles (m, 3) on points (n, 3) of the root frame, about their middle, where floats are finest."""
    from pxr import Vt

    local = space.to_local(points)
    middle = (local.min(axis=0) + local.max(axis=0)) / 2
    spec = new_prim(holder, name, "Mesh")
    place(spec, middle)
    middle = np.where(tidy(middle) == 0, 0.0, middle)
    flipped = np.linalg.det(space.linear) < 0
    corners = np.ascontiguousarray(faces[:, ::-1] if flipped else faces, dtype=np.int32)
    floats = np.ascontiguousarray(local - middle, dtype=np.float32)
    value(spec, "points", "Point3fArray", Vt.Vec3fArray.FromNumpy(floats))
    value(spec, "faceVertexCounts", "IntArray", Vt.IntArray.FromNumpy(np.full(len(corners), 3, dtype=np.int32)))
    value(spec, "faceVertexIndices", "IntArray", Vt.IntArray.FromNumpy(corners.reshape(-1)))
    value(spec, "subdivisionScheme", "Token", "none", uniform=True)
    _extent(spec, floats.min(axis=0), floats.max(axis=0))
    return spec


def collider(spec: Any, approximation: str | None, *, drawn: bool = False) -> None:
    """Make a prim collide, and be hidden unless it is to be drawn; approximation: of a mesh."""
    apply_schemas(spec, [COLLISION, *([MESH_COLLISION] if approximation else [])])
    if approximation:
        value(spec, "physics:approximation", "Token", approximation, uniform=True)
    if drawn:
        spec.SetInfoDictionaryValue("customData", DRAWN, True)
    else:
        value(spec, "purpose", "Token", "guide", uniform=True)


def _cube(spec: Any, at: Floats, turn: Floats, sides: Floats) -> Any:
    even = np.ptp(sides) <= _EVEN * sides.max()
    size, scales = (float(sides.mean()), None) if even else (1.0, sides)
    place(spec, at, turn, scales)
    value(spec, "size", "Double", size)
    _extent(spec, np.full(3, -size / 2), np.full(3, size / 2))
    return spec


def _extent(spec: Any, low: Floats, high: Floats) -> None:
    from pxr import Gf, Vt

    value(spec, "extent", "Float3Array", Vt.Vec3fArray([Gf.Vec3f(*map(float, low)), Gf.Vec3f(*map(float, high))]))
