"""The names by which Unreal and Godot know collision, and our own for Unity, which has none (docs/formats.md): the
marks that tell collision, and how bodies and hulls are called."""

import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import count
from typing import ClassVar, Literal

import numpy as np

from meshforge.geometry import Box, Capsule, Pose, Shape, Sphere, tight_box, tight_capsule
from meshforge.symbolic import PRIMITIVE_FEATURES, FeatureKind, Geom

EngineName = Literal["unreal", "godot", "unity"]
"""The engines whose names for collision can be written."""
MarkName = Literal["unreal", "godot", "unity", "khr", "usd"]
"""How collision can be marked: by the names of an engine, by KHR_physics_rigid_bodies, or by UsdPhysics."""

UnrealPrefix = Literal["UCX", "UBX", "USP", "UCP"]
GodotSuffix = Literal["col", "convcol", "colonly", "convcolonly"]

_UNREAL = re.compile(r"(UCX|UBX|USP|UCP)_", re.I)  # Unreal's own comparison takes no notice of case
_KINDS: tuple[UnrealPrefix, ...] = ("UCX", "UBX", "USP", "UCP")
_GODOT: tuple[GodotSuffix, ...] = ("colonly", "convcolonly", "col", "convcol")  # in Godot's order
_NUMBER = re.compile(r"[0-9\x00-\x20_.]+\Z")  # what Godot passes over at the end of a name, such as Blender's .001


class CollisionNames(ABC):
    """The names of one engine.

    title: the engine's name for people; holds: what a scene says by them; shows: whether collision counts only where
    its body has a mesh to be seen; takes_opaque: whether a mesh that is no hull can collide as it is; in_bodies:
    whether names of hulls are read as those below their body.
    """

    engine: ClassVar[EngineName]
    title: ClassVar[str]
    holds: ClassVar[frozenset[FeatureKind]] = frozenset(
        {FeatureKind.NAMES, FeatureKind.VISUALS, FeatureKind.COLORS, FeatureKind.NON_CONVEX}
    )
    shows: ClassVar[bool] = False
    takes_non_convex: ClassVar[bool] = True
    in_bodies: ClassVar[bool] = False

    @abstractmethod
    def body(self, wanted: str) -> str:
        """Return a name for what is seen of a body, as near to the wanted one as the engine lets it be seen alone."""

    def hull(self, own: str) -> str:
        """Return the name of a hull, which had another one."""
        return self.body(own)

    def non_convex(self, own: str) -> str:
        """Return the name of a piece that collides with its triangles."""
        return self.body(own)


def clean_name(name: str, not_taken: str) -> str:
    """Return a name without marks of engines and characters that one changes; not_taken: a pattern of these."""
    name = re.sub(not_taken, "_", name)
    while (bare := strip_godot_suffix(_UNREAL.sub("", name, count=1))) != name:
        name = bare
    return name.strip() or "part"


def fallbacks_of(names: CollisionNames) -> dict[FeatureKind, str]:
    """Return how a scene has what names do not say."""
    triangles = {what: "written as triangles" for what in PRIMITIVE_FEATURES.values() if what not in names.holds}
    return triangles if FeatureKind.BODIES in names.holds else {**triangles, FeatureKind.BODIES: "written as nodes"}


def unreal_kind(name: str | None) -> UnrealPrefix | None:
    """Return the prefix by which Unreal takes a node or mesh for collision: hull, box, sphere or capsule."""
    found = _UNREAL.match(name or "")
    return next((kind for kind in _KINDS if found and found[1].upper() == kind), None)


def visible_mesh_of(name: str, meshes: Sequence[str]) -> str:
    """Return the name of the mesh for which an Unreal collision node stands; meshes: those that there are."""
    rest = _UNREAL.sub("", name, count=1)
    known = [mesh for mesh in meshes if rest == mesh or rest.startswith(f"{mesh}_")]
    return max(known, key=len) if known else re.sub(r"_\d+\Z", "", rest)


