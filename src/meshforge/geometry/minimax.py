"""Polytopes around a hull that stick out of it as little as can be: planes turned, or vertices moved, by a sequence of
linear programmes with a trust region (see Conn, Gould and Toint, Trust-Region Methods, 2000)."""

from abc import ABC, abstractmethod
from typing import Any, Self, TypeVar

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Bools, Floats, Ints, nearest_on_triangles
from meshforge.geometry.shape import Polytope
from meshforge.geometry.surface import normals_of

_ROUNDS = 60
_GAIN = 1e-3  # of the error in a round, below which smaller steps are tried
_LEAST_STEP = 1e-5
_SUPPORTS = 5  # points of the inner hull that each plane is held outside of
_NEAR = 12  # triangles by height, and as many by distance, among which the nearest point is looked for


def turn_planes(normals: Floats, hull: Polytope) -> Floats:
    """Return the corners (n, 3) of a polytope around a hull, of as many planes as normals (k, 3) to start from."""
    inner = InnerHull(hull)
    return inner.scale_back(descend(_Planes(inner, normals), 0.2).corners)


def move_vertices(vertices: Floats, hull: Polytope) -> Floats:
    """Return the vertices (n, 3) of a polytope around a hull, of at most as many as there are to start from."""
    inner = InnerHull(hull)
    return inner.scale_back(descend(_Vertices(inner, (vertices - inner.middle) / inner.size), 0.02).corners)


class InnerHull:
    """The hull that is enclosed, of size 1 about the middle of its vertices."""

    def __init__(self, hull: Polytope) -> None:
        self.middle, self.size = hull.vertices.mean(axis=0), float(np.ptp(hull.vertices, axis=0).max())
        self.points = (hull.vertices - self.middle) / self.size
        self._triangles, self._normals = self.points[hull.faces], normals_of(hull)
        self._offsets = (self._normals * self._triangles[:, 0]).sum(axis=1)
        self._middles = self._triangles.mean(axis=1)

    def scale_back(self, points: Floats) -> Floats:
        """Return points (n, 3) in metres."""
        found: Floats = self.middle + self.size * points
        return found

    def measure_gaps(self, points: Floats) -> tuple[Floats, Floats]:
        """Return how far (n,) points (n, 3) outside are from the hull, and the unit vectors (n, 3) away from it."""
        most = min(_NEAR, len(self._triangles)) - 1
        heights = self._offsets - points @ self._normals.T
        squares = (self._middles**2).sum(axis=1) - 2 * points @ self._middles.T
        near = np.hstack([np.argpartition(rank, most, axis=1)[:, : most + 1] for rank in (heights, squares)])
        found = nearest_on_triangles(np.repeat(points, near.shape[1], axis=0), self._triangles[near.ravel()])
        away = points[:, None] - found.reshape(len(points), -1, 3)
        lengths = np.linalg.norm(away, axis=2)
        nearest = np.arange(len(points)), lengths.argmin(axis=1)
        gaps = lengths[nearest]
        return gaps, away[nearest] / np.maximum(gaps, 1e-15)[:, None]

    def find_supports(self, normals: Floats) -> Ints:
        """Return the numbers (k, m) of the points that lie farthest along each normal."""
        most = min(_SUPPORTS, len(self.points)) - 1
        return np.argpartition(-(normals @ self.points.T), most, axis=1)[:, : most + 1]


class LinearProgram:
    """A linear programme: the least bound on the errors, its last variable; rows are upper limits."""

    def __init__(self, count: int) -> None:
        self._count = count
        self._parts: list[tuple[Ints, Floats, Floats]] = []

    def limit(self, columns: Ints, entries: Floats, most: Floats) -> None:
        """Let sums of entries (k, c) times the variables of columns (k, c) be at most (k,)."""
        self._parts.append((columns, entries, most))

    def solve(self, low: Floats, high: Floats, method: str = "highs") -> Floats | None:
        from scipy.optimize import linprog  # lazy: slow to import, only simplifying needs it
        from scipy.sparse import csr_array, vstack  # lazy: as above

        blocks = [
            csr_array(
                (entries.ravel(), (np.repeat(np.arange(len(entries)), entries.shape[1]), columns.ravel())),
                shape=(len(entries), self._count),
            )
            for columns, entries, _ in self._parts
        ]
        limits = np.concatenate([most for _, _, most in self._parts])
        cost = np.eye(self._count)[-1]
        rows: Any = vstack(blocks)  # the stubs of scipy know no sparse ones
        found = linprog(cost, rows, limits, bounds=np.column_stack([low, high]), method=method)  # type: ignore[call-overload]
        return np.asarray(found.x) if found.status == 0 else None


class State(ABC):
    """A polytope around the inner hull; corners: (n, 3), of which `error` is the farthest from it."""

    corners: Floats
    error: float

    @abstractmethod
    def move(self, step: float) -> Self | None:
        """Return the state after a programme whose variables change by `step` at most; None without an answer."""


_S = TypeVar("_S", bound=State)


