"""The parts of a surface whose boundaries are known, from names: a part for each triangle;
parts that are too small, or that bound a hollow, joined with those that they touch."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.common import join_names
from meshforge.geometry.arrays import Bools, Floats, Ints, freeze_ints
from meshforge.geometry.connectivity import component_roots, weld
from meshforge.geometry.decomposition.triangles import TriangleMesh, cap_holes
from meshforge.geometry.shape import volume_and_centroid
from meshforge.geometry.surface import is_closed

_TINY = 1e-3  # of the diagonal of the surface: a part that reaches no farther is none
_FEW = 2  # triangles that are no part of their own where they touch another one
_HOLLOW = 1e-6  # of the volume of its box: below, a part encloses nothing


@dataclass(frozen=True, eq=False, slots=True)
class SurfaceParts:
    """of_face: (m,) the part of each triangle; names: those of the parts, which may repeat."""

    of_face: Ints
    names: tuple[str, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "of_face", freeze_ints(self.of_face, (-1,)))

    @property
    def numbers(self) -> list[int]:
        """The parts that have triangles, in the order of their numbers."""
        return [int(k) for k in np.unique(self.of_face)]

    @property
    def is_divided(self) -> bool:
        """Whether there are two parts at least, so that there is a boundary."""
        return len(self.of_face) > 0 and bool((self.of_face != self.of_face[0]).any())

    def select(self, faces: Ints) -> "SurfaceParts":
        """Return the parts of some triangles (k,), by their places."""
        return SurfaceParts(self.of_face[faces], self.names)


def stack_parts(found: Sequence[SurfaceParts]) -> SurfaceParts:
    """Return the parts of surfaces one after the other; parts of different surfaces stay apart."""
    starts = np.cumsum([0, *(len(parts.names) for parts in found)])
    numbers = [parts.of_face + start for parts, start in zip(found, starts, strict=False)]
    names = tuple(name for parts in found for name in parts.names)
    return SurfaceParts(np.concatenate(numbers) if numbers else np.zeros(0, dtype=np.int64), names)


def join_small_parts(
    vertices: Floats, faces: Ints, parts: SurfaceParts, note: Callable[[str], None] = lambda _: None
) -> SurfaceParts:
    """Return the parts of vertices (n, 3) and faces (m, 3), small ones joined with the one that they touch most.

    Small is what reaches no farther than a thousandth of the diagonal, or has two triangles at most; and, of a closed
    surface, what bounds a hollow of it: its triangles would be taken for a solid where there is none. A part that
    touches no other stays. note: called with the names of those that were joined.
    """
    corners = weld(vertices)[faces]
    numbers = parts.numbers
    places = np.searchsorted(numbers, parts.of_face)
    small = _find_small(vertices, faces, places, len(numbers)) | _find_hollow(vertices, corners, places, len(numbers))
    home = _find_homes(_count_contacts(corners, places, len(numbers)), small, np.bincount(places))
    if gone := [parts.names[numbers[k]] for k in np.flatnonzero(home != np.arange(len(numbers)))]:
        names = join_names(list(dict.fromkeys(gone)), 3)
        note(f"too small for parts of their own, or the inside of one, so joined with what they touch: {names}")
    return SurfaceParts(np.asarray(numbers)[home[places]], parts.names)


def _find_small(vertices: Floats, faces: Ints, places: Ints, count: int) -> Bools:
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    corners = vertices[faces]
    np.minimum.at(low, places, corners.min(axis=1))
    np.maximum.at(high, places, corners.max(axis=1))
    reach = np.linalg.norm(high - low, axis=1)
    diagonal = float(np.linalg.norm(high.max(axis=0) - low.min(axis=0)))
    small: Bools = (reach <= _TINY * diagonal) | (np.bincount(places, minlength=count) <= _FEW)
    return small


def _find_hollow(vertices: Floats, corners: Ints, places: Ints, count: int) -> Bools:
    """Which parts (count,) of a closed surface enclose, once their holes are capped, what the surface leaves empty."""
    hollow = np.zeros(count, dtype=bool)
    points = vertices[np.unique(weld(vertices), return_index=True)[1]]  # corners are numbered by place
    if not is_closed(corners):
        return hollow
    whole = volume_and_centroid(points, corners)[0]
    for k in range(count):
        own = corners[places == k]
        capped, _ = cap_holes(TriangleMesh(points, own, 0 if is_closed(own) else 1))
        if not capped.open_edges:
            volume = volume_and_centroid(points, capped.faces)[0]
            box = float(np.prod(np.ptp(points[np.unique(own)], axis=0)))
            hollow[k] = volume * whole < 0 and abs(volume) > _HOLLOW * box
    return hollow


def _count_contacts(corners: Ints, places: Ints, count: int) -> Ints:
    own = np.unique(np.column_stack([corners.ravel(), np.repeat(places, 3)]), axis=0)
    contacts = np.zeros((count, count), dtype=np.int64)
    starts = np.flatnonzero(np.diff(own[:, 0], prepend=-1))
    for members in np.split(own[:, 1], starts[1:]):
        if len(members) > 1:
            contacts[np.ix_(members, members)] += 1
    np.fill_diagonal(contacts, 0)
    return contacts


def _find_homes(contacts: Ints, small: Bools, sizes: Ints) -> Ints:
    """The part (count,) that each one becomes part of, its own number where it stays.

    One after the other, those of few triangles first, a small one joins the large one that it touches most; where
    small ones touch small ones only, these become one.
    """
    home = np.arange(len(small))
    left = [int(k) for k in np.argsort(sizes, kind="stable") if small[k]]
    while left:
        large = np.ones(len(small), dtype=bool)
        large[left] = False
        found = next((k for k in left if (contacts[k] * large).any()), None)
        if found is None:
            break
        home[found] = home[int(np.argmax(contacts[found] * large))]
        left.remove(found)
    if left:  # islands of small ones
        a, b = np.nonzero(contacts[np.ix_(left, left)])
        roots = component_roots(a, b, len(left))
        home[left] = np.asarray(left)[roots]
    return home
