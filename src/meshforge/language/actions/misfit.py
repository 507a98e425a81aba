"""How what an action makes differs from the hulls that it replaces: how far their surfaces are apart, which gaps to
other hulls it narrows, and where it sticks out of the asset."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from meshforge import geometry
from meshforge.geometry import Aabb, Floats, Shape
from meshforge.language.actions.edit import NewShape
from meshforge.language.hull_table import reference_length
from meshforge.symbolic import Hull, SymbolicMesh

STICKS_OUT = 0.02
"""Of the diagonal: what sticks out of the asset by more is a misfit."""
LOST = 0.75
"""Of a gap that counts: what narrows it by more is a misfit."""
_LEAST_GAP = 0.015  # of the diagonal: pieces of a decomposition lie as far as that apart by accident
_PLACES = 1000  # on the surface of a shape, besides its corners

MisfitKind = Literal["sticks out", "grows into", "clearance lost"]


@dataclass(frozen=True, slots=True)
class Misfit:
    """Why a primitive that an action made may be wrong. kind: None for a gap that shrinks a little; hulls: names of the
    one that was made and of the one beside it, if any; share: of the diagonal, how far it sticks out or narrows a gap.
    """

    kind: MisfitKind | None
    text: str
    hulls: tuple[str, ...]
    share: float


class NarrowGap(NamedTuple):
    """A gap to a hull that shapes narrow, from `was` to `now` [m]."""

    was: float
    now: float
    other: Hull

    def describe(self, name: str, verb: str = "shrinks") -> str:
        """Return it in words; name: of what narrows it."""
        return f"the gap between {name} and {self.other.name} {verb} from {self.was:.3g} m to {self.now:.3g} m"


def find_narrow_gaps(
    shapes: Sequence[Shape], sources: Sequence[Hull], beside: Sequence[Hull], contact_distance: float
) -> list[NarrowGap]:
    """Return the gaps that shapes narrow in the place of hulls, by more than a tenth and by more than the contact
    distance [m]; gaps wider than the shapes are large do not count. beside: the hulls to which there may be gaps."""
    if not beside:
        return []
    box = Aabb.union(shape.aabb for shape in shapes)
    low, high = geometry.bounds([hull.aabb for hull in beside])
    apart = np.maximum(low - box.max, box.min - high).max(axis=1)
    near = [beside[k] for k in np.flatnonzero(apart < box.diagonal).tolist()]
    first = len(shapes) + len(sources)
    everything = [*shapes, *(hull.shape for hull in (*sources, *near))]
    pairs = geometry.close_pairs(everything, box.diagonal, frozenset(range(first, len(everything))))
    found = []
    for k, hull in enumerate(near, first):
        was = min(pairs.get((j, k), box.diagonal) for j in range(len(shapes), first))
        now = min(pairs.get((j, k), box.diagonal) for j in range(len(shapes)))
        if was - now > max(was / 10, contact_distance):
            found.append(NarrowGap(was, now, hull))
    return sorted(found, key=lambda gap: gap.now - gap.was)


def find_misfits(mesh: SymbolicMesh, selected_mask: int, made: Sequence[tuple[Hull, NewShape]]) -> tuple[Misfit, ...]:
    """Return how primitives that an action made of selected hulls misfit, the worst first, gaps to hulls that were not
    selected among it."""
    made = [(new, one) for new, one in made if new.primitive]
    beside = [hull for k, hull in enumerate(mesh.hulls) if not selected_mask >> k & 1] if made else []
    found, length = list[Misfit](), reference_length(mesh)
    for new, one in made:
        name = (new.keeps_name and new.parent) or new.name
        beyond = _measure_out(new.shape, one.sources, mesh, length)
        if beyond > STICKS_OUT * length:
            text = f"{name} sticks out of the asset by {beyond:.3g} m"
            found.append(Misfit("sticks out", text, (new.name,), beyond / length))
        for gap in find_narrow_gaps([new.shape], one.sources, beside, mesh.contact_distance):
            is_lost = gap.was > _LEAST_GAP * length and gap.now <= (1 - LOST) * gap.was
            kind: MisfitKind = "grows into" if gap.now <= mesh.contact_distance else "clearance lost"
            hulls, share = (new.name, gap.other.name), (gap.was - gap.now) / length
            found.append(Misfit(kind if is_lost else None, gap.describe(name), hulls, share))
    return tuple(sorted(found, key=lambda one: -one.share))


def describe_misfits(misfits: Sequence[Misfit]) -> list[str]:
    """Return a sentence on what sticks out, and one on gaps, as far as there is any: the worst, and how many more."""
    sides = [[one.text for one in misfits if (one.kind == "sticks out") is is_out] for is_out in (True, False)]
    return [f"{one[0]}{f' (and {len(one) - 1} more)' if len(one) > 1 else ''}" for one in sides if one]


def _measure_out(shape: Shape, sources: Sequence[Hull], mesh: SymbolicMesh, length: float) -> float:
    """How far [m] a shape reaches over the convex hull of a mesh and of the box around the hulls that it replaces; 0
    for a box, and where it hardly reaches over that box; length: L of the run [m]."""
    least = STICKS_OUT * length
    box = Aabb.union(hull.aabb for hull in sources)
    if shape.kind == "box" or bool(((shape.aabb.min >= box.min - least) & (shape.aabb.max <= box.max + least)).all()):
        return 0.0
    points = np.concatenate([box.corners, *(hull.vertices for hull in mesh.hulls)])
    around = geometry.convex_hull(points, thicken=geometry.FLATNESS * length)
    return float(geometry.heights_above(shape.vertices, around).max())


def measure_mismatch(one: Sequence[Shape], other: Sequence[Shape]) -> float:
    """Return how far [m] the outer surface of either of two unions of convex shapes is from the other at most, at the
    corners and a thousand places of each shape; what lies inside the other is no distance from it."""
    return max(_measure_beyond(one, other), _measure_beyond(other, one))


def _measure_beyond(shapes: Sequence[Shape], others: Sequence[Shape]) -> float:
    farthest = 0.0
    for k, shape in enumerate(shapes):
        places, _ = geometry.sample_surface(shape.vertices, shape.faces, _PLACES)
        points = np.concatenate([shape.vertices, places])
        for other in (*shapes[:k], *shapes[k + 1 :]):
            points = points[geometry.heights_above(points, other) > -1e-9 * other.aabb.diagonal]
        farthest = max(farthest, float(_distances(points, others).max(initial=0.0)))
    return farthest


def _distances(points: Floats, shapes: Sequence[Shape]) -> Floats:
    """Distances (n,) [m] of points (n, 3) from a union of convex shapes, 0 inside."""
    found = np.full(len(points), np.inf)
    for shape in shapes:
        heights, corners = geometry.heights_above(points, shape), shape.vertices[shape.faces]
        found[heights <= 0] = 0.0
        near = np.flatnonzero(heights < found)  # a height is at most the distance
        for part in np.array_split(near, len(near) // 100 + 1):
            pairs = np.repeat(points[part], len(corners), axis=0)
            places = geometry.nearest_on_triangles(pairs, np.tile(corners, (len(part), 1, 1)))
            lengths = np.linalg.norm(places - pairs, axis=1).reshape(-1, len(corners))
            found[part] = np.minimum(found[part], lengths.min(axis=1))
    return found
