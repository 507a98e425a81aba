"""What the names of a game engine are: the marks by which names tell collision, and how bodies and hulls are called."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from typing import ClassVar, Literal

from meshforge.symbolic import PRIMITIVE_FEATURES, FeatureKind, Geom

EngineName = Literal["unreal", "godot", "unity"]
"""The engines whose names for collision can be written."""

UnrealPrefix = Literal["UCX", "UBX", "USP", "UCP"]
GodotSuffix = Literal["col", "convcol", "colonly", "convcolonly"]

_UNREAL = re.compile(r"(UCX|UBX|USP|UCP)_", re.I)  # Unreal's own comparison takes no notice of case
_KINDS: tuple[UnrealPrefix, ...] = ("UCX", "UBX", "USP", "UCP")
_GODOT: tuple[GodotSuffix, ...] = ("colonly", "convcolonly", "col", "convcol")  # in Godot's order
_NUMBER = re.compile(r"[0-9\x00-\x20_.]+\Z")  # what Godot passes over at the end of a name, such as Blender's .001


class CollisionNames(ABC):
    """The names of one engine.

    title: the engine's name for people; holds: what a scene says by them; shows: whether collision counts only where
    its body has a mesh to be seen; takes_opaque: whether a mesh that is no hull can collide as it is; centred: whether
    the mesh of a hull may lie about its own middle, and its node in place.
    """

    engine: ClassVar[EngineName]
    title: ClassVar[str]
    holds: ClassVar[frozenset[FeatureKind]] = frozenset(
        {FeatureKind.NAMES, FeatureKind.VISUALS, FeatureKind.COLORS, FeatureKind.OPAQUE}
    )
    shows: ClassVar[bool] = False
    takes_opaque: ClassVar[bool] = True
    centred: ClassVar[bool] = True

    @abstractmethod
    def body(self, wanted: str) -> str:
        """A name for what is seen of a body, as near to the wanted one as the engine lets it be seen alone."""

    @abstractmethod
    def hull(self, body: str, geom: Geom, number: int, own: str) -> str:
        """The name of a hull; body: the name of its body; number: its place there, from 0; own: the name it had."""

    def holder(self, body: str) -> str | None:
        """The name of a node that holds what collides of a body; None where that lies right below the body's."""
        return None

    def opaque(self, own: str) -> str:
        """The name of a piece that collides with its triangles."""
        raise AssertionError(f"{self.title} takes no such pieces")

    def notes(self, geoms: Iterable[Geom]) -> tuple[str, ...]:
        """What a user should know about hulls that are written for the engine."""
        return ()


def clean_name(name: str, not_taken: str) -> str:
    """A name without characters that an engine changes, and without marks of any; not_taken: a pattern of them."""
    return strip_marks(re.sub(not_taken, "_", name)).strip() or "part"


def fallbacks_of(names: CollisionNames) -> dict[FeatureKind, str]:
    """How a scene has what names do not say."""
    triangles = {what: "written as triangles" for what in PRIMITIVE_FEATURES.values() if what not in names.holds}
    return {**triangles, FeatureKind.BODIES: "written as nodes"}


def unreal_kind(name: str | None) -> UnrealPrefix | None:
    """The prefix by which Unreal takes a node or mesh for collision: hull, box, sphere or capsule."""
    found = _UNREAL.match(name or "")
    return next((kind for kind in _KINDS if found and found[1].upper() == kind), None)


def visible_mesh_of(name: str, meshes: Sequence[str]) -> str:
    """The name of the mesh for which an Unreal collision node stands; meshes: those that there are."""
    rest = _UNREAL.sub("", name, count=1)
    known = [mesh for mesh in meshes if rest == mesh or rest.startswith(f"{mesh}_")]
    return max(known, key=len) if known else re.sub(r"_\d+\Z", "", rest)


def godot_kind(name: str | None) -> GodotSuffix | None:
    """The suffix by which Godot makes collision of a node or mesh: after `-` or `_` at the end, after `$` anywhere."""
    return next((kind for kind in _GODOT if has_godot_word(name or "", kind)), None)


def strip_godot_suffix(name: str) -> str:
    """A name without what Godot makes collision of; the number behind it goes too, as Godot does it."""
    kind = godot_kind(name)
    if kind is None:
        return name
    text = _NUMBER.sub("", name)
    at = text.lower().find(f"${kind}")
    return text[:at] + text[at + 1 + len(kind) :] if at >= 0 else text[: -len(kind) - 1]


def has_godot_word(name: str, word: str) -> bool:
    """Whether Godot takes a word in a name for its own; numbers behind it do not count."""
    text = _NUMBER.sub("", name).lower()
    return f"${word}" in text or text.endswith((f"-{word}", f"_{word}"))


def strip_marks(name: str) -> str:
    """A name without marks of Unreal and Godot."""
    while (bare := strip_godot_suffix(_UNREAL.sub("", name, count=1))) != name:
        name = bare
    return name
