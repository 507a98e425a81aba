"""Hulls as rows of a list."""

from __future__ import annotations

from typing import cast

from meshforge.studio.wire.asset import HullView, Kind
from meshforge.symbolic import Hull, SymbolicMesh


def hull_view(hull: Hull) -> HullView:
    """A hull; vertices and faces of a round primitive are those of its tessellation."""
    return HullView(
        name=hull.name,
        body=hull.body,
        label=hull.label,
        confidence=hull.confidence,
        source=hull.source,
        volume=hull.volume,
        vertices=len(hull.vertices),
        faces=len(hull.faces),
        primitive=cast(Kind, hull.shape.kind) if hull.shape.is_primitive else None,
        parent=hull.parent,
    )


def hull_views(mesh: SymbolicMesh) -> tuple[HullView, ...]:
    """All hulls of a mesh, in their order."""
    return tuple(map(hull_view, mesh.hulls))


def contact_names(mesh: SymbolicMesh) -> tuple[tuple[str, str], ...]:
    """The pairs of hulls in contact, by name, in the order of the hulls."""
    return tuple((mesh.hulls[i].name, mesh.hulls[j].name) for i, j in sorted(mesh.contacts))
