"""The names by which Godot's importer of scenes knows collision: `leg-convcolonly` is a body with a convex shape."""

from __future__ import annotations

import re
from typing import ClassVar, Literal

from meshforge.asset import Geom
from meshforge.formats.naming.base import EngineNames, Names, cleaned

Godot = Literal["col", "convcol", "colonly", "convcolonly"]

_GODOT: tuple[Godot, ...] = ("colonly", "convcolonly", "col", "convcol")  # in Godot's order
_NUMBER = re.compile(r"[0-9\x00-\x20_.]+\Z")  # what Godot passes over at the end of a name, such as Blender's .001
_REFUSED = r'[.:@/"%\x00-\x1f]+'  # what names of Godot's nodes may not have
_MEANT = ("noimp", "rigid", "navmesh", "occ", "occonly", "vehicle", "wheel", "loop", "cycle", *_GODOT)


class GodotNames(EngineNames):
    """Nodes that Godot makes a static body of, each with a convex shape, or with triangles."""

    engine: ClassVar[Names] = "godot"
    title: ClassVar[str] = "Godot"

    def body(self, wanted: str) -> str:
        """No word at its end that Godot makes something else of: `front_wheel` would be a wheel of a vehicle."""
        name = cleaned(wanted, _REFUSED)
        text = _NUMBER.sub("", name).lower()
        return f"{name.replace('$', '_')}-seen" if any(_has(text, word) for word in _MEANT) else name

    def hull(self, body: str, geom: Geom, number: int, own: str) -> str:
        return f"{self._own(own)}-convcolonly"

    def opaque(self, own: str) -> str:
        return f"{self._own(own)}-colonly"

    @staticmethod
    def _own(own: str) -> str:
        return cleaned(without_suffix(own), _REFUSED).replace("$", "_")


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


def _has(text: str, kind: str) -> bool:
    return f"${kind}" in text or text.endswith((f"-{kind}", f"_{kind}"))
