"""Tops of tables: boards and leaves with gaps on battens, pierced and whole ones."""

from __future__ import annotations

from manifold3d import CrossSection

from benchmark.assets.categories.table_legs import HAIRLINE, Size
from benchmark.assets.draw import Draw
from script.samples.part import Part
from script.samples.solids import block, chamfer, plate, rectangle, superellipse


def top(size: Size, round_: bool, draw: Draw) -> tuple[list[Part], float, str]:
    """The top and its battens, the radius of a ball that falls into its gaps, and a name."""
    w, d = size.width, size.depth
    gap = draw.length(0.018, 0.03) * min(1.0, 0.5 + 0.5 * w)
    style = draw.one(("boards", "boards", "leaves", "pierced", "pierced", "whole"))
    outline = _outline(w, d, round_, style in ("whole", "pierced"), draw)
    if style == "whole":
        return [Part("top", "panel", plate(outline, size.height, size.thick))], 0.012, "whole top"
    if style == "pierced":
        hole = draw.length(0.045, 0.07) * min(1.0, 0.5 + 0.5 * w)
        for x in draw.one(((0.0,), (-0.18, 0.0, 0.18))):
            outline -= CrossSection.circle(hole / 2, 14).translate((x * w, 0))
        return [Part("top", "panel", plate(outline, size.height, size.thick))], 0.4 * hole, "pierced top"
    count = draw.one((2, 4)) if style == "boards" else 2
    each = ((d if style == "boards" else w) - gap * (count - 1)) / count
    found = []
    for k in range(count):
        low = (each + gap) * k - ((d if style == "boards" else w) / 2)
        strip = CrossSection.square((2 * w, each)).translate((-w, low))
        if style == "leaves":
            strip = CrossSection.square((each, 2 * w)).translate((low, -w))
        found.append(Part(f"board_{k + 1}", "panel", plate(outline ^ strip, size.height, size.thick)))
    reach = 0.35 if round_ else 0.44
    for k, side in enumerate((-1, 1), 1):
        x, y, z = 0.03 * w, reach * d, size.low
        bar = block((-x + side * 0.28 * w, -y, z), (x + side * 0.28 * w, y, size.under - HAIRLINE))
        if style == "leaves":
            bar = block((-reach * w, -x + side * 0.2 * d, z), (reach * w, x + side * 0.2 * d, size.under - HAIRLINE))
        found.append(Part(f"batten_{k}", "panel", bar))
    return found, 0.4 * gap, f"top of {count} {style}"


def _outline(w: float, d: float, round_: bool, whole: bool, draw: Draw) -> CrossSection:
    """The outline of a top; only a whole one may be waisted."""
    if round_:
        return superellipse(w, d, draw.one((2.0, 2.5)), 24)
    shape = draw.number(0, 3)
    if shape == 0:
        return chamfer(w, d, 0.06 * d)
    if shape == 1:
        return rectangle(w, d, 0.15 * d, 12)
    waisted = rectangle(w, d, 0.04 * d, 8)
    if shape == 2 and whole:
        cut = 0.05 * d
        radius = (w * w / 4 + cut * cut) / (2 * cut)
        for side in (-1, 1):
            waisted -= CrossSection.circle(radius, 128).translate((0, side * (d / 2 + radius - cut)))
    return waisted