def godot_kind(name: str | None) -> GodotSuffix | None:
    """Return the suffix by which Godot makes collision of a node or mesh: after `-` or `_` at the end, or after `$`."""
    return next((kind for kind in _GODOT if has_godot_word(name or "", kind)), None)


def strip_godot_suffix(name: str) -> str:
    """Return a name without what Godot makes collision of; the number behind it goes too, as Godot does it."""
    kind = godot_kind(name)
    if kind is None:
        return name
    text = _NUMBER.sub("", name)
    at = text.lower().find(f"${kind}")
    return text[:at] + text[at + 1 + len(kind) :] if at >= 0 else text[: -len(kind) - 1]


def has_godot_word(name: str, word: str) -> bool:
    """Return whether Godot takes a word in a name for its own; numbers behind it do not count."""
    text = _NUMBER.sub("", name).lower()
    return f"${word}" in text or text.endswith((f"-{word}", f"_{word}"))


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
    holds: ClassVar[frozenset[FeatureKind]] = CollisionNames.holds - {FeatureKind.NON_CONVEX} | {
        *(FeatureKind.BOXES, FeatureKind.SPHERES, FeatureKind.CAPSULES)
    }
    shows: ClassVar[bool] = True
    takes_non_convex: ClassVar[bool] = False

    def body(self, wanted: str) -> str:
        """Return no prefix in it, nor a number at its end: `leg_01` would take the hull `UCX_leg_01` of `leg`."""
        name = _END.sub("", clean_name(wanted, _REFUSED)) or "part"
        return _ANYWHERE.sub(lambda found: found[0].lower(), name)


def unreal_hull(body: str, geom: Geom, number: int) -> str:
    """Return the name of a hull of a mesh, which is called as the body; number: its place there, from 0."""
    return f"{_PREFIXES.get(geom.shape.kind, 'UCX')}_{body}_{number:02}"


def number_hulls(base: str, names: Iterable[str]) -> Iterator[int]:
    """Return the numbers for new hulls of the mesh `base`, after the last of those that there are."""
    taken = [re.fullmatch(rf"U\w\w_{re.escape(base)}_(\d+)", name, re.I) for name in names]
    return count(max((int(found[1]) for found in taken if found), default=-1) + 1)


def interpret_unreal_shape(name: str, hull: Shape) -> tuple[Shape, str | None]:
    """Return the primitive that the prefix of a name makes of a hull; of another shape the hull, and a note."""
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

COLLIDERS = "_colliders"


class GodotNames(CollisionNames):
    """Nodes that Godot makes a static body of, each with a convex shape, or with triangles."""

    engine: ClassVar[EngineName] = "godot"
    title: ClassVar[str] = "Godot"
    holds: ClassVar[frozenset[FeatureKind]] = CollisionNames.holds | {FeatureKind.BODIES, FeatureKind.MASSES}

    def body(self, wanted: str) -> str:
        """Return no word at its end that Godot makes something else of: `front_wheel` would be a wheel of a vehicle."""
        name = clean_name(wanted, _GODOT_REFUSED)
        return f"{name}-seen" if any(has_godot_word(name, word) for word in _GODOT_WORDS) else name

    def hull(self, own: str) -> str:
        base, tilde, made = own.partition("~")
        return f"{clean_name(base, _GODOT_REFUSED)}{tilde}{made}-convcolonly"

    def non_convex(self, own: str) -> str:
        return f"{clean_name(own, _GODOT_REFUSED)}-colonly"


class GodotBodyNames(GodotNames):
    """Nodes of bodies that move: extensions say what collides, so that no name makes a static body of a node."""

    in_bodies: ClassVar[bool] = True


class UnityNames(CollisionNames):
    """Nodes of any name, below one node a body."""

    engine: ClassVar[EngineName] = "unity"
    title: ClassVar[str] = "Unity"

    def body(self, wanted: str) -> str:
        name = clean_name(wanted, _UNITY_REFUSED)
        return f"{name}_part" if holds_colliders(name) else name


def holds_colliders(name: object) -> bool:
    """Return whether what lies below a node of this name collides."""
    return isinstance(name, str) and name.lower().endswith(COLLIDERS)
