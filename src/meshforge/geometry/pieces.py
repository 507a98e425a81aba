"""The connected pieces of a triangle soup, each judged: a convex hull, or no hull, with the reason.

Files disagree on what holds a piece together: groups, shared indices, shared places or edges. Each coarse
component is read as whole or as its finer parts, whichever accounts for more of it by valid hulls.
"""

from dataclasses import dataclass
from hashlib import blake2b
from itertools import pairwise, takewhile

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry import connectivity
from meshforge.geometry.arrays import Bools, Floats, Ints, distinct, sort_rows
from meshforge.geometry.convex import convex_hull
from meshforge.geometry.shape import Polytope, volume_and_centroid
from meshforge.geometry.solidity import LEAST_FILL, SolidityVerdict, judge_solidity, refuse_dents
from meshforge.geometry.solids import volume_of_union

_MOST_KNOWN = 1_000_000  # triangles whose pieces are remembered: about 100 MB
_NEAR = 1e-6  # places closer than this share of the surface's size are one, where that closes a hull


@dataclass(frozen=True, eq=False, slots=True)
class Piece:
    """A connected piece of a surface.

    shape: its convex hull, None where the piece is no hull, with the `reason`.
    vertices: (n, 3) [m] and faces: (m, 3), the piece as authored; face_indices: (m,) its faces in the input, ascending;
    group: the group of its first face; volume: what it encloses as authored [m^3], 0 where that is not known.
    fill: of a hull that stands for a mesh that is none, as engines have it, or that closes narrow holes, the share that
    the mesh fills, 0 likewise.
    """

    shape: Polytope | None
    reason: str | None
    vertices: Floats
    faces: Ints
    face_indices: Ints
    group: int = 0
    volume: float = 0.0
    fill: float | None = None


def split_pieces(vertices: Floats, faces: Ints, *, name: str, groups: Ints | None = None) -> list[Piece]:
    """Return the connected pieces of vertices (n, 3) [m] and faces (m, 3), in the order of their first face.

    groups: (m,) the group of each face, where the file has groups.
    Raises GeometryError naming `name`: a coordinate that is not finite, an index that is not there.
    """
    vertices = np.asarray(vertices, dtype=np.float64).reshape(-1, 3)
    faces = np.asarray(faces, dtype=np.int64).reshape(-1, 3)
    if len(faces) == 0:
        return []
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise GeometryError("a face names a vertex that is not there", where=name)
    if not np.isfinite(vertices[faces]).all():
        raise GeometryError("a coordinate is not a finite number", where=name, remedy="Fix the file's vertices.")
    of_face = np.zeros(len(faces), dtype=np.int64) if groups is None else np.asarray(groups, dtype=np.int64)
    arrays = (np.ascontiguousarray(array) for array in (faces, of_face, vertices))
    digest = b"".join(blake2b(array.data, digest_size=16).digest() for array in arrays)
    found = _cache.get(digest)
    if found is None:
        ordered = sorted(PieceReader(vertices, faces, of_face).read(), key=lambda part: int(part.faces[0]))
        found = _cache.add(digest, [_make_piece(vertices, faces, part, of_face) for part in ordered])
    return list(found)


class PieceCache(dict[bytes, list[Piece]]):
    """The pieces of the meshes that were read last, by digest, as many as `_MOST_KNOWN` allows: an asset's meshes are
    read when it is opened, when it is written, and to check that."""

    size = 0

    def add(self, digest: bytes, pieces: list[Piece]) -> list[Piece]:
        """Return the pieces, kept."""
        self.size += 0 if digest in self else _size_of(pieces)  # another thread may have been faster
        self[digest] = pieces
        while self.size > _MOST_KNOWN and len(self) > 1:
            self.size -= _size_of(self.pop(next(iter(self)), []))
        return pieces


def _size_of(pieces: list[Piece]) -> int:
    return sum(len(piece.faces) + 20 for piece in pieces)


_cache = PieceCache()


def _make_piece(vertices: Floats, faces: Ints, part: "PieceFaces", group: Ints) -> Piece:
    used, local = connectivity.compact(faces[part.faces])
    arrays = (vertices[used], local, part.faces)
    for array in arrays:
        array.setflags(write=False)
    verdict, own = part.verdict, int(group[part.faces[0]])
    return Piece(verdict.shape, verdict.reason, *arrays, own, abs(verdict.volume), verdict.fill)


