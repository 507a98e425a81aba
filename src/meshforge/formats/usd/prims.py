"""Prims as specs of a layer: shapes, meshes and masses, in the space that they are put in."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from meshforge import geometry
from meshforge.formats.collision_pieces import leaves_volume
from meshforge.formats.kinematic_tree import claim_name, drop_rounding
from meshforge.formats.libraries import pxr
from meshforge.formats.usd.colliders import (
    COLLISION,
    DRAWN,
    FILTERED,
    LABELS,
    LABELS_SCHEMA,
    MESH_COLLISION,
    apply_schemas,
)
from meshforge.formats.usd.stage import UsdStage, rotation_of
from meshforge.geometry import Box, Capsule, Cylinder, Floats, Ints, Pose, Shape, Sphere, principal_axes
from meshforge.symbolic import Inertial

_EVEN = 1e-9
_NOT_IN_NAMES = re.compile(r"[^\w]+")


@dataclass(frozen=True, eq=False, slots=True)
class PrimSpace:
    """The space that a prim is put in: its map (3, 3), (3,) to the root frame in metres."""

    linear: Floats
    offset: Floats

    @classmethod
    def of(cls, scene: UsdStage, prim: Any) -> Self:
        """Return the space of a prim of a stage."""
        return cls(*scene.placement(prim))

    def holds_volume(self) -> bool:
        """Return whether what is put into it keeps its volume."""
        is_finite = bool(np.isfinite(self.linear).all() and np.isfinite(self.offset).all())
        return is_finite and leaves_volume(self.linear, 1e-9)

    def to_local(self, points: Floats) -> Floats:
        """Return points (n, 3) of the root frame in this space."""
        return np.asarray(np.linalg.solve(self.linear, (points - self.offset).T).T)

    def split_pose(self, pose: Pose) -> tuple[Floats, Floats, Floats] | None:
        """Return a pose of the root frame here: translation (3,), rotation (3, 3), scales (3,); None if sheared."""
        linear = np.asarray(np.linalg.solve(self.linear, pose.rotation), dtype=np.float64)
        split = geometry.split_scaled_rotation(linear)
        return (self.to_local(pose.translation[None])[0], *split) if split else None


def add_prim(holder: Any, name: str, kind: str) -> Any:
    """Return a new prim in a layer below the spec of another one, under a name that no child of it has."""
    return pxr.Sdf.PrimSpec(holder, name, pxr.Sdf.SpecifierDef, kind)


def prim_name(wanted: str) -> str:
    """Return an identifier like the wanted name."""
    plain = _NOT_IN_NAMES.sub("_", wanted).strip("_") or "hull"
    return f"_{plain}" if plain[0].isdigit() else plain


def free_prim_name(holder: Any, wanted: str, stage: Any = None) -> str:
    """Return an identifier like the wanted name that no child of a spec has, nor of its prim in a stage."""
    prim = stage.GetPrimAtPath(holder.path) if stage else None
    taken = {child.GetName() for child in prim.GetAllChildren()} if prim else set()
    return claim_name(prim_name(wanted), {*taken, *(child.name for child in holder.nameChildren)})


def set_value(spec: Any, name: str, kind: str, default: Any, *, uniform: bool = False) -> None:
    """Author an attribute of a type of `Sdf.ValueTypeNames`."""
    variability = pxr.Sdf.VariabilityUniform if uniform else pxr.Sdf.VariabilityVarying
    value_type = getattr(pxr.Sdf.ValueTypeNames, kind)
    attribute = spec.attributes.get(name) or pxr.Sdf.AttributeSpec(spec, name, value_type, variability)
    attribute.default = default


def set_place(spec: Any, translation: Floats, rotation: Floats | None = None, scales: Floats | None = None) -> None:
    """Author where a prim is, in the order translate, orient, scale; what is none is left out."""
    order = []
    at = drop_rounding(translation)
    if at.any():
        set_value(spec, "xformOp:translate", "Double3", pxr.Gf.Vec3d(*at.tolist()))
        order.append("xformOp:translate")
    if rotation is not None and not np.array_equal(drop_rounding(rotation), np.eye(3)):
        w, x, y, z = Pose(rotation, np.zeros(3)).to_quaternion().tolist()
        set_value(spec, "xformOp:orient", "Quatd", pxr.Gf.Quatd(w, x, y, z))
        order.append("xformOp:orient")
    if scales is not None and not np.array_equal(scales, np.ones(3)):
        set_value(spec, "xformOp:scale", "Double3", pxr.Gf.Vec3d(*scales.tolist()))
        order.append("xformOp:scale")
    if order:
        set_value(spec, "xformOpOrder", "TokenArray", order, uniform=True)


def add_shape(holder: Any, name: str, shape: Shape, space: PrimSpace) -> tuple[Any, str | None]:
    """Add the prim of a shape; return it, and the approximation by which it collides where it is a mesh."""
    spec = _add_native(holder, name, shape, space)
    if spec is not None:
        return spec, None
    return add_mesh(holder, name, np.asarray(shape.vertices), shape.faces, space), "convexHull"


def add_plane(holder: Any, name: str, translation: Floats, rotation: Floats) -> Any:
    """Return the prim of an endless plane."""
    spec = add_prim(holder, name, "Plane")
    set_place(spec, translation, rotation)
    return spec


def _add_native(holder: Any, name: str, shape: Shape, space: PrimSpace) -> Any:
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
        return _add_cube(add_prim(holder, name, "Cube"), at, turn, 2 * shape.half * (factor * left))
    spec = add_prim(holder, name, type(shape).__name__)
    set_place(spec, at, turn, left)
    radius = shape.radius * factor
    set_value(spec, "radius", "Double", radius)
    half = radius
    if not isinstance(shape, Sphere):
        half = shape.half_length * factor
        set_value(spec, "height", "Double", 2 * half)
        set_value(spec, "axis", "Token", "Z", uniform=True)
        half += radius if isinstance(shape, Capsule) else 0.0
    _set_extent(spec, np.array([-radius, -radius, -half]), np.array([radius, radius, half]))
    return spec


def add_mesh(holder: Any, name: str, points: Floats, faces: Ints, space: PrimSpace) -> Any:
    """Return the prim of triangles (m, 3) on points (n, 3) about their middle, where floats are finest."""
    local = space.to_local(points)
    middle = (local.min(axis=0) + local.max(axis=0)) / 2
    spec = add_prim(holder, name, "Mesh")
    set_place(spec, middle)
    middle = np.where(drop_rounding(middle) == 0, 0.0, middle)
    is_mirrored = np.linalg.det(space.linear) < 0
    corners = np.ascontiguousarray(faces[:, ::-1] if is_mirrored else faces, dtype=np.int32)
    floats = np.ascontiguousarray(local - middle, dtype=np.float32)
    set_value(spec, "points", "Point3fArray", pxr.Vt.Vec3fArray.FromNumpy(floats))
    set_value(spec, "faceVertexCounts", "IntArray", pxr.Vt.IntArray.FromNumpy(np.full(len(corners), 3, dtype=np.int32)))
    set_value(spec, "faceVertexIndices", "IntArray", pxr.Vt.IntArray.FromNumpy(corners.reshape(-1)))
    set_value(spec, "subdivisionScheme", "Token", "none", uniform=True)
    _set_extent(spec, floats.min(axis=0), floats.max(axis=0))
    return spec


def mark_collider(spec: Any, approximation: str | None, *, drawn: bool = False) -> None:
    """Make a prim collide, and be hidden unless it is to be drawn; approximation: of a mesh."""
    add_collision(spec, approximation)
    if drawn:
        spec.SetInfoDictionaryValue("customData", DRAWN, True)
    else:
        set_value(spec, "purpose", "Token", "guide", uniform=True)


def set_labels(spec: Any, labels: Iterable[str]) -> None:
    """Say what a prim is, by the taxonomy `class`; empty labels are none."""
    if own := [*dict.fromkeys(filter(None, labels))]:
        apply_schemas(spec, [f"{LABELS_SCHEMA}class"])
        set_value(spec, f"{LABELS}class", "TokenArray", own)


def filter_pair(spec: Any, other: Any) -> None:
    """Keep a body from colliding with another one; other: its path."""
    apply_schemas(spec, ["PhysicsFilteredPairsAPI"])
    own = spec.relationships.get(FILTERED) or pxr.Sdf.RelationshipSpec(spec, FILTERED, False)
    own.targetPathList.Append(other)


def add_collision(spec: Any, approximation: str | None) -> None:
    """Make a prim collide; approximation: of a mesh, None for other shapes."""
    apply_schemas(spec, [COLLISION, *([MESH_COLLISION] if approximation else [])])
    if approximation:
        set_value(spec, "physics:approximation", "Token", approximation, uniform=True)


def _add_cube(spec: Any, at: Floats, turn: Floats, sides: Floats) -> Any:
    even = np.ptp(sides) <= _EVEN * sides.max()
    size, scales = (float(sides.mean()), None) if even else (1.0, sides)
    set_place(spec, at, turn, scales)
    set_value(spec, "size", "Double", size)
    _set_extent(spec, np.full(3, -size / 2), np.full(3, size / 2))
    return spec


def _set_extent(spec: Any, low: Floats, high: Floats) -> None:
    ends = [pxr.Gf.Vec3f(*map(float, end)) for end in (low, high)]
    set_value(spec, "extent", "Float3Array", pxr.Vt.Vec3fArray(ends))


def write_mass(spec: Any, inertial: Inertial, body: PrimSpace, metres: float = 1.0, kilograms: float = 1.0) -> None:
    """Write a mass on the prim of a body, in its own space and in the units of the stage: so many [m], [kg]."""
    centre = drop_rounding(body.to_local(inertial.centre[None])[0], 1.0)
    turn = rotation_of(body.linear).T
    moments, axes = principal_axes(drop_rounding(turn @ inertial.inertia @ turn.T))
    moments = moments / (kilograms * metres**2)
    apply_schemas(spec, ["PhysicsMassAPI"])
    set_value(spec, "physics:mass", "Float", inertial.mass / kilograms)
    set_value(spec, "physics:centerOfMass", "Point3f", pxr.Gf.Vec3f(*centre.tolist()))
    if moments.min() > 0:
        w, x, y, z = Pose(axes, np.zeros(3)).to_quaternion().tolist()
        set_value(spec, "physics:diagonalInertia", "Float3", pxr.Gf.Vec3f(*moments.tolist()))
        set_value(spec, "physics:principalAxes", "Quatf", pxr.Gf.Quatf(w, x, y, z))
