"""The names by which Unreal and Godot know collision, and our own for Unity, which has none (docs/formats.md)."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import ClassVar

import numpy as np

from meshforge.common import join_names
from meshforge.formats.engine_names.base import (
    CollisionNames,
    EngineName,
    UnrealPrefix,
    clean_name,
    has_godot_word,
    unreal_kind,
)
from meshforge.geometry import Box, Capsule, Pose, Shape, Sphere, polygon_sizes, tight_box, tight_capsule
from meshforge.symbolic import FeatureKind, Geom

_PREFIXES: dict[str, UnrealPrefix] = {"box": "UBX", "sphere": "USP", "capsule": "UCP"}
_ANYWHERE = re.compile(r"UCX|UBX|USP|UCP|MCDCX")  # the FBX importer looks for them anywhere in a name
_REFUSED = r"""["' ,/.:|&!~\\\r\n\t@#(){}\[\]=;^%$`*?<>]+"""  # what names of Unreal's assets may not have
_END = re.compile(r"_(?=[0-9_]*\Z)")

NATIVE_SHAPES = tuple(_PREFIXES)
"""The kinds of shapes, besides hulls, that Unreal makes of a mesh."""

_NEAR = 0.01  # share of its size by which a mesh may differ from the primitive
_EXACT = 1e-5  # that share for a ball, so that a short capsule is none
_ROUND = 0.5  # share of a ball or capsule that its inscribed mesh fills at least; a cube in a ball fills 0.37

_WORDS: dict[str | None, str] = {"UBX": "box", "USP": "sphere", "UCP": "capsule"}


class UnrealNames(CollisionNames):
    """A mesh for each body, and hulls that are called after it."""

    engine: ClassVar[EngineName] = "unreal"
    title: ClassVar[str] = "Unreal"
    holds: ClassVar[frozenset[FeatureKind]] = CollisionNames.holds - {FeatureKind.OPAQUE} | {
        FeatureKind.BOXES,
        FeatureKind.SPHERES,
        FeatureKind.CAPSULES,
    }
    shows: ClassVar[bool] = True
    takes_opaque: ClassVar[bool] = False
    centred: ClassVar[bool] = False  # its older importers take no notice of where a collision node is

    def body(self, wanted: str) -> str:
        """No prefix in it, nor a number at its end: `leg_01` would take the hull `UCX_leg_01` of `leg`."""
        name = _END.sub("", clean_name(wanted, _REFUSED)) or "part"
        return _ANYWHERE.sub(lambda found: found[0].lower(), name)

    def hull(self, body: str, geom: Geom, number: int, own: str) -> str:
        return f"{prefix_of(geom)}_{body}_{number:02}"


def prefix_of(geom: Geom) -> UnrealPrefix:
    """The prefix of a mesh that stands for a shape."""
    return _PREFIXES.get(geom.shape.kind, "UCX")


def next_name(geom: Geom, base: str, names: Iterable[str]) -> str:
    """The name of a new hull of the mesh `base`, with the number after the last of those that there are."""
    taken = [re.fullmatch(rf"U\w\w_{re.escape(base)}_(\d+)", name, re.I) for name in names]
    number = max((int(found[1]) for found in taken if found), default=0) + 1
    return f"{prefix_of(geom)}_{base}_{number:02}"


def interpret_unreal_shape(name: str, hull: Shape) -> tuple[Shape, str | None]:
    """The primitive that the prefix of a name makes of a hull; where it is another shape, the hull and a note."""
    kind = unreal_kind(name)
    made = _MAKERS[kind](hull) if kind in _MAKERS else hull
    return (hull, f"{name!r} is no {_WORDS[kind]}: it is read as a hull") if made is None else (made, None)


def _fit_box(hull: Shape) -> Box | None:
    box = tight_box(hull.vertices)
    return box if hull.volume >= (1 - _NEAR) * box.volume else None


def _fit_sphere(hull: Shape, near: float = _NEAR) -> Sphere | None:
    points = hull.vertices
    # the centre to which all vertices are equally far, by least squares
    centre = np.linalg.lstsq(
        2 * (points[1:] - points[0]), (points[1:] ** 2).sum(1) - (points[0] ** 2).sum(), rcond=None
    )
    distances = np.linalg.norm(points - centre[0], axis=1)
    sphere = Sphere(Pose.of_translation(centre[0]), float(distances.mean()))
    round_ = np.ptp(distances) <= near * sphere.radius and hull.volume >= _ROUND * sphere.volume
    return sphere if round_ else None


def _fit_capsule(hull: Shape) -> Capsule | None:
    capsule = tight_capsule(hull.vertices)
    if not isinstance(capsule, Capsule):
        return None
    local = capsule.pose.inverse().apply(np.asarray(hull.vertices))
    local[:, 2] -= np.clip(local[:, 2], -capsule.half_length, capsule.half_length)
    depth = capsule.radius - np.linalg.norm(local, axis=1)
    round_ = depth.max() <= _NEAR * capsule.radius and hull.volume >= _ROUND * capsule.volume
    return capsule if round_ else None


_MAKERS: dict[str | None, Callable[[Shape], Shape | None]] = {
    "UBX": _fit_box,
    "USP": _fit_sphere,
    "UCP": lambda hull: _fit_sphere(hull, _EXACT) or _fit_capsule(hull) or _fit_sphere(hull),
}


_GODOT_REFUSED = (
    r'[.:@/"%$\x00-\x1f]+'  # what names of Godot's nodes may not have, and `$`, which makes a word count anywhere
)
_GODOT_WORDS = ("noimp", "rigid", "navmesh", "occ", "occonly", "vehicle", "wheel", "loop", "cycle")

_UNITY_REFUSED = r"[/\\\x00-\x1f]+"  # paths of objects are written with slashes
_MOST_UNITY = 255  # vertices, and flat faces, of a convex MeshCollider (docs/engines.md)

COLLIDERS = "_colliders"


class GodotNames(CollisionNames):
    """Nodes that Godot makes a static body of, each with a convex shape, or with triangles."""

    engine: ClassVar[EngineName] = "godot"
    title: ClassVar[str] = "Godot"

    def body(self, wanted: str) -> str:
        """No word at its end that Godot makes something else of: `front_wheel` would be a wheel of a vehicle."""
        name = clean_name(wanted, _GODOT_REFUSED)
        return f"{name}-seen" if any(has_godot_word(name, word) for word in _GODOT_WORDS) else name

    def hull(self, body: str, geom: Geom, number: int, own: str) -> str:
        return f"{clean_name(own, _GODOT_REFUSED)}-convcolonly"

    def opaque(self, own: str) -> str:
        return f"{clean_name(own, _GODOT_REFUSED)}-colonly"


class UnityNames(CollisionNames):
    """Nodes of any name, below one node a body."""

    engine: ClassVar[EngineName] = "unity"
    title: ClassVar[str] = "Unity"

    def body(self, wanted: str) -> str:
        name = clean_name(wanted, _UNITY_REFUSED)
        return f"{name}_part" if holds_colliders(name) else name

    def hull(self, body: str, geom: Geom, number: int, own: str) -> str:
        return self.body(own)

    def holder(self, body: str) -> str:
        return body + COLLIDERS

    def opaque(self, own: str) -> str:
        return self.body(own)

    def notes(self, geoms: Iterable[Geom]) -> tuple[str, ...]:
        large = [geom.name for geom in geoms if _is_large(geom)]
        if not large:
            return ()
        return (
            f"Unity makes partial hulls of more than {_MOST_UNITY} vertices or flat faces: {join_names(large, 3)}; "
            "meshforge check --engine unity --fix makes them simpler",
        )


def _is_large(geom: Geom) -> bool:
    hull = geom.shape.tessellate()
    return len(hull.vertices) > _MOST_UNITY or len(polygon_sizes(hull)) > _MOST_UNITY


def holds_colliders(name: object) -> bool:
    """Whether what lies below a node of this name collides."""
    return isinstance(name, str) and name.lower().endswith(COLLIDERS)
