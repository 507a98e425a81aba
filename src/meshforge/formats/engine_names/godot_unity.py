"""The names by which Godot's importer knows collision (`leg-convcolonly`), and our own for Unity, which has none:
the hulls of a body lie below a node, `table_colliders`, for a script."""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar

from meshforge.common import join_names
from meshforge.formats.engine_names.base import CollisionNames, EngineName, clean_name, has_godot_word
from meshforge.geometry import polygon_sizes
from meshforge.symbolic import Geom

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
