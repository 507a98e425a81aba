"""How far hulls stick out of the visual mesh, and what of that no hull covers."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from meshforge.checks.base import NO_VISUAL_MESH, CheckFindings, CheckSubject, Measure, MeasureCheck
from meshforge.checks.grid import Grid, Mask, flood_from_outside, grid_around, voxelize_surface
from meshforge.checks.legality import find_oddities
from meshforge.checks.physics.mechanism import JointTree
from meshforge.checks.surface_samples import SurfaceIndex, join_corners
from meshforge.common import join_names
from meshforge.engines import Finding
from meshforge.geometry import Aabb, Floats, Ints, planes_of
from meshforge.rendering import LengthUnit, draw_heat_map
from meshforge.symbolic import Hull, Surface, SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image

LEAST_GAP_SHARE = 0.02
"""Hulls that stick out, or surfaces that lie bare, by more than this share of the diagonal are findings."""
_SPACING = 0.5  # of points on surfaces, in cells


@dataclass(frozen=True, slots=True)
class HullFit:
    """How one hull fits what its body shows.

    out: how far it sticks out at most [m]; out_area: how much of its surface does, by more than a cell [m^2];
    bare: how far the visual surface nearest to it lies off all hulls at most [m]; bare_area: how much of that does, by
    more than a cell [m^2].
    """

    hull: str
    out: float
    out_area: float
    bare: float
    bare_area: float


@dataclass(frozen=True, eq=False, slots=True)
class FitGroup:
    """The hulls of a body, or of all, with the visual mesh that they are compared with.

    visual_surface, hull_surface: their triangles; owner: the hull of each triangle of `hull_surface`; outside: the
    cells of `grid` that a path leads to from outside without crossing the visual mesh.
    """

    hulls: tuple[Hull, ...]
    visual_surface: SurfaceIndex
    hull_surface: SurfaceIndex
    owner: Ints
    grid: Grid
    outside: Mask

    def measure_out(self, points: Floats) -> Floats:
        """Return how far [m] each point (n, 3) of a hull sticks out of the visual mesh, 0 where it is inside of it."""
        x, y, z = self.grid.cells_of(points).T
        free = np.flatnonzero(self.outside[x, y, z])
        found = np.zeros(len(points))
        found[free] = self.visual_surface.distances(points[free])[0]
        return found

    def measure_bare(self, points: Floats) -> tuple[Floats, Ints]:
        """Return how far [m] each point (n, 3) of the visual mesh is from all hulls, and the nearest (n,), if off."""
        gaps, nearest = np.zeros(len(points)), np.zeros(len(points), np.int64)
        off = np.flatnonzero(~_is_inside(points, self.hulls))
        gaps[off], triangle = self.hull_surface.distances(points[off])
        nearest[off] = self.owner[triangle]
        return gaps, nearest


@dataclass(frozen=True, eq=False, slots=True)
class MeshFit(Measure):
    """How the hulls of a mesh fit; cell: what is smaller than this is not seen [m].

    silent: bodies with hulls that show nothing, so that theirs were not measured; seen_area: of the visual mesh [m^2].
    """

    cell: float
    diagonal: float
    hulls: tuple[HullFit, ...]
    silent: tuple[str, ...]
    seen_area: float
    groups: tuple[FitGroup, ...] = field(repr=False, default=())

    @property
    def out(self) -> float:
        """How far any hull sticks out [m]."""
        return max((h.out for h in self.hulls), default=0.0)

    @property
    def bare(self) -> float:
        """How far any visual surface lies off all hulls [m]."""
        return max((h.bare for h in self.hulls), default=0.0)

    @property
    def bare_share(self) -> float:
        """The share of the visual surface that no hull covers."""
        return sum(h.bare_area for h in self.hulls) / self.seen_area if self.seen_area else 0.0

    @property
    def description(self) -> str:
        if not self.hulls:
            return ""
        bare = f"{100 * self.bare_share:.3g}% of the visual surface bare, {self.bare:.3g} m off at most"
        return f"hulls stick out by {self.out:.3g} m at most, {bare} (cells of {self.cell:.3g} m)"

    @property
    def findings(self) -> tuple[Finding, ...]:
        """The hulls that stick out far, and those beside bare surfaces."""
        limit = max(LEAST_GAP_SHARE * self.diagonal, self.cell)
        out = sorted((h for h in self.hulls if h.out > limit), key=lambda h: -h.out)
        bare = sorted((h for h in self.hulls if h.bare > limit), key=lambda h: -h.bare)
        found = []
        if out:
            message = f"{join_names([f'{h.hull} ({h.out:.3g} m)' for h in out])}: sticks out of the visual mesh"
            remedy = "Split the hull, or replace it by one that fits."
            found.append(Finding("fit-out", "warning", tuple(h.hull for h in out), message, remedy))
        if bare:
            names = join_names([f"{h.hull} ({h.bare:.3g} m)" for h in bare])
            message = f"{names}: the visual mesh beside it is covered by no hull"
            found.append(Finding("fit-bare", "warning", tuple(h.hull for h in bare), message, "Add a hull there."))
        return tuple(found)

    def draw(
        self, mesh: SymbolicMesh, name: str, size: tuple[int, int], unit: LengthUnit
    ) -> Iterator[tuple[str, str, Image]]:
        if maps := draw_fit(mesh, self, size, unit):
            yield f"{name}-out", f"hulls stick out by {self.out:.3g} m at most", maps[0]
            yield f"{name}-bare", f"visual mesh, {self.bare:.3g} m off all hulls at most", maps[1]

    def to_json(self) -> dict[str, Any]:
        return {
            "cell": self.cell,
            "out": self.out,
            "bare": self.bare,
            "bare_share": self.bare_share,
            "hulls": [asdict(hull) for hull in self.hulls],
            "silent": list(self.silent),
        }


class FitCheck(MeasureCheck):
    """How far hulls stick out of the visual mesh, and what of that lies bare; and hulls of odd shapes."""

    name = "fit"
    has_cells = True
    compares = False

    def measure(self, subject: CheckSubject) -> CheckFindings:
        found = measure_fit(subject.sound, cell=subject.cell)
        silent = f"bodies that show nothing, so their fit was not measured: {', '.join(found.silent)}"
        notes = [] if found.hulls and not found.silent else [silent if found.hulls else NO_VISUAL_MESH]
        findings = (*find_oddities(subject.sound), *found.findings, *_find_bodies_without_hulls(subject.mesh))
        return CheckFindings(findings, {self.name: found}, tuple(notes))


def _find_bodies_without_hulls(mesh: SymbolicMesh) -> Iterator[Finding]:
    """Bodies without hulls that show something far off the hulls of what they are welded to; other bodies have some."""
    rigid, visuals = JointTree.of(mesh).rigid_roots(), mesh.asset.visuals if mesh.asset and mesh.hulls else ()
    solid = {hull.body for hull in mesh.hulls}
    shown = {one.body for one in visuals if one.body and len(one.faces)} - solid
    spacing, bare = (
        _SPACING * grid_around(Aabb.union(hull.aabb for hull in mesh.hulls)).cell if shown else 0.0,
        list[str](),
    )
    for body in sorted(shown):
        hulls = [hull for hull in mesh.hulls if rigid[hull.body] == rigid.get(body, body)]
        points = SurfaceIndex(join_corners([one for one in visuals if one.body == body]), spacing).points
        off = points[~_is_inside(points, hulls)]
        surface = SurfaceIndex(np.concatenate([h.vertices[h.faces] for h in hulls]), spacing) if hulls else None
        if surface is None or (len(off) and surface.distances(off)[0].max() > LEAST_GAP_SHARE * mesh.diagonal):
            bare.append(body)
    if bare:
        message = f"nothing collides of what these bodies show: {join_names(bare)}"
        yield Finding("fit-no-hulls", "warning", (), message, "Make hulls of what they show: meshforge prepare.")


def measure_fit(mesh: SymbolicMesh, *, cell: float | None = None) -> MeshFit:
    """Return how the hulls of a mesh fit what their bodies show, at rest pose.

    A hull is compared with the visual mesh of its own body; where the file does not tell what shows what, all against
    all. A point of a hull sticks out where a path leads to it from outside without crossing the visual mesh, on a grid
    of cells of side `cell` [m] (by default the diagonal by 112): so holes and wrong windings of a visual mesh do no
    harm unless they are wider than a cell, and what sticks out by less than a cell may not be seen.
    """
    surfaces = [s for s in mesh.asset.visuals if len(s.faces)] if mesh.asset else []
    pairs, silent = _pair_by_body(mesh.hulls, surfaces)
    groups = tuple(_build_group(hulls, corners, cell) for hulls, corners in pairs)
    rows = [row for group in groups for row in _measure_group(group)]
    order = {hull.name: k for k, hull in enumerate(mesh.hulls)}
    widest = max((group.grid.cell for group in groups), default=0.0)
    area = float(sum(group.visual_surface.area.sum() for group in groups))
    rows.sort(key=lambda row: order[row.hull])
    return MeshFit(widest, mesh.diagonal, tuple(rows), silent, area, groups)


def _pair_by_body(
    hulls: Sequence[Hull], surfaces: Sequence[Surface]
) -> tuple[list[tuple[tuple[Hull, ...], Floats]], tuple[str, ...]]:
    """The hulls of each body with the triangles that it shows; and the bodies that show nothing."""
    if any(surface.body is None for surface in surfaces):
        return [(tuple(hulls), join_corners(surfaces))] if hulls else [], ()
    pairs, silent = [], []
    for body in dict.fromkeys(hull.body for hull in hulls):
        corners = join_corners([s for s in surfaces if s.body == body])
        if len(corners):
            pairs.append((tuple(h for h in hulls if h.body == body), corners))
        else:
            silent.append(body)
    return pairs, tuple(silent)


def _build_group(hulls: tuple[Hull, ...], corners: Floats, cell: float | None) -> FitGroup:
    grid = grid_around(Aabb.union([*(h.aabb for h in hulls), Aabb.of_points(corners.reshape(-1, 3))]), cell)
    surfaces = [h.vertices[h.faces] for h in hulls]
    owner = np.repeat(np.arange(len(hulls)), [len(s) for s in surfaces])
    spacing = _SPACING * grid.cell
    outside = flood_from_outside(voxelize_surface(grid, corners))
    return FitGroup(
        hulls, SurfaceIndex(corners, spacing), SurfaceIndex(np.concatenate(surfaces), spacing), owner, grid, outside
    )


def _measure_group(group: FitGroup) -> list[HullFit]:
    out = group.measure_out(group.hull_surface.points)
    of_hull = group.owner[group.hull_surface.triangle]
    bare, nearest = group.measure_bare(group.visual_surface.points)
    count, cell = len(group.hulls), group.grid.cell
    far, far_area = _sum_by_hull(of_hull, out, group.hull_surface.area, count, cell)
    off, off_area = _sum_by_hull(nearest, bare, group.visual_surface.area, count, cell)
    return [
        HullFit(hull.name, float(far[k]), float(far_area[k]), float(off[k]), float(off_area[k]))
        for k, hull in enumerate(group.hulls)
    ]


def _sum_by_hull(hull: Ints, gaps: Floats, area: Floats, count: int, cell: float) -> tuple[Floats, Floats]:
    largest = np.zeros(count)
    np.maximum.at(largest, hull, gaps)
    return largest, np.asarray(np.bincount(hull, np.where(gaps > cell, area, 0.0), minlength=count), np.float64)


def _is_inside(points: Floats, hulls: Sequence[Hull]) -> Mask:
    inside = np.zeros(len(points), dtype=bool)
    for hull in hulls:
        box = hull.aabb
        near = np.flatnonzero(~inside & (points >= box.min).all(axis=1) & (points <= box.max).all(axis=1))
        planes = planes_of(hull.vertices, hull.faces)
        for part in np.array_split(near, len(near) * len(planes.offsets) // 4_000_000 + 1):
            inside[part] = ((points[part] - planes.middle) @ planes.normals.T <= planes.offsets).all(axis=1)
    return inside


def draw_fit(
    mesh: SymbolicMesh, found: MeshFit, size: tuple[int, int] = (640, 480), unit: LengthUnit = "m"
) -> tuple[Image, Image] | None:
    """Return two pictures: the hulls by how far they stick out, and the visual mesh by how far it lies off all hulls.

    None where nothing is shown. The strongest colour is for twice the length that matters; what is below a cell has
    none.
    """
    if not found.groups:
        return None
    most = max(2 * LEAST_GAP_SHARE * found.diagonal, 4 * found.cell)
    hulls = [hull.shape.tessellate() for group in found.groups for hull in group.hulls]
    corners = [group.visual_surface.corners for group in found.groups]
    seen = [Surface(c.reshape(-1, 3), np.arange(3 * len(c)).reshape(-1, 3)) for c in corners]
    group_of = np.array([k for k, group in enumerate(found.groups) for _ in group.hulls])

    def out(points: Floats, items: Ints) -> Floats:
        return _measure_by_group(found.groups, points, group_of[items], FitGroup.measure_out)

    def bare(points: Floats, items: Ints) -> Floats:
        return _measure_by_group(found.groups, points, items, lambda group, some: group.measure_bare(some)[0])

    titles = "hulls: how far they stick out", "visual mesh: how far off all hulls"
    return (
        draw_heat_map(mesh, hulls, out, most, size=size, title=titles[0], unit=unit),
        draw_heat_map(mesh, seen, bare, most, size=size, title=titles[1], unit=unit),
    )


def _measure_by_group(
    groups: Sequence[FitGroup], points: Floats, which: Ints, measure: Callable[[FitGroup, Floats], Floats]
) -> Floats:
    """What `measure` gives for each point (n, 3) by the group (n,) that it belongs to."""
    values = np.zeros(len(points))
    for k in np.unique(which):
        values[which == k] = measure(groups[k], points[which == k])
    return values