def hull_mesh(vertices: Floats, faces: Ints, corners: Floats | None = None) -> tuple[Polytope, float | None]:
    """Return the hull of a mesh of vertices (n, 3) and faces (m, 3), or of corners (k, 3), and its `fill` (`Piece`).

    Raises GeometryError: they span no volume, a coordinate is not finite.
    """
    hull = convex_hull(vertices[distinct(faces)] if corners is None else corners)
    pieces = split_pieces(vertices, faces, name="mesh")
    shapes = [piece.shape for piece in pieces if piece.shape]
    others = [piece.volume for piece in pieces if not piece.shape and piece.volume <= hull.volume]
    share = (volume_of_union(shapes) + sum(others)) / hull.volume
    is_full = len(shapes) == len(pieces) and (len(shapes) == 1 or share >= LEAST_FILL)
    is_full = is_full and all(piece.fill is None for piece in pieces)
    return hull, None if is_full else min(share, 1.0)


@dataclass(frozen=True, eq=False, slots=True)
class PieceFaces:
    """Faces read as one piece, ascending, and what they are."""

    faces: Ints
    verdict: SolidityVerdict


@dataclass(frozen=True, eq=False, slots=True)
class IndexComponents:
    """What vertex numbers hold together: the component (m,) of each face, and whether that is closed."""

    component: Ints
    closed: Bools

    @staticmethod
    def of(corners: Ints) -> "IndexComponents":
        component = connectivity.components_by_vertices(corners)
        return IndexComponents(component, np.isin(component, connectivity.find_closed_components(corners, component)))


class PieceReader:
    """Reads components from coarse (all that touches) to fine (solids that meet in an edge)."""

    def __init__(self, vertices: Floats, faces: Ints, group: Ints) -> None:
        self.vertices = vertices
        self.placed = connectivity.weld(vertices)[faces]  # corners by place
        self.of_place = connectivity.components_by_vertices(
            self.placed
        )  # the component of each face, by what holds it together
        self.across = IndexComponents.of(faces)
        self.of_group, self.in_groups = self.of_place, self.across
        if (group != group[0]).any():
            self.of_group = connectivity.components_by_vertices(_number_by_group(self.placed, group))
            self.in_groups = IndexComponents.of(_number_by_group(faces, group))
        self.points = np.zeros((int(self.placed.max()) + 1, 3))
        self.points[self.placed] = vertices[faces]

    def read(self) -> list[PieceFaces]:
        found = [part for faces in _split(self.of_place) for part in self._split_touching(faces)]
        found = self._join_near(found) if any(part.verdict.shape is None for part in found) else found
        solid = [part for part in found if part.verdict.shape]
        judged = [refuse_dents(p.verdict, self.points, self._corners_of(p.faces)) for p in solid]
        return [p for p in found if not p.verdict.shape] + [
            PieceFaces(p.faces, v) for p, v in zip(solid, judged, strict=True)
        ]

    def _join_near(self, found: list[PieceFaces]) -> list[PieceFaces]:
        """The parts, those that are no hulls joined where welding places that nearly agree makes a hull of them."""
        open_parts = [part for part in found if part.verdict.shape is None]
        if len(open_parts) == 1 and open_parts[0].verdict.closed:
            return found
        faces = np.sort(np.concatenate([part.faces for part in open_parts]))
        extent = float(np.ptp(self.points[np.unique(self.placed)], axis=0).max())
        near = connectivity.weld_nearly(self.points, self.placed[faces], _NEAR * extent)
        if near is None:
            return found
        welded = _subdivide(faces, connectivity.components_by_vertices(near[self.placed[faces]]))
        other = [some for some in welded if (near[self.placed[some]] != self.placed[some]).any()]
        hulls = [part for part in (self._judge(some, near) for some in other) if part.verdict.shape]
        used = np.concatenate([part.faces for part in hulls]) if hulls else faces[:0]
        return hulls + [part for part in found if not np.isin(part.faces[0], used)]

    def _split_touching(self, faces: Ints) -> list[PieceFaces]:
        parts = _subdivide(faces, self.of_group[faces])
        if len(parts) == 1:
            return self._split_by_index(faces, self.in_groups)
        better = self._choose_better([p for part in parts for p in self._split_by_index(part, self.in_groups)], faces)
        return better if len(better) > 1 else self._split_by_index(faces, self.across)

    def _split_by_index(self, faces: Ints, indexed: IndexComponents) -> list[PieceFaces]:
        """What touches: as whole, or by the closed surfaces that share no vertex number."""
        closed = indexed.closed[faces]
        parts = _subdivide(faces[closed], indexed.component[faces[closed]])
        if not closed.all():
            parts += _subdivide(faces[~closed], connectivity.components_by_vertices(self.placed[faces[~closed]]))
        if len(parts) == 1:
            return self._split_surface(faces)
        return self._choose_better([p for part in parts for p in self._split_surface(part)], faces)

    def _split_surface(self, faces: Ints) -> list[PieceFaces]:
        """One surface: as whole, or by the solids that it was written as, or that meet in its edges and corners."""
        whole = self._judge(faces)
        corners = self.placed[faces]
        if connectivity.is_simple(corners) and (
            whole.verdict.shape is not None or not connectivity.components_by_edges(self.points, corners, False).any()
        ):
            return [whole]
        return self._split_by_order(faces) or self._split_solids(faces, whole) or [whole]

    def _split_by_order(self, faces: Ints) -> list[PieceFaces]:
        """The hulls that some faces were written as, one after the other; none where they were not."""
        runs = _subdivide(faces, connectivity.find_closed_runs(self.placed[faces]))
        if len(runs) < 2 or min(map(len, runs)) < 4:
            return []
        solids: list[PieceFaces] = []
        for run in runs:
            found = self._split_solids(run)
            if not found:
                return []
            solids += found
        return _join_backs(solids)

    def _split_solids(self, faces: Ints, whole: PieceFaces | None = None) -> list[PieceFaces]:
        """The one hull that some faces are, or several that meet in edges and corners; none where they are not."""
        whole = whole or self._judge(faces)
        corners = self.placed[faces]
        if whole.verdict.shape is not None and connectivity.is_simple(corners):
            return [whole]
        proper = np.flatnonzero((corners != np.roll(corners, 1, axis=1)).all(axis=1))
        if len(proper) == 0:
            return []
        inward = volume_and_centroid(self.points, corners)[0] < 0
        component = connectivity.components_by_edges(self.points, corners[proper], inward)
        parts = self._add_slivers(_subdivide(faces[proper], component), np.setdiff1d(faces, faces[proper]))
        closed = len(connectivity.find_closed_components(corners[proper], component)) == len(parts) > 1
        solids = list(takewhile(lambda solid: solid.verdict.shape, map(self._judge, parts))) if closed else []
        return _join_backs(solids if len(solids) == len(parts) else []) or ([whole] if whole.verdict.shape else [])

    def _add_slivers(self, parts: list[Ints], slivers: Ints) -> list[Ints]:
        """The parts, each with the faces without area that lie at one of its corners."""
        owner = np.zeros(len(self.points), dtype=np.int64)
        for k in reversed(range(len(parts))):
            owner[self.placed[parts[k]]] = k
        of_sliver = owner[self.placed[slivers, 0]]
        return [np.sort(np.concatenate([part, slivers[of_sliver == k]])) for k, part in enumerate(parts)]

    def _judge(self, faces: Ints, near: Ints | None = None) -> PieceFaces:
        corners = self._corners_of(faces, near)
        if len(corners) < 2:
            return PieceFaces(faces, SolidityVerdict(None, "flat"))
        return PieceFaces(faces, judge_solidity(self.points, corners))

    def _corners_of(self, faces: Ints, near: Ints | None = None) -> Ints:
        corners = self.placed[faces] if near is None else near[self.placed[faces]]
        return corners[connectivity.distinct_faces(corners, np.zeros(len(corners), dtype=np.int64))]

    def _choose_better(self, parts: list[PieceFaces], faces: Ints) -> list[PieceFaces]:
        parts = _join_backs(parts)
        if all(part.verdict.shape for part in parts):
            return parts
        whole = self._judge(faces)
        solid = sum(abs(p.verdict.volume) for p in parts if p.verdict.shape and p.verdict.closed)
        enough = LEAST_FILL * abs(whole.verdict.volume) if whole.verdict.shape else 0.0
        return parts if solid > enough else [whole]


