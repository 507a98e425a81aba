"""What hulls close off of the space that can be reached about a visual mesh or other hulls, and what they open."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from meshforge.checks import grid as voxels
from meshforge.checks.base import NO_VISUAL_MESH, CheckFindings, CheckSubject, Measure, MeasureCheck
from meshforge.checks.grid import Grid, Mask, flood_from_outside, grid_around, voxelize_hulls, voxelize_surface
from meshforge.checks.surface_samples import join_corners
from meshforge.common import join_names
from meshforge.engines import Finding
from meshforge.geometry import Aabb, Floats, Shape, convex_hull, is_sheet
from meshforge.rendering import LengthUnit, draw_volumes
from meshforge.symbolic import Surface, SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image

OF_EDIT = "clearance_of_edit"
"""The key of what was closed and opened of the space between the hulls before an edit."""
LEAST_REGION_SHARE = 0.005
"""Regions of a smaller share of the bounding box are reported, but are no findings."""
COLORS = {"closed": "#D64545", "opened": "#3B7DD8"}
_REGIONS = 12  # that are reported one by one; the rest is summed up

RegionKind = Literal["closed", "opened"]


@dataclass(frozen=True, eq=False, slots=True)
class ClearanceRegion:
    """A connected part of space that hulls close or open; bounds: its box; hulls: those that fill it, most first.

    surface: its cells, to be drawn.
    """

    kind: RegionKind
    litres: float
    bounds: Aabb
    hulls: tuple[str, ...]
    surface: Surface


@dataclass(frozen=True, eq=False, slots=True)
class Clearance(Measure):
    """What hulls did to free space; reference: what they are compared with; cell: the side of the cells [m].

    closed, opened: volumes of all regions [l]; layers: volumes of what is thinner than three cells, which may be
    rounding; doubled: closed and opened, found with cells twice as long; box: the volume of the bounding box [l].
    """

    reference: str
    cell: float
    closed: float
    opened: float
    layers: tuple[float, float]
    doubled: tuple[float, float]
    box: float
    regions: tuple[ClearanceRegion, ...]

    @property
    def findings(self) -> tuple[Finding, ...]:
        """The regions that matter."""
        return tuple(_to_finding(one, self) for one in self.regions if one.litres >= LEAST_REGION_SHARE * self.box)

    @property
    def description(self) -> str:
        space = f"the space about the {self.reference}"
        rough = f"with cells twice as long {self.doubled[0]:.3g} l and {self.doubled[1]:.3g} l"
        return (
            f"{self.closed:.3g} l of {space} closed, {self.opened:.3g} l opened (cells of {self.cell:.3g} m; {rough})"
        )

    def draw(
        self, mesh: SymbolicMesh, name: str, size: tuple[int, int], unit: LengthUnit
    ) -> Iterator[tuple[str, str, Image]]:
        if self.regions:
            text = f"{self.reference}: {self.closed:.3g} l closed, {self.opened:.3g} l opened"
            marked = [(region.kind, COLORS[region.kind], region.surface) for region in self.regions]
            yield name, text, draw_volumes(mesh, marked, size=size, title=f"space about the {self.reference}")

    def to_json(self) -> dict[str, Any]:
        return {
            "reference": self.reference,
            "cell": self.cell,
            "closed": self.closed,
            "opened": self.opened,
            "layers": {"closed": self.layers[0], "opened": self.layers[1]},
            "with_doubled_cells": {"closed": self.doubled[0], "opened": self.doubled[1]},
            "regions": [
                {
                    "kind": region.kind,
                    "litres": region.litres,
                    "min": region.bounds.min.tolist(),
                    "max": region.bounds.max.tolist(),
                    "hulls": list(region.hulls),
                }
                for region in self.regions
            ],
        }


class ClearanceCheck(MeasureCheck):
    """What hulls close and open of the space that can be reached, against the visual mesh and the hulls before."""

    name = "clearance"
    has_cells = True

    def measure(self, subject: CheckSubject) -> CheckFindings:
        mesh, was = subject.sound, subject.sound_before
        space = measure_clearance(mesh, cell=subject.cell)
        edit = measure_clearance(mesh, was, cell=subject.cell) if was and was.hulls else None
        found = {key: one for key, one in ((self.name, space), (OF_EDIT, edit)) if one}
        findings = tuple(finding for one in found.values() for finding in one.findings)
        return CheckFindings(findings, found, () if space else (NO_VISUAL_MESH,))


def measure_clearance(
    mesh: SymbolicMesh, before: SymbolicMesh | None = None, *, cell: float | None = None
) -> Clearance | None:
    """Return what the hulls of a mesh close and open, at rest pose, of the space about the visual mesh; None without
    one.

    before: hulls to compare with instead of the visual mesh; cell: of the grid [m], by default the diagonal by 112.
    Space counts as reachable where a path of free cells leads to it from outside: an opening narrower than about two
    cells counts as closed.
    """
    corners = join_corners(() if before or not mesh.asset else mesh.asset.visuals)
    if (not len(corners) and not before) or not mesh.hulls:
        return None
    boxes = [h.aabb for m in (mesh, before) if m for h in m.hulls]
    bounds = Aabb.union([*boxes, *([Aabb.of_points(corners.reshape(-1, 3))] if len(corners) else [])])
    if not bounds.diagonal > 0:
        return None
    fine = _measure(mesh, before, corners, grid_around(bounds, cell))
    rough = _measure(mesh, before, corners, grid_around(bounds, 2 * fine.cell))
    return replace(fine, doubled=(rough.closed, rough.opened))


def measure_kept_space(surface: Surface, shapes: Sequence[Shape]) -> float | None:
    """Return the share of the free space about a surface that stays free beside hulls; None where there is hardly any.

    It is counted as by `measure_clearance`, within the convex hull of the surface: one hull of all keeps nothing of it.
    """
    corners = surface.vertices[surface.faces]
    if is_sheet(corners.reshape(-1, 3)):
        return None
    around = convex_hull(corners.reshape(-1, 3))
    grid = grid_around(Aabb.union([around.aabb, *(shape.aabb for shape in shapes)]))
    free = flood_from_outside(voxelize_surface(grid, corners)) & voxelize_hulls(grid, [around])
    whole = voxels.find_pockets(free)[0] > 0
    if np.count_nonzero(whole) < LEAST_REGION_SHARE * np.count_nonzero(voxelize_hulls(grid, [around])):
        return None
    closed = whole & ~flood_from_outside(voxelize_hulls(grid, shapes))
    return 1.0 - np.count_nonzero(voxels.find_pockets(closed)[0]) / np.count_nonzero(whole)


def _measure(mesh: SymbolicMesh, before: SymbolicMesh | None, corners: Floats, grid: Grid) -> Clearance:
    old = voxelize_hulls(grid, (h.shape for h in before.hulls)) if before else voxelize_surface(grid, corners)
    new = voxelize_hulls(grid, (h.shape for h in mesh.hulls))
    was, now = flood_from_outside(old), flood_from_outside(new)
    closed, opened = was & ~now, now & ~was & ~old if not before else now & ~was
    regions, sums, layers = [], [], []
    masks: tuple[tuple[RegionKind, Mask], ...] = (("closed", closed), ("opened", opened))
    for kind, mask in masks:
        numbers, count = voxels.find_pockets(mask)
        found: list[Mask] = [numbers == k + 1 for k in range(min(count, _REGIONS))]
        regions += [_build_region(kind, part, grid, mesh) for part in found]
        sums.append(grid.litres(numbers > 0))
        layers.append(grid.litres(mask & (numbers == 0)))
    regions.sort(key=lambda region: -region.litres)
    box = grid.cell**3 * float(np.prod(np.array(grid.shape) - 4)) * 1000
    reference = "hulls before" if before else "visual mesh"
    return Clearance(reference, grid.cell, sums[0], sums[1], (layers[0], layers[1]), (0.0, 0.0), box, tuple(regions))


def _build_region(kind: RegionKind, part: Mask, grid: Grid, mesh: SymbolicMesh) -> ClearanceRegion:
    cells = np.argwhere(part)
    low = grid.origin + cells.min(axis=0) * grid.cell
    bounds = Aabb(low, grid.origin + (cells.max(axis=0) + 1) * grid.cell)
    near = [h for h in mesh.hulls if kind == "closed" and h.aabb.touches(bounds)]
    shares = [(np.count_nonzero(voxelize_hulls(grid, [h.shape]) & part), h.name) for h in near]
    hulls = tuple(name for count, name in sorted(shares, key=lambda s: (-s[0], s[1])) if count)
    return ClearanceRegion(kind, grid.litres(part), bounds, hulls, voxels.cells_to_surface(grid, part))


def _to_finding(region: ClearanceRegion, found: Clearance) -> Finding:
    size = " × ".join(f"{side:.3g}" for side in region.bounds.size)
    where = f"{region.litres:.3g} l about {', '.join(f'{x:.3g}' for x in region.bounds.center)} ({size} m)"
    if region.kind == "closed":
        by = f" by {join_names(region.hulls)}" if region.hulls else ", enclosed on all sides"
        remedy = "Split these hulls, or decompose the part again with --hollow or a finer threshold."
        message = f"{where}: free and reachable in the {found.reference}, closed{by}"
        return Finding("clearance-closed", "warning", region.hulls, message, remedy)
    message = f"{where}: not reachable in the {found.reference}, open between the hulls"
    remedy = "Add hulls there, or grow those beside it; or that is what was wanted."
    return Finding("clearance-opened", "warning", (), message, remedy)
