"""Pixels of a drawing: solid things with light and lines, shells over them, and a soft shadow on the ground."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.views.camera import Camera, Singles
from meshforge.views.corners import sky
from meshforge.views.film import Film, Painted, spots
from meshforge.views.ground import ground_shadow
from meshforge.views.light import lit
from meshforge.views.outline import Lines, lines
from meshforge.views.stage import Hits, Layer, Stage, cast
from meshforge.views.text import unit

_INK = np.array([0.10, 0.12, 0.16], np.float32)
_STRENGTH = np.array([0.0, 0.22, 0.80, 0.92], np.float32)  # of no line, a crease, a border, a silhouette
_CORNER = 0.55  # how much darker a place without any sky is
_SAME_DEPTH = 5e-4  # shells this little behind a solid thing count as before it, in diagonals
_SHADE = 0.36  # how dark the ground is where it sees no sky


def paint(layers: Sequence[Layer], stage: Stage, camera: Camera, fine: int) -> Painted:
    """The drawing, of the camera's size, from `fine` times as many rays along each side.

    layers: a solid one, then shells.
    """
    close = camera.supersample(fine)
    solid = cast(layers[0], stage, close)
    film = Film(ground_shadow(solid.scene, stage, close) * np.float32(_SHADE))
    width = max(2, round(1.1 * fine * min(unit(camera.size), 2.0)))
    _draw_solid(film, layers[0], solid, stage, close)
    _ink(film, lines(solid, width))
    for layer in layers[1:]:
        hits = cast(layer, stage, close)
        share = _shares(layer, hits, solid, close)
        _draw_shell(film, layer, hits, share, stage, close)
        _ink_shell(film, layer, hits, np.where(_beyond(layer, solid), 0.7, 1.6 * share).clip(0, 1), width)
    return Painted(film.downsample(fine), solid.item[fine // 2 :: fine, fine // 2 :: fine])


def _draw_solid(film: Film, layer: Layer, hits: Hits, stage: Stage, camera: Camera) -> None:
    rows, columns = spots(hits.item >= 0)
    color = _surface(layer, hits, stage, camera, rows, columns)
    openness = sky(hits, camera, rows, columns)
    color *= (1 - _CORNER * (1 - openness))[:, None]
    color += (1 - color) * (0.55 * _hatching(layer, hits)[rows, columns])[:, None]
    film.blend(rows, columns, color)


def _surface(layer: Layer, hits: Hits, stage: Stage, camera: Camera, rows: Ints, columns: Ints) -> Singles:
    """The lit colours (n, 3) of what some pixels show; flat triangles are lit once, round ones at every pixel."""
    scene = hits.scene
    if layer.tint is not None:
        return _tinted(layer.tint, hits, stage, camera, rows, columns)
    base = np.asarray(layer.colors, dtype=np.float64)[scene.item]
    triangle = hits.triangle[rows, columns]
    color = lit(base, scene.normals, camera, stage.upright)[triangle]
    bent = np.nonzero(scene.is_round[triangle])[0]
    if len(bent):
        points = hits.points(camera, rows[bent], columns[bent])
        normals = scene.smooth_normals(triangle[bent], points)
        color[bent] = lit(base[triangle[bent]], normals, camera, stage.upright)
    return color


def _tinted(
    tint: Callable[[Floats, Ints], Floats], hits: Hits, stage: Stage, camera: Camera, rows: Ints, columns: Ints
) -> Singles:
    """The lit colours (n, 3) of pixels whose colours depend on the place that they show."""
    triangle = hits.triangle[rows, columns]
    points = stage.from_unit(hits.points(camera, rows, columns))
    return lit(tint(points, hits.scene.item[triangle]), hits.scene.normals[triangle], camera, stage.upright)


def _shares(layer: Layer, hits: Hits, solid: Hits, camera: Camera) -> Singles:
    """How much of a shell each pixel (h, w) shows."""
    share = np.zeros(hits.item.shape, np.float32)
    share[hits.item >= 0] = layer.before
    rows, columns = spots((hits.item >= 0) & (solid.item >= 0))
    farther = hits.depth(camera, rows, columns) > solid.depth(camera, rows, columns) + _SAME_DEPTH
    share[rows[farther], columns[farther]] = layer.behind
    share[_hatching(layer, hits)] *= 0.45
    share[_beyond(layer, solid)] = 0.0
    return share


def _beyond(layer: Layer, solid: Hits) -> Any:
    """Which pixels (h, w) show a solid thing over which a layer is only drawn in lines."""
    return np.isin(solid.item, sorted(layer.drawn_over)) if layer.drawn_over else np.zeros(solid.item.shape, bool)


def _hatching(layer: Layer, hits: Hits) -> Any:
    """Which pixels (h, w) lie between the diagonal stripes of hatched things, sixty stripes across the picture."""
    if not layer.hatched:
        return np.zeros(hits.item.shape, dtype=bool)
    height, width = hits.item.shape
    period = max(4, (width + height) // 120)
    gap = (np.arange(height)[:, None] + np.arange(width)) % period >= period // 2
    return gap & np.isin(hits.item, sorted(layer.hatched))


def _draw_shell(film: Film, layer: Layer, hits: Hits, share: Singles, stage: Stage, camera: Camera) -> None:
    rows, columns = spots(share > 0)
    color = _surface(layer, hits, stage, camera, rows, columns)
    film.blend(rows, columns, color, share[rows, columns])


def _ink(film: Film, drawn: Lines) -> None:
    """Lays dark lines over the picture."""
    rows, columns = spots(drawn)
    film.blend(rows, columns, _INK, _STRENGTH[drawn[rows, columns]])


def _ink_shell(film: Film, layer: Layer, hits: Hits, share: Singles, width: int) -> None:
    """Lays the lines of a shell over the picture, in its own darkened colours, as strong as `share` (h, w)."""
    drawn = lines(hits, width)
    rows, columns = spots((drawn > 0) & (hits.item >= 0))
    color = 0.7 * layer.colors.astype(np.float32)[hits.item[rows, columns]]
    film.blend(rows, columns, color, _STRENGTH[drawn[rows, columns]] * share[rows, columns])
