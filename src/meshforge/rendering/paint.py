"""Pixels of a drawing: solid things lit, with their outlines, and shells over them."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats, Ints
from meshforge.rendering.annotation import text_scale
from meshforge.rendering.camera import Camera, Floats32
from meshforge.rendering.colors import to_linear
from meshforge.rendering.raycast import DrawLayer, RayHits, ViewFrame, cast_layer, neighbour_slices
from meshforge.rendering.scene import RayScene

_KEY = np.array([-0.42, 0.72, 0.62])  # right, up, towards the eye: over the left shoulder
_FILL = np.array([0.85, 0.10, 0.45])


def shade(colors: Floats, normals: Floats, camera: Camera, upright: Floats) -> Floats32:
    """Return the colours (n, 3), sRGB in 0..1, of surfaces with such normals (n, 3); double-sided."""
    normals = normals * np.where(normals @ camera.axes[2] < 0, -1.0, 1.0)[:, None]
    key, fill = (np.clip(normals @ (d @ camera.axes / np.linalg.norm(d)), 0, None) for d in (_KEY, _FILL))
    sky = 0.5 + 0.5 * normals @ upright
    strength = 0.52 + 0.28 * sky + 0.44 * key + 0.14 * fill
    bright = to_linear(colors) * strength[:, None]
    over = np.clip(bright - 0.8, 0, None)  # values above are bent towards one, so that light faces keep their colour
    bright = np.minimum(bright, 0.8) + 0.2 * (1 - np.exp(-over / 0.2))
    return np.where(bright <= 0.0031308, bright * 12.92, 1.055 * bright ** (1 / 2.4) - 0.055).astype(np.float32)


LineStrengths = npt.NDArray[np.uint8]
CREASE, BORDER, SILHOUETTE = 1, 2, 3
_SHARP = np.cos(np.radians(24.0))  # edges flatter than this are left out: they are tessellation, not form

_INK = np.array([0.10, 0.12, 0.16], np.float32)
_STRENGTH = np.array([0.0, 0.22, 0.80, 0.92], np.float32)  # of no line, a crease, a border, a silhouette
_SAME_DEPTH = 5e-4  # shells this little behind a solid thing count as before it, in diagonals


def _blend(pixels: Floats32, rows: Ints, columns: Ints, color: Floats32, share: Floats32) -> None:
    """Lay colours (n, 3) over premultiplied pixels (h, w, 4), as much of them as `share` (n,) in 0..1 says."""
    over = np.column_stack([color * share[:, None], share])
    pixels[rows, columns] = pixels[rows, columns] * (1 - share)[:, None] + over


def _pixels_where(mask: Any) -> tuple[Ints, Ints]:
    """Return rows and columns of the pixels (h, w) that are set; quicker than `nonzero`."""
    rows, columns = np.divmod(np.flatnonzero(mask), mask.shape[1])
    return rows, columns


def trace_lines(hits: RayHits, width: int) -> LineStrengths:
    """Return the strongest line through each pixel (h, w), 0 where there is none, drawn `width` pixels wide."""
    whole = np.zeros(hits.item.shape, np.uint8)
    triangle, item = hits.triangle[hits.window], hits.item[hits.window]
    found = np.zeros(item.shape, np.uint8)
    for axis in (0, 1):
        a, b = neighbour_slices(axis)
        steps = _classify_steps(hits.scene, triangle[a], triangle[b], item[a], item[b])
        np.maximum(found[a], steps, out=found[a])
        if width > 1:
            np.maximum(found[b], steps, out=found[b])
    whole[hits.window] = _widen(found, width - 2)
    return whole


def _classify_steps(scene: RayScene, here: Ints, there: Ints, mine: Ints, theirs: Ints) -> LineStrengths:
    steps = np.zeros(here.shape, np.uint8)
    at = np.nonzero(here != there)
    first, second = mine[at], theirs[at]
    within = np.where(np.einsum("ij,ij->i", scene.normals[here[at]], scene.normals[there[at]]) < _SHARP, CREASE, 0)
    between = np.where((first < 0) | (second < 0), SILHOUETTE, BORDER)
    steps[at] = np.where(first == second, within, between)
    return steps


def _widen(found: LineStrengths, by: int) -> LineStrengths:
    """Borders grown by some pixels, right and down in turn; silhouettes by one more; creases stay thin."""
    for strength, steps in ((BORDER, by), (SILHOUETTE, by + 1)):
        strong = np.where(found >= strength, found, 0)
        for step in range(steps):
            for axis in (0, 1):
                a, b = neighbour_slices(axis) if step % 2 else neighbour_slices(axis)[::-1]
                np.maximum(strong[b], strong[a].copy(), out=strong[b])
        found = np.maximum(found, strong)
    return found


def paint(layers: Sequence[DrawLayer], frame: ViewFrame, camera: Camera, fine: int) -> tuple[Floats32, Ints]:
    """Return a drawing: pixels (h, w, 4), premultiplied, in 0..1, and items (h, w), the solid things seen, -1 for none.

    layers: a solid one, then shells; fine: how many times as many rays there are along each side.
    """
    close = camera.supersample(fine)
    solid = cast_layer(layers[0], frame, close)
    pixels = np.zeros((*solid.item.shape, 4), np.float32)
    rows, columns = _pixels_where(solid.item >= 0)
    color = shade_surface(layers[0], solid, frame, close, rows, columns)
    color += (1 - color) * (0.55 * _find_pattern(layers[0].hatched, solid)[rows, columns])[:, None]
    color *= (1 - 0.4 * _find_pattern(layers[0].dotted, solid, dots=True)[rows, columns])[:, None]
    pixels[rows, columns, :3], pixels[rows, columns, 3] = color, 1.0
    width = max(2, round(1.1 * fine * min(text_scale(camera.size), 2.0)))
    drawn = trace_lines(solid, width)
    rows, columns = _pixels_where(drawn)
    _blend(pixels, rows, columns, _INK, _STRENGTH[drawn[rows, columns]])  # dark lines over the picture
    for layer in layers[1:]:
        _paint_shell(pixels, layer, solid, frame, close, width)
    height, across = (side // fine for side in solid.item.shape)
    mean: Floats32 = pixels.reshape(height, fine, across, fine, 4).mean(axis=(1, 3))
    return mean, solid.item[fine // 2 :: fine, fine // 2 :: fine]


def _paint_shell(
    pixels: Floats32, layer: DrawLayer, solid: RayHits, frame: ViewFrame, camera: Camera, width: int
) -> None:
    """Lay a shell over the picture, and its lines in its own darkened colours."""
    hits = cast_layer(layer, frame, camera)
    share = np.zeros(hits.item.shape, np.float32)
    share[hits.item >= 0] = layer.before
    rows, columns = _pixels_where((hits.item >= 0) & (solid.item >= 0))
    farther = hits.depth(camera, rows, columns) > solid.depth(camera, rows, columns) + _SAME_DEPTH
    share[rows[farther], columns[farther]] = layer.behind
    share[_find_pattern(layer.hatched, hits)] *= 0.45
    only_lines = np.isin(solid.item, sorted(layer.drawn_over))
    share[only_lines] = 0.0
    rows, columns = _pixels_where(share > 0)
    _blend(pixels, rows, columns, shade_surface(layer, hits, frame, camera, rows, columns), share[rows, columns])
    drawn = trace_lines(hits, width)
    rows, columns = _pixels_where((drawn > 0) & (hits.item >= 0))
    color = 0.7 * layer.colors.astype(np.float32)[hits.item[rows, columns]]
    strong = np.where(only_lines, np.float32(0.7), 1.6 * share).clip(0, 1)[rows, columns]
    _blend(pixels, rows, columns, color, _STRENGTH[drawn[rows, columns]] * strong)


def shade_surface(
    layer: DrawLayer, hits: RayHits, frame: ViewFrame, camera: Camera, rows: Ints, columns: Ints
) -> Floats32:
    """Return the lit colours (n, 3) of what pixels show; flat triangles are lit once, round ones at every pixel."""
    scene = hits.scene
    triangle = hits.triangle[rows, columns]
    if layer.tint is not None:
        colors = layer.tint(frame.from_unit(hits.points(camera, rows, columns)), scene.item[triangle])
        return shade(colors, scene.normals[triangle], camera, frame.upright)
    base = np.asarray(layer.colors, dtype=np.float64)[scene.item]
    color = shade(base, scene.normals, camera, frame.upright)[triangle]
    bent = np.flatnonzero(np.isfinite(scene.bent[triangle, 0, 0]))  # on round surfaces
    if len(bent):
        normals = scene.smooth_normals(triangle[bent], hits.points(camera, rows[bent], columns[bent]))
        color[bent] = shade(base[triangle[bent]], normals, camera, frame.upright)
    return color


def _find_pattern(things: frozenset[int], hits: RayHits, *, dots: bool = False) -> Any:
    """Which pixels (h, w) of some things lie between stripes, sixty across the picture, or on dots as dense."""
    if not things:
        return np.zeros(hits.item.shape, dtype=bool)
    height, width = hits.item.shape
    period = max(4, (width + height) // 120)
    row, column = np.arange(height)[:, None], np.arange(width)
    across, down = (row + column) % period, (row - column) % period
    middle, found = period / 2, across >= period // 2
    if dots:
        found = (across - middle) ** 2 + (down - middle) ** 2 < (period / 4) ** 2
    return found & np.isin(hits.item, sorted(things))