def _join_backs(parts: list[PieceFaces]) -> list[PieceFaces]:
    """The parts, the inside-out copy of a hull joined with that hull: both are sides of one double-sided surface."""
    if len(parts) < 2:
        return parts
    found: dict[bytes, list[int]] = {}
    out = list(parts)
    for k, part in enumerate(parts):
        shape = part.verdict.shape
        if shape is None:
            continue
        same = found.setdefault(sort_rows(shape.vertices).tobytes(), [])
        front = next((j for j in same if out[j].verdict.volume * part.verdict.volume < 0), None)
        if front is None:
            same.append(k)
            continue
        same.remove(front)
        out[front] = PieceFaces(np.sort(np.concatenate([out[front].faces, part.faces])), out[front].verdict)
        out[k] = PieceFaces(part.faces[:0], part.verdict)
    return [part for part in out if len(part.faces)]


def _number_by_group(corners: Ints, group: Ints) -> Ints:
    return connectivity.row_ids(np.repeat(group, 3), corners.ravel())[0].reshape(-1, 3)


def _split(component: Ints) -> list[Ints]:
    order = np.argsort(component, kind="stable")
    ordered = component[order]
    ends = [*(np.flatnonzero(ordered[1:] != ordered[:-1]) + 1).tolist(), len(order)]
    return [order[start:end] for start, end in pairwise([0, *ends])] if len(order) else []


def _subdivide(faces: Ints, component: Ints) -> list[Ints]:
    return [faces[members] for members in _split(component)]
