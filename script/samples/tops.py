"""Table tops for which a box is the right support: whole, of boards, waisted, notched, pierced, with a rim below."""

from __future__ import annotations

from manifold3d import CrossSection, Manifold

from script.samples.part import Part
from script.samples.solids import block, box, chamfer, plate, rectangle, superellipse, union


def shelf(width: float, depth: float, z: float, thickness: float = 0.018, name: str = "shelf") -> Part:
    """A plain lower board whose middle is at height z."""
    return Part(name, "panel", box((width, depth, thickness), (0, 0, z)))


def top(solid: Manifold) -> Part:
    """A solid as the part that is the top."""
    return Part("top", "panel", solid)


def quarter_top(width: float, depth: float, height: float, thickness: float, gap: float) -> list[Part]:
    """Softly rounded, sawn into four along both middles, on a cross below."""
    outline = superellipse(width, depth, 6.0)
    whole = plate(outline, height, thickness)
    w, d = width / 2, depth / 2
    parts = []
    for k, (x, y) in enumerate(((-1, -1), (1, -1), (1, 1), (-1, 1))):
        quarter = box((width, depth, 1), (x * (w + gap / 2), y * (d + gap / 2), height))
        parts.append(Part(f"quarter_{k + 1}", "panel", whole ^ quarter))
    under = height - thickness - 0.008
    cross = union([box((width * 0.8, 0.09, 0.02), (0, 0, under)), box((0.09, depth * 0.8, 0.02), (0, 0, under))])
    return [*parts, Part("cross", "panel", cross)]


def boards(
    width: float, depth: float, height: float, thickness: float, count: int, gap: float, batten: float
) -> list[Part]:
    """Boards side by side along X, on two battens below of thickness `batten`."""
    each = (depth - gap * (count - 1)) / count
    lows = [-depth / 2 + k * (each + gap) for k in range(count)]
    planks = [block((-width / 2, y, height - thickness), (width / 2, y + each, height)) for y in lows]
    under = height - thickness
    battens = [
        block((x - 0.04, -depth / 2 + 0.03, under - batten), (x + 0.04, depth / 2 - 0.03, under + 0.003))
        for x in (-width * 0.3, width * 0.3)
    ]
    named = [
        *((f"board_{k + 1}", p) for k, p in enumerate(planks)),
        *((f"batten_{k + 1}", b) for k, b in enumerate(battens)),
    ]
    return [Part(name, "panel", solid) for name, solid in named]


def waist_top(width: float, depth: float, height: float, thickness: float, waist: float) -> Part:
    """A plate whose long sides curve inwards by `waist`."""
    radius = (width * width / 4 + waist * waist) / (2 * waist)
    outline = rectangle(width, depth, 0.03)
    for side in (-1, 1):
        outline -= CrossSection.circle(radius, 96).translate((0, side * (depth / 2 + radius - waist)))
    return top(plate(outline, height, thickness))


def notch_top(width: float, depth: float, height: float, thickness: float, notch: tuple[float, float]) -> Part:
    """A plate with a rectangular cable notch in the middle of each long side."""
    outline = chamfer(width, depth, 0.05)
    for side in (-1, 1):
        outline -= rectangle(notch[0], 2 * notch[1], 0.02).translate((0, side * depth / 2))
    return top(plate(outline, height, thickness))


def pierce_top(
    width: float, depth: float, height: float, thickness: float, hole: float, places: list[tuple[float, float]]
) -> Part:
    """A plate with round holes for cables."""
    outline = rectangle(width, depth, 0.06)
    for place in places:
        outline -= CrossSection.circle(hole / 2, 14).translate(place)
    return top(plate(outline, height, thickness))


def rim_top(width: float, depth: float, height: float, thickness: float, rim: float, drop: float) -> Part:
    """A plate with a border that hangs down below it."""
    low = height - thickness - drop
    recess = rectangle(width - 2 * rim, depth - 2 * rim).extrude(drop).translate((0, 0, low))
    return top(plate(rectangle(width, depth, 0.02), height, thickness + drop) - recess)


def leaves(width: float, depth: float, height: float, thickness: float, count: int, gap: float) -> list[Part]:
    """Leaves side by side along X with a narrow gap, without their corners, on two runners below."""
    each = (width - gap * (count - 1)) / count
    outline = chamfer(each, depth, 0.05)
    middles = [-width / 2 + each / 2 + k * (each + gap) for k in range(count)]
    under = height - thickness
    runners = [
        block((-width * 0.42, y - 0.03, under - 0.025), (width * 0.42, y + 0.03, under + 0.003))
        for y in (-depth * 0.3, depth * 0.3)
    ]
    plates = [plate(outline, height, thickness).translate((x, 0, 0)) for x in middles]
    return [
        *(Part(f"leaf_{k + 1}", "panel", solid) for k, solid in enumerate(plates)),
        *(Part(f"runner_{k + 1}", "panel", solid) for k, solid in enumerate(runners)),
    ]
