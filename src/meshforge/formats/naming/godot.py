"""The names by which Godot's importer of scenes knows collision: `leg-convcolonly` is a body with a convex shape."""

from __future__ import annotations

from typing import ClassVar

from meshforge.asset import Geom
from meshforge.formats.naming.base import EngineNames, Names, cleaned
from meshforge.formats.naming.marks import ends_in

_REFUSED = (
    r'[.:@/"%$\x00-\x1f]+'  # what names of Godot's nodes may not have, and `$`, which makes a word count anywhere
)
_MEANT = ("noimp", "rigid", "navmesh", "occ", "occonly", "vehicle", "wheel", "loop", "cycle")


class GodotNames(EngineNames):
    """Nodes that Godot makes a static body of, each with a convex shape, or with triangles."""

    engine: ClassVar[Names] = "godot"
    title: ClassVar[str] = "Godot"

    def body(self, wanted: str) -> str:
        """No word at its end that Godot makes something else of: `front_wheel` would be a wheel of a vehicle."""
        name = cleaned(wanted, _REFUSED)
        return f"{name}-seen" if any(ends_in(name, word) for word in _MEANT) else name

    def hull(self, body: str, geom: Geom, number: int, own: str) -> str:
        return f"{cleaned(own, _REFUSED)}-convcolonly"

    def opaque(self, own: str) -> str:
        return f"{cleaned(own, _REFUSED)}-colonly"
