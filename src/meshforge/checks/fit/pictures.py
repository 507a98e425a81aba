"""Heat maps of a fit: hulls by how far they stick out, the visual mesh by how far it lies off all hulls."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from meshforge.asset import Surface
from meshforge.checks.fit.fit import MATTERS, Fit, Group
from meshforge.geometry import Floats, Ints
from meshforge.symbolic import SymbolicMesh
from meshforge.views import View, heat

if TYPE_CHECKING:
    from PIL.Image import Image


def fit_pictures(
    mesh: SymbolicMesh, found: Fit, *, view: View = "iso", size: tuple[int, int] = (640, 480)
) -> tuple[Image, Image] | None:
    """Two pictures: the hulls by how far they stick out, and the visual mesh by how far it lies off all hulls.

    None where nothing is shown. The strongest colour is for twice the length that matters; what
    is below a cell has none.
    """
    if not found.groups:
        return None
    most = max(2 * MATTERS * found.diagonal, 4 * found.cell)
    hulls = [hull.shape.tessellate() for group in found.groups for hull in group.hulls]
    seen = [_surface(group.visual_surface.corners) for group in found.groups]

    group_of = np.array([k for k, group in enumerate(found.groups) for _ in group.hulls])

    def out(points: Floats, items: Ints) -> Floats:
        return _by_group(found.groups, points, group_of[items], Group.measure_out)

    def bare(points: Floats, items: Ints) -> Floats:
        return _by_group(found.groups, points, items, lambda group, some: group.measure_bare(some)[0])

    titles = "hulls: how far they stick out", "visual mesh: how far off all hulls"
    return (
        heat(mesh, hulls, out, most, view=view, size=size, title=titles[0]),
        heat(mesh, seen, bare, most, view=view, size=size, title=titles[1]),
    )


def _by_group(
    groups: Sequence[Group], points: Floats, which: Ints, measure: Callable[[Group, Floats], Floats]
) -> Floats:
    """What `measure` gives for each point (n, 3) by the group (n,) that it belongs to."""
    values = np.zeros(len(points))
    for k in np.unique(which):
        values[which == k] = measure(groups[k], points[which == k])
    return values


def _surface(corners: Floats) -> Surface:
    return Surface(corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3))
