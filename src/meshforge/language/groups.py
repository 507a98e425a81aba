"""How a selection falls into parts: by body, and by connected component of the contact graph."""

from __future__ import annotations

from meshforge.symbolic import SymbolicMesh


def bodies(mesh: SymbolicMesh, mask: int) -> list[int]:
    """The parts of a selection in one body each, as bit sets, in order of their first hull."""
    parts: dict[str, int] = {}
    for index, hull in enumerate(mesh.hulls):
        if mask >> index & 1:
            parts[hull.body] = parts.get(hull.body, 0) | 1 << index
    return list(parts.values())


def components(mesh: SymbolicMesh, mask: int) -> list[int]:
    """The connected components of a selection within one body each, as bit sets, in order of their first hull.

    Connected are hulls in contact; a chain of contacts through hulls outside the selection, or of another body,
    connects nothing.
    """
    found = [part for body in bodies(mesh, mask) for part in _connected(mesh.adjacency, body)]
    return sorted(found, key=lambda part: part & -part)


def _connected(adjacency: tuple[int, ...], mask: int) -> list[int]:
    parts = []
    while mask:
        part = frontier = mask & -mask
        while frontier:
            low = frontier & -frontier
            fresh = adjacency[low.bit_length() - 1] & mask & ~part
            part |= fresh
            frontier = (frontier | fresh) ^ low
        parts.append(part)
        mask &= ~part
    return parts
