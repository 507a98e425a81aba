"""Pixels of a drawing: solid things lit, with their outlines, shells over them, and the soft shadow on the ground."""

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
_SKY_REACH = 0.35  # how far away things still darken a point, in diagonals
_RAYS = 16
_LIFT = 2e-3  # rays start this far above the surface, in diagonals

_SKY_STEP = 4  # the sky is looked at once in so many pixels along each side
_DITHER = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]]) / 16
"""How the pattern of rays is turned, in 0..1: sixteen ways in every block of four by four cells."""
_FLAT = 0.05  # rays that fall by less of their length do not meet the ground


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


def _measure_free_share(scene: RayScene, points: Floats, normals: Floats, turn: Floats) -> Floats32:
    """The share (n,) of the sky above points (n, 3) that nothing blocks near by.

    turn: (n,) in 0..1, how the pattern of rays is turned there; neighbours that differ can be averaged.
    """
    if len(points) == 0:
        return np.zeros(0, np.float32)
    first = np.cross(normals, np.where(np.abs(normals[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]]))
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(normals, first)
    origins = (points + normals * _LIFT).astype(np.float32)
    free = np.zeros(len(points), np.float32)
    above, aside, across = (a.astype(np.float32) for a in (normals, first, second))
    for k in range(_RAYS):
        radius = np.float32(np.sqrt((k + 0.5) / _RAYS))  # cosine weighted: a disc lifted onto the hemisphere
        angle = (2 * np.pi * (k * 0.6180339887498949 + turn)).astype(np.float32)
        x, y = radius * np.cos(angle), radius * np.sin(angle)
        directions = aside * x[:, None] + across * y[:, None] + above * np.sqrt(1 - radius * radius)
        free += ~scene.is_blocked(origins, directions, _SKY_REACH)
    return free / np.float32(_RAYS)