def descend(state: _S, step: float, rounds: int = _ROUNDS, gain: float = _GAIN, least: float = _LEAST_STEP) -> _S:
    """Return the best state that moves lead to, in ever shorter steps; gain: see _GAIN; least: the shortest step."""
    from scipy.spatial import QhullError  # lazy: slow to import

    for _ in range(rounds):
        try:
            moved = state.move(step)
        except QhullError:
            moved = None
        if moved is not None and moved.error < state.error * (1 - gain):
            state, step = moved, step * 1.3
        else:
            step /= 3
            if step < least:
                break
    return state


class _Planes(State):
    """Planes that support the inner hull; each corner lies in three of them."""

    def __init__(self, inner: InnerHull, normals: Floats) -> None:
        from scipy.spatial import HalfspaceIntersection  # lazy: slow to import

        self.inner = inner
        self.normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        self.offsets = (inner.points @ self.normals.T).max(axis=0)
        made = HalfspaceIntersection(np.column_stack([self.normals, -self.offsets]), np.zeros(3))
        self.corners = np.asarray(made.intersections)
        self.owners = np.array([planes[:3] for planes in made.dual_facets])
        self.gaps, self.away = inner.measure_gaps(self.corners)
        self.error = float(self.gaps.max())

    def move(self, step: float) -> Self | None:
        """Variables: changes of the normals, changes of the offsets."""
        count, far = len(self.normals), self.gaps > self.error / 3
        owners, corners = self.owners[far], self.corners[far]
        pulls = np.linalg.solve(self.normals[owners].transpose(0, 2, 1), self.away[far][:, :, None])[:, :, 0]
        turns = -pulls[:, :, None] * corners[:, None]
        program = LinearProgram(4 * count + 1)
        columns = [of_vectors(owners), 3 * count + owners, np.full((len(owners), 1), 4 * count)]
        entries = np.hstack([turns.reshape(len(owners), -1), pulls, -np.ones((len(owners), 1))])
        program.limit(np.hstack(columns), entries, -self.gaps[far])
        near = self.inner.find_supports(self.normals)
        plane = np.repeat(np.arange(count), near.shape[1])
        points = self.inner.points[near.ravel()]
        columns = [of_vectors(plane[:, None]), 3 * count + plane[:, None]]
        entries = np.hstack([points, -np.ones((len(points), 1))])
        program.limit(np.hstack(columns), entries, self.offsets[plane] - (points * self.normals[plane]).sum(axis=1))
        high = np.concatenate([np.full(3 * count, step), np.full(count + 1, np.inf)])
        found = program.solve(np.append(-high[:-1], 0.0), high)
        return None if found is None else type(self)(self.inner, self.normals + found[: 3 * count].reshape(-1, 3))


class _Vertices(State):
    """Vertices of a polytope, grown about the middle until it holds the inner hull."""

    def __init__(self, inner: InnerHull, vertices: Floats) -> None:
        from scipy.spatial import ConvexHull  # lazy: slow to import

        self.inner, made = inner, ConvexHull(vertices)
        self.normals, offsets = made.equations[:, :3], -made.equations[:, 3]
        if offsets.min() <= 0:
            raise GeometryError("the middle of the hull is outside")
        growth = max(1.0, float(((inner.points @ self.normals.T).max(axis=0) / offsets).max()))
        self.corners = vertices[made.vertices] * growth
        self.faces = np.searchsorted(made.vertices, made.simplices)
        self.gaps, self.away = inner.measure_gaps(self.corners)
        self.error = float(self.gaps.max())

    def move(self, step: float) -> Self | None:
        count = len(self.corners)
        program = LinearProgram(3 * count + 1)
        own = np.arange(count)[:, None]
        columns = np.hstack([of_vectors(own), np.full((count, 1), 3 * count)])
        program.limit(columns, np.hstack([self.away, -np.ones((count, 1))]), -self.gaps)
        a, b, c = (self.corners[self.faces[:, k]] for k in range(3))
        normals = np.cross(b - a, c - a)
        squares = (normals**2).sum(axis=1)
        wide: Bools = squares > 1e-20
        near = self.inner.find_supports(self.normals[wide])
        face = np.repeat(np.flatnonzero(wide), near.shape[1])
        away = self.inner.points[near.ravel()] - a[face]
        second = (np.cross(away, (c - a)[face]) * normals[face]).sum(axis=1) / squares[face]
        third = (np.cross((b - a)[face], away) * normals[face]).sum(axis=1) / squares[face]
        weights = np.column_stack([1 - second - third, second, third])
        entries = -weights[:, :, None] * self.normals[face][:, None]
        over = (away * self.normals[face]).sum(axis=1)
        program.limit(of_vectors(self.faces[face]), entries.reshape(len(face), -1), -over)
        high = np.append(np.full(3 * count, step), np.inf)
        found = program.solve(np.append(-high[:-1], 0.0), high)
        moved = None if found is None else self.corners + found[:-1].reshape(-1, 3)
        return None if moved is None else type(self)(self.inner, moved)


def of_vectors(numbers: Ints) -> Ints:
    """Return the columns (k, 3 c) of the three variables of each of numbers (k, c)."""
    return (numbers[:, :, None] * 3 + np.arange(3)).reshape(len(numbers), -1)
