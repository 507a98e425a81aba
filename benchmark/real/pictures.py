"""Pictures to label by, and to look at what was labelled: pieces in their own colours, or regions by label."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from benchmark.real.regions import RegionPatch
from benchmark.real.surface import AssetSurface, Patch
from meshforge.geometry import Floats
from meshforge.rendering import RenderMesh, View, label_colors, write_png
from meshforge.rendering.annotation import font, shorten
from meshforge.rendering.canvas import Canvas
from meshforge.rendering.colors import HULL_COLORS, HullColors, rgb
from meshforge.rendering.picture import Subject, draw_on_canvas, place_texts
from meshforge.rendering.placement import draw_texts
from meshforge.rendering.raycast import DrawLayer

VIEWS: tuple[View, ...] = ("iso", "iso-back", "front-left-below", "front")
MISSED = "#ff00ff"
"""Of surface that no region has."""
_SIDE, _LIST, _LINE, _MOST = 620, 520, 22, 54  # [px] of a view and the list; lines of the list


def draw_pieces(surface: AssetSurface, path: Path, title: str = "") -> None:
    """Write a picture of the pieces, each in its own colour with its number; a list beside it, the largest first."""
    order = order_pieces(surface)
    colors = _distinct_colors(len(order))
    pieces = [surface.pieces[k] for k in order]
    lines = [(tuple(colors[k]), f"{k}  {describe_piece(surface, piece)}") for k, piece in enumerate(pieces)]
    marks = {k: str(k) for k in range(min(len(pieces), 120))}
    _write(pieces, colors, marks, lines, path, title or surface.name)


def draw_regions(patches: Sequence[RegionPatch], vocabulary: Sequence[str], path: Path, title: str) -> None:
    """Write a picture of regions by label, with the names of parts; what no region has is magenta."""
    known = label_colors(vocabulary)
    colors = np.array([rgb(known[row.label]) if row.label else rgb(MISSED) for row in patches])
    total = sum(row.patch.area for row in patches)
    lines: list[tuple[tuple[float, ...], str]] = []
    for label in [*vocabulary, None]:
        mine = [row for row in patches if row.label == label]
        if mine:
            share = sum(row.patch.area for row in mine) / total
            color = rgb(known[label]) if label else rgb(MISSED)
            lines.append(
                (
                    tuple(color),
                    f"{label or 'NO REGION'}  {share:.1%} of the surface, {len({row.part for row in mine})} parts",
                )
            )
    marks = {k: row.part for k, row in enumerate(patches) if row.part}
    _write([row.patch for row in patches], colors, marks, lines, path, title)


def order_pieces(surface: AssetSurface) -> list[int]:
    """The numbers of the pieces, the largest first."""
    return sorted(range(len(surface.pieces)), key=lambda k: -surface.pieces[k].area)


def describe_piece(surface: AssetSurface, piece: Patch) -> str:
    """Name, box in shares of the asset's box, and share of the surface of a piece."""
    low, high = surface.bounds
    span = np.where(high > low, high - low, 1.0)
    at = [(corner - low) / span for corner in (piece.vertices.min(axis=0), piece.vertices.max(axis=0))]
    box = " ".join(f"{a:.2f}-{b:.2f}" for a, b in zip(*at, strict=True))
    share = piece.area / sum(other.area for other in surface.pieces)
    return f"{piece.name}  [{box}]  {share:.1%}"


def _distinct_colors(count: int) -> Floats:
    """Colours (count, 3), neighbours in the list far apart."""
    return np.array([rgb(HULL_COLORS[k % len(HULL_COLORS)]) for k in range(count)]).reshape(-1, 3)


def _write(
    pieces: Sequence[Patch],
    colors: Floats,
    marks: Mapping[int, str],
    lines: Sequence[tuple[tuple[float, ...], str]],
    path: Path,
    title: str,
) -> None:
    points = np.concatenate([piece.vertices for piece in pieces])
    layer = DrawLayer([RenderMesh(piece.vertices, piece.faces) for piece in pieces], colors)
    what = Subject((layer,), points, "Z")
    rows = -(-len(VIEWS) // 2)
    canvas = Canvas((2 * _SIDE, rows * _SIDE + 60), "light", title, None, HullColors(colors))
    for k, view in enumerate(VIEWS):
        left, top = k % 2 * _SIDE, canvas.room[1] + k // 2 * _SIDE
        box = (left, top, left + _SIDE, min(top + _SIDE, canvas.room[3]))
        items = draw_on_canvas(canvas, what, None, view, box)
        draw_texts(ImageDraw.Draw(canvas.image), place_texts(items, marks, canvas.size), marks, colors, box[:2])
        canvas.write_view_name(view, box[:2])
    page = Image.new("RGB", (2 * _SIDE + _LIST, canvas.image.height), "#ffffff")
    page.paste(canvas.image, (0, 0))
    _write_list(ImageDraw.Draw(page), lines)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_png(path, page)


def _write_list(draw: ImageDraw.ImageDraw, lines: Sequence[tuple[tuple[float, ...], str]]) -> None:
    left = 2 * _SIDE + 12
    for k, (color, text) in enumerate(lines[:_MOST]):
        top = 12 + k * _LINE
        fill = tuple(round(255 * share) for share in color)
        draw.rectangle((left, top, left + 16, top + 16), fill=fill)
        draw.text((left + 24, top + 1), shorten(text, 13, _LIST - 44), fill="#202428", font=font(13))
    if len(lines) > _MOST:
        draw.text((left, 12 + _MOST * _LINE), f"and {len(lines) - _MOST} smaller ones", fill="#202428", font=font(13))
