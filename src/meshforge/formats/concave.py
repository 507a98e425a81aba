"""What a note says of non-convex pieces that go into a file as they are, though engines collide with their hulls."""

from __future__ import annotations

from collections.abc import Sequence
from math import floor

from meshforge.common import GeometryError, join_names, pluralize
from meshforge.geometry import convex_hull, volume_inside
from meshforge.symbolic import Opaque, Surface


def note_hulled(pieces: Sequence[Opaque], engines: str) -> list[str]:
    """A note on pieces of which engines make hulls: which, and the share of its hull that each fills."""
    if not pieces:
        return []
    found = [measure_fill(piece.surface) for piece in pieces if piece.surface]
    shares = sorted({floor(100 * share) for share in found if share is not None})  # as the reader says it
    full = f" ({'% to '.join(map(str, dict.fromkeys((shares[0], shares[-1]))))}% full)" if shares else ""
    which = f"{pluralize(len(pieces), 'non-convex piece')} ({join_names([piece.name for piece in pieces], 3)})"
    each = "each of " * (len(pieces) > 1)
    return [f"{each}{which} is written as it is: {engines} will collide with its hull{full}"]


def measure_fill(surface: Surface) -> float | None:
    """The share of its convex hull that a surface encloses; None where it is open, or its hull has no volume."""
    volume = volume_inside(surface.vertices, surface.faces)
    try:
        return volume and min(1.0, volume / convex_hull(surface.vertices[surface.faces].reshape(-1, 3)).volume)
    except GeometryError:
        return None
