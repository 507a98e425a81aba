"""Families of furniture made of boxes, with true labels: small meshes whose wrong labels are to be found."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from meshforge.geometry import Aabb, Box
from meshforge.symbolic import Hull, Label, SymbolicMesh

Piece = tuple[str, str, Sequence[float], Sequence[float]]
"""Name, label, lower corner [m], size [m]."""
Maker = Callable[[np.random.Generator], list[Piece]]


def family(maker: Maker, count: int, rng: np.random.Generator) -> list[SymbolicMesh]:
    """Meshes of one kind, of varying parts and proportions."""
    return [_mesh(maker(rng)) for _ in range(count)]


def _mesh(pieces: Sequence[Piece]) -> SymbolicMesh:
    hulls = []
    for name, label, low, size in pieces:
        high = [corner + side for corner, side in zip(low, size, strict=True)]
        hulls.append(Hull(name, "body", Box.filling(Aabb(low, high)), Label(label, 1.0, "file")))
    return SymbolicMesh(tuple(hulls))


def tables(rng: np.random.Generator) -> list[Piece]:
    """A top of one to three boards, legs of one or two pieces, perhaps a shelf, drawers with handles, litter."""
    long, deep, tall = rng.uniform(0.8, 2.0), rng.uniform(0.5, 1.0), rng.uniform(0.5, 1.0)
    thick, side = rng.uniform(0.02, 0.05), rng.uniform(0.04, 0.08)
    boards = int(rng.integers(1, 4))
    pieces: list[Piece] = [
        (f"top{k}", "panel", (k * long / boards, 0, tall), (long / boards, deep, thick)) for k in range(boards)
    ]
    corners = [(0, 0), (long - side, 0), (0, deep - side), (long - side, deep - side)]
    knee = rng.uniform(0.3, 0.7) * tall if rng.random() < 0.5 else 0.0
    for k, (x, y) in enumerate(corners):
        if knee:
            pieces.append((f"leg{k}low", "leg", (x, y, 0), (side, side, knee)))
        pieces.append((f"leg{k}", "leg", (x, y, knee), (side, side, tall - knee)))
    if rng.random() < 0.5:
        pieces.append(("shelf", "panel", (side, 0, 0.15 * tall), (long - 2 * side, deep, thick)))
    drawers, height = int(rng.integers(0, 4)), rng.uniform(0.1, 0.2)
    width = (long - 2 * side) / 3 * 0.8
    for k in range(drawers):
        x, z = side + 0.02 + k * (long - 2 * side) / 3, tall - height
        inner = deep * 0.7
        pieces += [
            (f"drawer{k}bottom", "drawer", (x, 0.02, z), (width, inner, 0.02)),
            (f"drawer{k}front", "drawer", (x, 0, z), (width, 0.02, height - 0.005 * k)),
            (f"drawer{k}left", "drawer", (x, 0.02, z + 0.02), (0.015, inner, height - 0.04)),
            (f"drawer{k}right", "drawer", (x + width - 0.015, 0.02, z + 0.02), (0.015, inner, height - 0.04)),
            (f"handle{k}", "handle", (x + width / 3, -0.03, z + height / 2), (width / 3, 0.03, 0.02)),
        ]
    if rng.random() < 0.4:
        pieces.append(("towel_bar", "handle", (-0.04, deep / 3, tall), (0.04, deep / 3, 0.02)))
    return [*pieces, *_litter(rng, long, deep)]


def cupboards(rng: np.random.Generator) -> list[Piece]:
    """Sides, top, bottom and back, shelves within, doors with handles in front, feet below, litter."""
    wide, deep, tall = rng.uniform(0.6, 1.4), rng.uniform(0.3, 0.6), rng.uniform(0.8, 2.0)
    thick, lift = rng.uniform(0.015, 0.03), rng.uniform(0.05, 0.15)
    pieces: list[Piece] = [
        ("left", "frame", (0, 0, lift), (thick, deep, tall)),
        ("right", "frame", (wide - thick, 0, lift), (thick, deep, tall)),
        ("top", "frame", (0, 0, lift + tall), (wide, deep, thick)),
        ("bottom", "frame", (thick, 0, lift), (wide - 2 * thick, deep, thick)),
        ("back", "frame", (thick, deep - 0.01, lift + thick), (wide - 2 * thick, 0.01, tall - thick)),
    ]
    for k in range(n := int(rng.integers(0, 4))):
        z = lift + tall * (k + 1) / (n + 1)
        pieces.append((f"shelf{k}", "shelf", (thick, 0.01, z), (wide - 2 * thick, deep - 0.02, thick)))
    for k in range(doors := int(rng.integers(1, 3))):
        span = wide / doors
        pieces.append((f"door{k}", "door", (k * span + 0.002, -thick, lift), (span - 0.006, thick, tall)))
        x, z = k * span + (0.8 if k == 0 else 0.15) * span, lift + tall * rng.uniform(0.4, 0.6)
        pieces.append((f"handle{k}", "handle", (x, -thick - 0.03, z), (0.02, 0.03, rng.uniform(0.1, 0.25))))
    if rng.random() < 0.3:
        pieces.append(("hook", "handle", (wide, deep / 2, lift + 0.7 * tall), (0.03, 0.02, 0.05)))
    for k, (x, y) in enumerate([(0, 0), (wide - 0.05, 0), (0, deep - 0.05), (wide - 0.05, deep - 0.05)]):
        pieces.append((f"foot{k}", "foot", (x, y, 0), (0.05, 0.05, lift)))
    return [*pieces, *_litter(rng, wide, deep)]


def lamps(rng: np.random.Generator) -> list[Piece]:
    """A base of one or two slabs, a pole of pieces, one to three shades with bulbs, a switch, litter."""
    wide, tall, thin = rng.uniform(0.2, 0.4), rng.uniform(0.5, 1.6), rng.uniform(0.015, 0.03)
    middle = wide / 2
    pieces: list[Piece] = [("base0", "base", (0, 0, 0), (wide, wide, 0.03))]
    foot = 0.03
    if rng.random() < 0.5:
        pieces.append(("base1", "base", (wide / 4, wide / 4, foot), (wide / 2, wide / 2, 0.03)))
        foot += 0.03
    rods = int(rng.integers(1, 4))
    for k in range(rods):
        z = foot + k * tall / rods
        pieces.append((f"pole{k}", "pole", (middle - thin / 2, middle - thin / 2, z), (thin, thin, tall / rods)))
    top = foot + tall
    for k in range(int(rng.integers(1, 4))):
        x = middle + (k - 0.5) * 0.3
        if k:
            start = min(x, middle) if x < middle else middle + thin / 2
            pieces.append((f"arm{k}", "pole", (start, middle - thin / 2, top - 0.02), (abs(x - middle), thin, thin)))
        pieces.append((f"bulb{k}", "bulb", (x, middle - 0.02, top), (0.04, 0.04, 0.06)))
        pieces.append((f"shade{k}", "shade", (x - 0.08, middle - 0.1, top + 0.06), (0.2, 0.2, rng.uniform(0.02, 0.15))))
    pieces.append(("switch", "switch", (0.02, 0.02, 0.03), (0.03, 0.02, 0.01)))
    if rng.random() < 0.3:
        height = foot + 0.5 * tall / rods
        pieces.append(("dimmer", "switch", (middle + thin / 2, middle, height), (0.02, 0.02, 0.04)))
    return [*pieces, *_litter(rng, wide, wide)]


def cups(rng: np.random.Generator) -> list[Piece]:
    """A wall of boards about a bottom, a rim perhaps, one or two handles of three pieces, a saucer, litter."""
    wide, tall, thick = rng.uniform(0.06, 0.12), rng.uniform(0.06, 0.15), rng.uniform(0.004, 0.008)
    lift = 0.01 if rng.random() < 0.4 else 0.0
    pieces: list[Piece] = [("bottom", "bottom", (0, 0, lift), (wide, wide, thick))]
    if lift:
        pieces.append(("saucer", "saucer", (-0.04, -0.04, 0), (wide + 0.08, wide + 0.08, lift)))
    sides = [
        ((0, 0), (wide, thick)),
        ((0, wide - thick), (wide, thick)),
        ((0, thick), (thick, wide - 2 * thick)),
        ((wide - thick, thick), (thick, wide - 2 * thick)),
    ]
    rim = rng.random() < 0.5
    up = tall * (0.85 if rim else 1.0)
    for k, (corner, span) in enumerate(sides):
        pieces.append((f"wall{k}", "wall", (*corner, lift + thick), (*span, up)))
        if rim:
            pieces.append((f"rim{k}", "rim", (*corner, lift + thick + up), (*span, tall - up)))
    for k in range(int(rng.integers(1, 3))):
        x, way = (wide, 1.0) if k == 0 else (0.0, -1.0)
        reach, z = rng.uniform(0.02, 0.04), lift + thick
        start = x if way > 0 else x - reach
        outer = x + reach if way > 0 else x - reach - thick
        pieces += [
            (f"handle{k}upper", "handle", (start, wide / 2, z + 0.7 * up), (reach, thick, thick)),
            (f"handle{k}lower", "handle", (start, wide / 2, z + 0.2 * up), (reach, thick, thick)),
            (f"handle{k}grip", "handle", (outer, wide / 2, z + 0.2 * up), (thick, thick, 0.5 * up + thick)),
        ]
    return [*pieces, *_litter(rng, wide, wide)]


def _litter(rng: np.random.Generator, wide: float, deep: float) -> list[Piece]:
    """Up to two small bits that float in the room, or lie on the ground."""
    side = wide * 0.02
    return [
        (f"residue{k}", "misc", (wide * rng.uniform(0.2, 0.8), deep * (1.3 + k), wide * 0.2 * k), (side, side, side))
        for k in range(int(rng.integers(0, 3)))
    ]


FAMILIES: Mapping[str, Maker] = {"tables": tables, "cupboards": cupboards, "lamps": lamps, "cups": cups}
