"""Lines of a drawing: silhouettes, borders between hulls, and the sharp edges of one hull."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Ints
from meshforge.views.scene import Scene
from meshforge.views.stage import Hits

Lines = npt.NDArray[np.uint8]
CREASE, BORDER, SILHOUETTE = 1, 2, 3
_SHARP = np.cos(np.radians(24.0))  # edges flatter than this are left out: they are tessellation, not form


def lines(hits: Hits, width: int) -> Lines:
    """The strongest line through each pixel (h, w), 0 where there is none, drawn `width` pixels wide."""
    whole = np.zeros(hits.item.shape, np.uint8)
    triangle, item = hits.triangle[hits.window], hits.item[hits.window]
    found = np.zeros(item.shape, np.uint8)
    for axis in (0, 1):
        a, b = along(axis)
        steps = _steps(hits.scene, triangle[a], triangle[b], item[a], item[b])
        np.maximum(found[a], steps, out=found[a])
        if width > 1:
            np.maximum(found[b], steps, out=found[b])
    whole[hits.window] = _widened(found, width - 2)
    return whole


def along(axis: int, step: int = 1) -> tuple[tuple[slice, slice], tuple[slice, slice]]:
    """The pixels that have one `step` further along an axis, and those."""
    first, second, whole = slice(None, -step), slice(step, None), slice(None)
    return ((first, whole), (second, whole)) if axis == 0 else ((whole, first), (whole, second))


def _steps(scene: Scene, here: Ints, there: Ints, mine: Ints, theirs: Ints) -> Lines:
    steps = np.zeros(here.shape, np.uint8)
    at = np.nonzero(here != there)
    first, second = mine[at], theirs[at]
    cosine = np.einsum("ij,ij->i", scene.normals[here[at]], scene.normals[there[at]])
    within = np.where(cosine < _SHARP, CREASE, 0)
    between = np.where((first < 0) | (second < 0), SILHOUETTE, BORDER)
    steps[at] = np.where(first == second, within, between)
    return steps


def _widened(found: Lines, by: int) -> Lines:
    """Borders grown by some pixels, right and down in turn; silhouettes by one more; creases stay thin."""
    for strength, steps in ((BORDER, by), (SILHOUETTE, by + 1)):
        strong = np.where(found >= strength, found, 0)
        for step in range(steps):
            for axis in (0, 1):
                a, b = along(axis) if step % 2 else along(axis)[::-1]
                np.maximum(strong[b], strong[a].copy(), out=strong[b])
        found = np.maximum(found, strong)
    return found
