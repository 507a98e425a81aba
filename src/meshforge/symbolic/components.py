"""Connected components of a selection, as the action `Each` takes them."""

from __future__ import annotations

from meshforge.symbolic.mesh import SymbolicMesh


def components(mesh: SymbolicMesh, mask: int) -> list[int]:
    """The connected components of a selection within one body each, as bit sets, in order of their lowest index.

    mask: the selection as a bit set. Hulls outside the selection, or of another body, connect nothing.
    """
    same_body: dict[str, int] = {}
    for index, hull in enumerate(mesh.hulls):
        same_body[hull.body] = same_body.get(hull.body, 0) | 1 << index
    found = []
    while mask:
        seed = mask & -mask
        allowed = mask & same_body[mesh.hulls[seed.bit_length() - 1].body]
        found.append(_reached(mesh.adjacency, seed, allowed))
        mask &= ~found[-1]
    return found


def _reached(adjacency: tuple[int, ...], seed: int, allowed: int) -> int:
    """All positions that can be reached from the seed within those allowed."""
    reached = frontier = seed
    while frontier:
        lowest = frontier & -frontier
        fresh = adjacency[lowest.bit_length() - 1] & allowed & ~reached
        reached |= fresh
        frontier = (frontier ^ lowest) | fresh
    return reached