def compute_openness(hits: RayHits, frame: ViewFrame, camera: Camera) -> Floats32:
    """Return how open (h, w) in 0..1 the places are that pixels show; of pixels that show nothing, the ground there."""
    found = np.ones(hits.item.shape, np.float32)
    if not len(hits.scene.corners):
        return found
    half = _SKY_STEP // 2
    coarse = hits.triangle[half::_SKY_STEP, half::_SKY_STEP]
    r, c = (places.ravel() for places in np.indices(coarse.shape))
    rows, columns, seen = r * _SKY_STEP + half, c * _SKY_STEP + half, coarse.ravel() >= 0
    points = _ground_points(frame, camera, rows, columns)
    points[seen] = hits.points(camera, rows[seen], columns[seen])
    normals = np.where(seen[:, None], hits.scene.normals[coarse.ravel()], frame.upright)
    away = np.einsum("ij,ij->i", normals, camera.directions_to_eye(points)) < 0
    normals[away & seen] *= -1
    low, high = (end(hits.scene.corners.reshape(-1, 3), axis=0) for end in (np.min, np.max))
    near = np.flatnonzero(((points > low - _SKY_REACH) & (points < high + _SKY_REACH)).all(axis=1))
    grid = np.ones(coarse.size, np.float32)
    grid[near] = _measure_free_share(hits.scene, points[near], normals[near], _DITHER[r % 4, c % 4][near])
    grid = _smooth(grid.reshape(coarse.shape), np.append(hits.scene.facet, -1)[coarse])
    high, wide = (np.minimum(np.arange(found.shape[k]) // _SKY_STEP, grid.shape[k] - 1) for k in (0, 1))
    fine = np.nonzero((grid < 1)[np.ix_(high, wide)])
    found[fine] = _upsample(grid, coarse, hits, *fine)
    return found


def _ground_points(frame: ViewFrame, camera: Camera, rows: Ints, columns: Ints) -> Floats:
    """Where the rays through pixels meet the ground (n, 3); those that do not, or nearly along it, far away."""
    origins, directions = camera.pixel_rays(columns, rows)
    fall = -(directions @ frame.upright)
    lowest = float((frame.to_unit(frame.bounds.corners) @ frame.upright).min())
    depth = (origins @ frame.upright - lowest) / np.where(fall > _FLAT, fall, 1e-9)
    return origins + directions * depth[:, None]


def _smooth(grid: Floats32, facet: Ints) -> Floats32:
    """Each cell mixed with those around it on the same facet, such that a pattern of four cells averages out."""
    for axis in (0, 1):
        total, weight = 2 * grid, np.full(grid.shape, 2, np.float32)
        for step, share in ((1, 2), (2, 1)):
            for here, there in (neighbour_slices(axis, step), neighbour_slices(axis, step)[::-1]):
                same = share * (facet[here] == facet[there]).astype(np.float32)
                total[here] += grid[there] * same
                weight[here] += same
        grid = total / weight
    return grid


def _upsample(grid: Floats32, coarse: Ints, hits: RayHits, rows: Ints, columns: Ints) -> Floats32:
    """Values of a coarse grid at fine pixels: from the nearest cells, of the same facet where there are any."""
    facet_of = np.append(hits.scene.facet, -1)
    item_of = np.append(hits.scene.item, -1).astype(np.int32)
    facets, items = facet_of[coarse], item_of[coarse]
    triangle = hits.triangle[rows, columns]
    facet, item = facet_of[triangle], item_of[triangle]
    total, weights = np.zeros(len(rows), np.float32), np.full(len(rows), 1e-6, np.float32)
    for r, rw in _interpolation_taps(rows, grid.shape[0]):
        for c, cw in _interpolation_taps(columns, grid.shape[1]):
            cell = r * grid.shape[1] + c
            weight = ((facets.take(cell) == facet) + np.float32(0.02) * (items.take(cell) == item)) * rw * cw
            total += weight * grid.take(cell)
            weights += weight
    return np.where(weights > 1e-5, total / weights, np.float32(1.0))


def _interpolation_taps(places: Ints, count: int) -> list[tuple[Ints, Floats32]]:
    """The two coarse cells about each pixel along one side, with their weights; never quite zero."""
    at: Floats32 = (places.astype(np.float32) - np.float32(_SKY_STEP // 2)) / np.float32(_SKY_STEP)
    below: Floats32 = np.floor(at)
    share, low = at - below, below.astype(np.int64)
    return [
        (np.clip(low, 0, count - 1), np.float32(1.01) - share),
        (np.clip(low + 1, 0, count - 1), np.float32(0.01) + share),
    ]


LineStrengths = npt.NDArray[np.uint8]
CREASE, BORDER, SILHOUETTE = 1, 2, 3
_SHARP = np.cos(np.radians(24.0))  # edges flatter than this are left out: they are tessellation, not form

_INK = np.array([0.10, 0.12, 0.16], np.float32)
_STRENGTH = np.array([0.0, 0.22, 0.80, 0.92], np.float32)  # of no line, a crease, a border, a silhouette
_CORNER = 0.55  # how much darker a place without any sky is
_SAME_DEPTH = 5e-4  # shells this little behind a solid thing count as before it, in diagonals
_SHADOW = 0.36  # how dark the ground is where it sees no sky


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
    openness = compute_openness(solid, frame, close)
    pixels = np.zeros((*openness.shape, 4), np.float32)
    pixels[..., 3] = (1 - openness) * np.float32(_SHADOW)
    rows, columns = _pixels_where(solid.item >= 0)
    color = shade_surface(layers[0], solid, frame, close, rows, columns)
    color *= (1 - _CORNER * (1 - openness[rows, columns]))[:, None]
    color += (1 - color) * (0.55 * _find_pattern(layers[0].hatched, solid)[rows, columns])[:, None]
    color *= (1 - 0.4 * _find_pattern(layers[0].dotted, solid, dots=True)[rows, columns])[:, None]
    pixels[rows, columns, :3], pixels[rows, columns, 3] = color, 1.0
    width = max(2, round(1.1 * fine * min(text_scale(camera.size), 2.0)))
    drawn = trace_lines(solid, width)
    rows, columns = _pixels_where(drawn)
    _blend(pixels, rows, columns, _INK, _STRENGTH[drawn[rows, columns]])  # dark lines over the picture
    for layer in layers[1:]:
        _paint_shell(pixels, layer, solid, frame, close, width)
    height, across = (side // fine for side in openness.shape)
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
