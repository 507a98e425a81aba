"""The marks by which names tell collision, as readers know them: those of Unreal, of Godot, and ours for Unity."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Literal

Unreal = Literal["UCX", "UBX", "USP", "UCP"]
Godot = Literal["col", "convcol", "colonly", "convcolonly"]
COLLIDERS = "_colliders"

_UNREAL = re.compile(r"(UCX|UBX|USP|UCP)_", re.I)  # Unreal's own comparison takes no notice of case
_KINDS: tuple[Unreal, ...] = ("UCX", "UBX", "USP", "UCP")
_GODOT: tuple[Godot, ...] = ("colonly", "convcolonly", "col", "convcol")  # in Godot's order
_NUMBER = re.compile(r"[0-9\x00-\x20_.]+\Z")  # what Godot passes over at the end of a name, such as Blender's .001


def unreal_kind(name: str | None) -> Unreal | None:
    """The prefix by which Unreal takes a node or mesh for collision: hull, box, sphere or capsule."""
    found = _UNREAL.match(name or "")
    return next((kind for kind in _KINDS if found and found[1].upper() == kind), None)


def render_name(name: str, meshes: Sequence[str]) -> str:
    """The name of the mesh for which an Unreal collision node stands; meshes: those that there are."""
    rest = _UNREAL.sub("", name, count=1)
    known = [mesh for mesh in meshes if rest == mesh or rest.startswith(f"{mesh}_")]
    return max(known, key=len) if known else re.sub(r"_\d+\Z", "", rest)


def godot_kind(name: str | None) -> Godot | None:
    """The suffix by which Godot makes collision of a node or mesh: after `-` or `_` at the end, after `$` anywhere."""
    return next((kind for kind in _GODOT if ends_in(name or "", kind)), None)


def without_suffix(name: str) -> str:
    """A name without what Godot makes collision of; the number behind it goes too, as Godot does it."""
    kind = godot_kind(name)
    if kind is None:
        return name
    text = _NUMBER.sub("", name)
    at = text.lower().find(f"${kind}")
    return text[:at] + text[at + 1 + len(kind) :] if at >= 0 else text[: -len(kind) - 1]


def ends_in(name: str, word: str) -> bool:
    """Whether Godot takes a word in a name for its own; numbers behind it do not count."""
    text = _NUMBER.sub("", name).lower()
    return f"${word}" in text or text.endswith((f"-{word}", f"_{word}"))


def holds_colliders(name: object) -> bool:
    """Whether what lies below a node of this name collides."""
    return isinstance(name, str) and name.lower().endswith(COLLIDERS)


def unmarked(name: str) -> str:
    """A name without marks of Unreal and Godot."""
    while (bare := without_suffix(_UNREAL.sub("", name, count=1))) != name:
        name = bare
    return name
