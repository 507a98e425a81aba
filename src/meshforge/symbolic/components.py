"""How a selection falls into parts: by body, and by connected component of the contact graph."""

from __future__ import annotations

from meshforge.symbolic.mesh import SymbolicMesh


def bodies(mesh: SymbolicMesh, mask: int) -> list[int]:
    """The parts of a selection in one body each, as bit sets, in order of their lowest index."""
    parts: dict[str, int] = {}
    for index, hull in enumerate(mesh.hulls):
        if mask >> index & 1:
            parts[hull.body] = parts.get(hull.body, 0) | 1 << index
    return list(parts.values())


def components(mesh: SymbolicMesh, mask: int) -> list[int]:
    """The connected components of a selection within one body each, as bit sets, in order of their lowest index.

    mask: the selection as a bit set. Hulls outside the selection, or of another body, connect nothing.
    """
    found = []
    for part in bodies(mesh, mask):
        while part:
            found.append(_reached(mesh.adjacency, part & -part, part))
            part &= ~found[-1]
    return sorted(found, key=lambda component: component & -component)


def _reached(adjacency: tuple[int, ...], seed: int, allowed: int) -> int:
    """All positions that can be reached from the seed within those allowed."""
    reached = frontier = seed
    while frontier:
        lowest = frontier & -frontier
        fresh = adjacency[lowest.bit_length() - 1] & allowed & ~reached
        reached |= fresh
        frontier = (frontier ^ lowest) | fresh
    return reached
