"""How a triangle soup is read as pieces.

Files disagree on what holds a piece together: groups, shared indices, shared places or edges. Each coarse component
is read as whole or as its finer parts, whichever accounts for more of it by valid hulls.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.pieces.around_edges import by_edges, closed_runs, is_simple
from meshforge.geometry.pieces.connect import (
    Bools,
    by_vertices,
    closed_components,
    distinct_faces,
    nearly_welded,
    row_ids,
    welded,
)
from meshforge.geometry.pieces.solidity import FILLED, Verdict, verdict
from meshforge.geometry.shapes.polytope import volume_and_centroid

_NEAR = 1e-6  # places closer than this share of the surface's size are one, where that closes a hull


@dataclass(frozen=True, eq=False, slots=True)
class Part:
    """Faces read as one piece, ascending, and what they are."""

    faces: Ints
    verdict: Verdict


@dataclass(frozen=True, eq=False, slots=True)
class Indexed:
    """What vertex numbers hold together: the component (m,) of each face, and whether that is closed."""

    component: Ints
    closed: Bools

    @staticmethod
    def of(corners: Ints) -> Indexed:
        component = by_vertices(corners)
        return Indexed(component, np.isin(component, closed_components(corners, component)))


class Reader:
    """Reads components from coarse (all that touches) to fine (solids that meet in an edge)."""

    def __init__(self, vertices: Floats, faces: Ints, group: Ints) -> None:
        self.vertices = vertices
        self.placed = welded(vertices)[faces]  # corners by place
        self.of_place = by_vertices(self.placed)  # the component of each face, by what holds it together
        self.of_group = by_vertices(_in_groups(self.placed, group))
        self.in_groups = Indexed.of(_in_groups(faces, group))
        self.across = Indexed.of(faces)
        self.points = np.zeros((int(self.placed.max()) + 1, 3))
        self.points[self.placed] = vertices[faces]

    def read(self) -> list[Part]:
        found = [part for faces in _split(self.of_place) for part in self._split_touching(faces)]
        return self._join_near(found) if any(part.verdict.shape is None for part in found) else found

    def _join_near(self, found: list[Part]) -> list[Part]:
        """The parts, those that are no hulls joined where welding places that nearly agree makes a hull of them."""
        opaque = [part for part in found if part.verdict.shape is None]
        faces = np.sort(np.concatenate([part.faces for part in opaque]))
        near = nearly_welded(self.points, self.placed[faces], _NEAR * self._extent())
        if near is None:
            return found
        mended = [self._judge(part, near) for part in _sub(faces, by_vertices(near[self.placed[faces]]))]
        hulls = [part for part in mended if part.verdict.shape]
        used = np.concatenate([part.faces for part in hulls]) if hulls else faces[:0]
        return hulls + [part for part in found if not np.isin(part.faces[0], used)]

    def _extent(self) -> float:
        return float(np.ptp(self.points[np.unique(self.placed)], axis=0).max())

    def _split_touching(self, faces: Ints) -> list[Part]:
        """All that touches: as whole, or group by group."""
        parts = _sub(faces, self.of_group[faces])
        if len(parts) == 1:
            return self._split_by_index(faces, self.in_groups)
        better = self._choose_better([p for part in parts for p in self._split_by_index(part, self.in_groups)], faces)
        return better if len(better) > 1 else self._split_by_index(faces, self.across)

    def _split_by_index(self, faces: Ints, indexed: Indexed) -> list[Part]:
        """What touches: as whole, or by the closed surfaces that share no vertex number."""
        closed = indexed.closed[faces]
        parts = _sub(faces[closed], indexed.component[faces[closed]])
        if not closed.all():
            parts += _sub(faces[~closed], by_vertices(self.placed[faces[~closed]]))
        if len(parts) == 1:
            return self._split_surface(faces)
        return self._choose_better([p for part in parts for p in self._split_surface(part)], faces)

    def _split_surface(self, faces: Ints) -> list[Part]:
        """One surface: as whole, or by the solids that it was written as, or that meet in its edges and corners."""
        whole = self._judge(faces)
        if whole.verdict.shape is not None and is_simple(self.placed[faces]):
            return [whole]
        return self._split_by_order(faces) or self._split_solids(faces, whole) or [whole]

    def _split_by_order(self, faces: Ints) -> list[Part]:
        """The hulls that some faces were written as, one after the other; none where they were not."""
        runs = _sub(faces, closed_runs(self.placed[faces]))
        if len(runs) < 2 or min(map(len, runs)) < 4:
            return []
        solids: list[Part] = []
        for run in runs:
            found = self._split_solids(run)
            if not found:
                return []
            solids += found
        return _without_backs(solids)

    def _split_solids(self, faces: Ints, whole: Part | None = None) -> list[Part]:
        """The one hull that some faces are, or several that meet in edges and corners; none where they are not."""
        whole = whole or self._judge(faces)
        corners = self.placed[faces]
        if whole.verdict.shape is not None and is_simple(corners):
            return [whole]
        proper = np.flatnonzero((corners != np.roll(corners, 1, axis=1)).all(axis=1))
        if len(proper) == 0:
            return []
        inward = volume_and_centroid(self.points, corners)[0] < 0
        component = by_edges(self.points, corners[proper], inward)
        parts = self._add_slivers(_sub(faces[proper], component), np.setdiff1d(faces, faces[proper]))
        closed = len(closed_components(corners[proper], component)) == len(parts) > 1
        solids = self._judge_all(parts) if closed else []
        return _without_backs(solids) or ([whole] if whole.verdict.shape else [])

    def _judge_all(self, parts: list[Ints]) -> list[Part]:
        """The parts judged, none where one of them is no hull."""
        judged = []
        for part in parts:
            judged.append(self._judge(part))
            if judged[-1].verdict.shape is None:
                return []
        return judged

    def _add_slivers(self, parts: list[Ints], slivers: Ints) -> list[Ints]:
        """The parts, each with the faces without area that lie at one of its corners."""
        owner = np.zeros(len(self.points), dtype=np.int64)
        for k in reversed(range(len(parts))):
            owner[self.placed[parts[k]]] = k
        of_sliver = owner[self.placed[slivers, 0]]
        return [np.sort(np.concatenate([part, slivers[of_sliver == k]])) for k, part in enumerate(parts)]

    def _judge(self, faces: Ints, near: Ints | None = None) -> Part:
        corners = self.placed[faces] if near is None else near[self.placed[faces]]
        proper = distinct_faces(corners, np.zeros(len(corners), dtype=np.int64))
        if len(proper) < 2:
            return Part(faces, Verdict(None, "flat"))
        return Part(faces, verdict(self.points, corners[proper]))

    def _choose_better(self, parts: list[Part], faces: Ints) -> list[Part]:
        """The parts, or the whole, whichever accounts for more by valid hulls."""
        parts = _without_backs(parts)
        if all(part.verdict.shape for part in parts):
            return parts
        whole = self._judge(faces)
        solid = sum(abs(p.verdict.volume) for p in parts if p.verdict.shape and p.verdict.closed)
        enough = FILLED * abs(whole.verdict.volume) if whole.verdict.shape else 0.0
        return parts if solid > enough else [whole]


def _without_backs(parts: list[Part]) -> list[Part]:
    """The parts, the inside-out copy of a hull joined with that hull: both are sides of one double-sided surface."""
    found: dict[bytes, list[int]] = {}
    out = list(parts)
    for k, part in enumerate(parts):
        shape = part.verdict.shape
        if shape is None:
            continue
        same = found.setdefault(np.unique(shape.vertices, axis=0).tobytes(), [])
        front = next((j for j in same if out[j].verdict.volume * part.verdict.volume < 0), None)
        if front is None:
            same.append(k)
            continue
        same.remove(front)
        out[front] = Part(np.sort(np.concatenate([out[front].faces, part.faces])), out[front].verdict)
        out[k] = Part(part.faces[:0], part.verdict)
    return [part for part in out if len(part.faces)]


def _in_groups(corners: Ints, group: Ints) -> Ints:
    """Numbers for corners (m, 3) that differ from group to group."""
    return row_ids(np.repeat(group, 3), corners.ravel())[0].reshape(-1, 3)


def _split(component: Ints) -> list[Ints]:
    """The members of each component, ascending, in the order of the component numbers."""
    order = np.argsort(component, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(component[order])) + 1) if len(order) else []


def _sub(faces: Ints, component: Ints) -> list[Ints]:
    return [faces[members] for members in _split(component)]
