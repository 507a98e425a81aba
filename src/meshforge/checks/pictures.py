"""Pictures of what was measured: heat maps of a fit, and the space that hulls close and open."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from meshforge.checks.clearance import Clearance
from meshforge.checks.examination import Examination
from meshforge.checks.fit import LEAST_GAP_SHARE, FitGroup, MeshFit
from meshforge.geometry import Floats, Ints
from meshforge.rendering import draw_heat_map, draw_volumes
from meshforge.symbolic import Surface, SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image


COLORS = {"closed": "#D64545", "opened": "#3B7DD8"}


def draw_examination(
    mesh: SymbolicMesh, found: Examination, size: tuple[int, int] = (640, 480)
) -> Iterator[tuple[str, str, Image]]:
    """A name for a file, a line of text and a picture each: heat maps of the fit, and what was closed and opened."""
    maps = draw_fit(mesh, found.fit, size) if found.fit else None
    if maps and found.fit:
        yield "fit-out", f"hulls stick out by {found.fit.out:.3g} m at most", maps[0]
        yield "fit-bare", f"visual mesh, {found.fit.bare:.3g} m off all hulls at most", maps[1]
    for name, part in (("clearance", found.clearance), ("clearance-of-edit", found.changed)):
        if part and part.regions:
            yield (
                name,
                f"{part.reference}: {part.closed:.3g} l closed, {part.opened:.3g} l opened",
                _draw_clearance(mesh, part, size),
            )


def _draw_clearance(mesh: SymbolicMesh, found: Clearance, size: tuple[int, int]) -> Image:
    marked = [(region.kind, COLORS[region.kind], region.surface) for region in found.regions]
    return draw_volumes(mesh, marked, size=size, title=f"space about the {found.reference}")


def draw_fit(mesh: SymbolicMesh, found: MeshFit, size: tuple[int, int] = (640, 480)) -> tuple[Image, Image] | None:
    """Two pictures: the hulls by how far they stick out, and the visual mesh by how far it lies off all hulls.

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
        draw_heat_map(mesh, hulls, out, most, size=size, title=titles[0]),
        draw_heat_map(mesh, seen, bare, most, size=size, title=titles[1]),
    )


def _measure_by_group(
    groups: Sequence[FitGroup], points: Floats, which: Ints, measure: Callable[[FitGroup, Floats], Floats]
) -> Floats:
    """What `measure` gives for each point (n, 3) by the group (n,) that it belongs to."""
    values = np.zeros(len(points))
    for k in np.unique(which):
        values[which == k] = measure(groups[k], points[which == k])
    return values
