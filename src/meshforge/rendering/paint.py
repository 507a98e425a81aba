"""Pixels of a drawing: lit solid things with their outlines, shells over them, and a shadow on the ground."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats, Ints
from meshforge.rendering.annotation import text_scale
from meshforge.rendering.camera import Camera, Floats32
from meshforge.rendering.light import compute_openness, shade
from meshforge.rendering.raycast import DrawLayer, RayHits, ViewFrame, cast_layer, neighbour_slices
from meshforge.rendering.scene import RayScene

LineStrengths = npt.NDArray[np.uint8]
CREASE, BORDER, SILHOUETTE = 1, 2, 3
_SHARP = np.cos(np.radians(24.0))  # edges flatter than this are left out: they are tessellation, not form

_INK = np.array([0.10, 0.12, 0.16], np.float32)
_STRENGTH = np.array([0.0, 0.22, 0.80, 0.92], np.float32)  # of no line, a crease, a border, a silhouette
_CORNER = 0.55  # how much darker a place without any sky is
_SAME_DEPTH = 5e-4  # shells this little behind a solid thing count as before it, in diagonals
_SHADOW = 0.36  # how dark the ground is where it sees no sky


@dataclass(frozen=True, eq=False, slots=True)
class Raster:
    """A drawing: pixels (h, w, 4), premultiplied, in 0..1; items (h, w), the solid things seen, -1 for none."""

    pixels: Floats32
    items: Ints


class Framebuffer:
    """Premultiplied pixels; black with the alpha (h, w) given, at first."""

    def __init__(self, alpha: Floats32) -> None:
        self._shape = alpha.shape
        self._rgb = np.zeros((alpha.size, 3), np.float32)
        self._alpha = np.ascontiguousarray(alpha, np.float32).ravel()

    def blend(self, rows: Ints, columns: Ints, color: Floats32, share: Floats32 | None = None) -> None:
        """Lay colours (n, 3) over pixels (n,), as much of them as `share` (n,) in 0..1 says, wholly by default."""
        at = rows * self._shape[1] + columns
        if share is None:
            self._rgb[at], self._alpha[at] = color, 1.0
            return
        keep = 1 - share
        self._rgb[at] = self._rgb[at] * keep[:, None] + color * share[:, None]
        self._alpha[at] = self._alpha[at] * keep + share

    def downsample(self, fine: int) -> Floats32:
        """Return the mean (h, w, 4) of each block of `fine` times `fine` pixels."""
        height, width = self._shape
        out = np.empty((height // fine, width // fine, 4), np.float32)
        for part, values in ((slice(0, 3), self._rgb.reshape(height, width, 3)), (slice(3, 4), self._alpha)):
            blocks = values.reshape(height, width, -1)
            total = sum(blocks[r::fine, c::fine] for r in range(fine) for c in range(fine))
            out[..., part] = total / np.float32(fine * fine)
        return out


def pixels_where(mask: Any) -> tuple[Ints, Ints]:
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


def paint(layers: Sequence[DrawLayer], frame: ViewFrame, camera: Camera, fine: int) -> Raster:
    """Return the drawing, of the camera's size, from `fine` times as many rays along each side.

    layers: a solid one, then shells.
    """
    close = camera.supersample(fine)
    solid = cast_layer(layers[0], frame, close)
    openness = compute_openness(solid, frame, close)
    buffer = Framebuffer((1 - openness) * np.float32(_SHADOW))
    rows, columns = pixels_where(solid.item >= 0)
    color = _shade_surface(layers[0], solid, frame, close, rows, columns)
    color *= (1 - _CORNER * (1 - openness[rows, columns]))[:, None]
    color += (1 - color) * (0.55 * _is_between_stripes(layers[0], solid)[rows, columns])[:, None]
    buffer.blend(rows, columns, color)
    width = max(2, round(1.1 * fine * min(text_scale(camera.size), 2.0)))
    drawn = trace_lines(solid, width)
    rows, columns = pixels_where(drawn)
    buffer.blend(rows, columns, _INK, _STRENGTH[drawn[rows, columns]])  # dark lines over the picture
    for layer in layers[1:]:
        hits = cast_layer(layer, frame, close)
        share = _shell_shares(layer, hits, solid, close)
        _draw_shell(buffer, layer, hits, share, frame, close)
        _draw_shell_lines(
            buffer, layer, hits, np.where(_is_lines_only(layer, solid), 0.7, 1.6 * share).clip(0, 1), width
        )
    return Raster(buffer.downsample(fine), solid.item[fine // 2 :: fine, fine // 2 :: fine])


def _shade_surface(
    layer: DrawLayer, hits: RayHits, frame: ViewFrame, camera: Camera, rows: Ints, columns: Ints
) -> Floats32:
    """The lit colours (n, 3) of what some pixels show; flat triangles are lit once, round ones at every pixel."""
    scene = hits.scene
    if layer.tint is not None:
        return _shade_tint(layer.tint, hits, frame, camera, rows, columns)
    base = np.asarray(layer.colors, dtype=np.float64)[scene.item]
    triangle = hits.triangle[rows, columns]
    color = shade(base, scene.normals, camera, frame.upright)[triangle]
    bent = np.nonzero(scene.is_round[triangle])[0]
    if len(bent):
        normals = scene.smooth_normals(triangle[bent], hits.points(camera, rows[bent], columns[bent]))
        color[bent] = shade(base[triangle[bent]], normals, camera, frame.upright)
    return color


def _shade_tint(
    tint: Callable[[Floats, Ints], Floats], hits: RayHits, frame: ViewFrame, camera: Camera, rows: Ints, columns: Ints
) -> Floats32:
    """The lit colours (n, 3) of pixels whose colours depend on the place that they show."""
    triangle = hits.triangle[rows, columns]
    points = frame.from_unit(hits.points(camera, rows, columns))
    return shade(tint(points, hits.scene.item[triangle]), hits.scene.normals[triangle], camera, frame.upright)


def _shell_shares(layer: DrawLayer, hits: RayHits, solid: RayHits, camera: Camera) -> Floats32:
    share = np.zeros(hits.item.shape, np.float32)
    share[hits.item >= 0] = layer.before
    rows, columns = pixels_where((hits.item >= 0) & (solid.item >= 0))
    farther = hits.depth(camera, rows, columns) > solid.depth(camera, rows, columns) + _SAME_DEPTH
    share[rows[farther], columns[farther]] = layer.behind
    share[_is_between_stripes(layer, hits)] *= 0.45
    share[_is_lines_only(layer, solid)] = 0.0
    return share


def _is_lines_only(layer: DrawLayer, solid: RayHits) -> Any:
    """Which pixels (h, w) show a solid thing over which a layer is only drawn in lines."""
    return np.isin(solid.item, sorted(layer.drawn_over)) if layer.drawn_over else np.zeros(solid.item.shape, bool)


def _is_between_stripes(layer: DrawLayer, hits: RayHits) -> Any:
    """Which pixels (h, w) lie between the diagonal stripes of hatched things, sixty stripes across the picture."""
    if not layer.hatched:
        return np.zeros(hits.item.shape, dtype=bool)
    height, width = hits.item.shape
    period = max(4, (width + height) // 120)
    gap = (np.arange(height)[:, None] + np.arange(width)) % period >= period // 2
    return gap & np.isin(hits.item, sorted(layer.hatched))


def _draw_shell(
    buffer: Framebuffer, layer: DrawLayer, hits: RayHits, share: Floats32, frame: ViewFrame, camera: Camera
) -> None:
    rows, columns = pixels_where(share > 0)
    buffer.blend(rows, columns, _shade_surface(layer, hits, frame, camera, rows, columns), share[rows, columns])


def _draw_shell_lines(buffer: Framebuffer, layer: DrawLayer, hits: RayHits, share: Floats32, width: int) -> None:
    """Lays the lines of a shell over the picture, in its own darkened colours, as strong as `share` (h, w)."""
    drawn = trace_lines(hits, width)
    rows, columns = pixels_where((drawn > 0) & (hits.item >= 0))
    color = 0.7 * layer.colors.astype(np.float32)[hits.item[rows, columns]]
    buffer.blend(rows, columns, color, _STRENGTH[drawn[rows, columns]] * share[rows, columns])
