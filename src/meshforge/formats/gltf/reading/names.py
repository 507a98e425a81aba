"""The names by which Unreal and Godot know collision, and the names of hulls that follow from those of nodes."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Literal

from meshforge.asset import unique_names

Unreal = Literal["UCX", "UBX", "USP", "UCP"]
Godot = Literal["col", "convcol", "colonly", "convcolonly"]

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
    text = _NUMBER.sub("", name or "").lower()
    return next((kind for kind in _GODOT if _has(text, kind)), None)


def without_suffix(name: str) -> str:
    """A name without what Godot makes collision of; the number behind it goes too, as Godot does it."""
    kind = godot_kind(name)
    if kind is None:
        return name
    text = _NUMBER.sub("", name)
    at = text.lower().find(f"${kind}")
    return text[:at] + text[at + 1 + len(kind) :] if at >= 0 else text[: -len(kind) - 1]


def hull_names(sources: Sequence[tuple[str | None, str | None, int]]) -> list[tuple[str, ...]]:
    """The names of the pieces of collision sources; of each its body, its own name, and how many pieces it has.

    `body/name`, without body for None; `geomK` for the K-th source of a body where it has no name; `#k` for one of
    several pieces.
    """
    count: dict[str | None, int] = {}
    bases = []
    for body, name, _ in sources:
        base = name or f"geom{count.get(body, 0)}"
        bases.append(base if body is None else f"{body}/{base}")
        count[body] = count.get(body, 0) + 1
    each = [
        [base] if pieces == 1 else [f"{base}#{k}" for k in range(pieces)]
        for base, (_, _, pieces) in zip(unique_names(bases), sources, strict=True)
    ]
    unique = iter(unique_names(name for names in each for name in names))
    return [tuple(next(unique) for _ in names) for names in each]


def _has(text: str, kind: str) -> bool:
    return f"${kind}" in text or text.endswith((f"-{kind}", f"_{kind}"))
