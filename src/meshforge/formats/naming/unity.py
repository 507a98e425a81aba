"""Names for Unity, which has none of its own: the hulls of a body lie below a node, `table_colliders`, for a script."""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar

from meshforge.asset import Geom
from meshforge.formats.naming.base import EngineNames, Names, cleaned
from meshforge.formats.naming.marks import COLLIDERS, holds_colliders
from meshforge.geometry import polygon_sizes
from meshforge.words import listed

_REFUSED = r"[/\\\x00-\x1f]+"  # paths of objects are written with slashes
_MOST = 255  # vertices, and flat faces, of a convex MeshCollider (docs/engines.md)


class UnityNames(EngineNames):
    """Nodes of any name, below one node a body."""

    engine: ClassVar[Names] = "unity"
    title: ClassVar[str] = "Unity"

    def body(self, wanted: str) -> str:
        name = cleaned(wanted, _REFUSED)
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
            f"Unity makes partial hulls of more than {_MOST} vertices or flat faces: {listed(large, 3)}; "
            "meshforge check --engine unity --fix makes them simpler",
        )


def _is_large(geom: Geom) -> bool:
    hull = geom.shape.tessellate()
    return len(hull.vertices) > _MOST or len(polygon_sizes(hull)) > _MOST
