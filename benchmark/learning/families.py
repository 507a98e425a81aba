"""Families of furniture made of boxes, with labels, for measuring how learning does; every draw is seeded."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from meshforge.geometry import Aabb, Box
from meshforge.symbolic import Hull, Label, SymbolicMesh

Draw = np.random.Generator
Corner = Sequence[float]


class Builder:
    """Collects labelled boxes."""

    def __init__(self, draw: Draw) -> None:
        self.draw, self._hulls = draw, list[Hull]()

    def box(self, label: str, low: Corner, size: Corner, cuts: int = 1, axis: int = 2) -> None:
        """A box from its lower corner [m] and its sides [m], cut into so many hulls along an axis."""
        for k in range(cuts):
            start, side = list(low), list(size)
            side[axis] = size[axis] / cuts
            start[axis] = low[axis] + k * side[axis]
            shape = Box.of_bounds(Aabb(start, [a + b for a, b in zip(start, side, strict=True)]))
            self._hulls.append(Hull(f"h{len(self._hulls)}", "body", shape, Label(label, 1.0, "file")))

    def chance(self, share: float) -> bool:
        return bool(self.draw.random() < share)

    def number(self, low: int, high: int) -> int:
        """A whole number from low to high, both included."""
        return int(self.draw.integers(low, high + 1))

    def length(self, low: float, high: float) -> float:
        return float(self.draw.uniform(low, high))

    def mesh(self) -> SymbolicMesh:
        """The mesh, its hulls in an order that tells nothing."""
        order = self.draw.permutation(len(self._hulls))
        return SymbolicMesh(tuple(self._hulls[k] for k in order))


def table(make: Builder) -> None:
    """A top of boards, four legs or a pedestal, at times a shelf, drawers with handles, a foot pad, litter."""
    wide, deep, high = make.length(0.8, 1.8), make.length(0.5, 0.9), make.length(0.4, 1.0)
    make.box("panel", (0, 0, high), (wide, deep, 0.04), make.number(1, 4), 0)
    pads = make.chance(0.1)
    foot = 0.03 if pads else 0.0
    spots = [(0.0, 0.0), (wide - 0.05, 0.0), (0.0, deep - 0.05), (wide - 0.05, deep - 0.05)]
    if make.chance(0.1):
        spots = [(wide / 2 - 0.025, deep / 2 - 0.025)]
    pieces = make.number(1, 3)
    for x, y in spots:
        make.box("leg", (x, y, foot), (0.05, 0.05, high - foot), pieces)
        if pads:
            make.box("pad", (x - 0.01, y - 0.01, 0), (0.07, 0.07, foot))
    if make.chance(0.4) and len(spots) == 4:
        make.box("panel", (0.05, 0, high / 3), (wide - 0.1, deep, 0.02), make.number(1, 2), 0)
    if make.chance(0.3) and len(spots) == 4:
        make.box("bar", (0.05, 0.0, 0.1), (wide - 0.1, 0.05, 0.05))
    drawers = make.number(0, 3)
    for k in range(drawers):
        x, w = 0.08 + k * (wide - 0.2) / 3, (wide - 0.2) / 3 - 0.02
        z = high - 0.16
        make.box("drawer", (x, 0.02, z), (w, deep - 0.1, 0.02))
        make.box("drawer", (x, 0.0, z), (w, 0.02, 0.12))
        for side in (x, x + w - 0.01):
            make.box("drawer", (side, 0.02, z + 0.02), (0.01, deep - 0.1, 0.08))
        make.box("handle", (x + w / 2 - 0.04, -0.03, z + 0.05), (0.08, 0.03, 0.02), make.number(1, 2), 0)
    if make.chance(0.15):
        make.box("handle", (wide, deep / 2, high), (0.03, 0.08, 0.04))
    for _ in range(make.number(0, 3)):
        low = (make.length(0.1, wide), make.length(0.1, deep), make.length(high + 0.1, high + 0.3))
        make.box("misc", low, (0.01, 0.01, 0.01))


def cabinet(make: Builder) -> None:
    """A frame, one to three doors with handles, at times drawers below, shelves inside, feet, a kick plate."""
    wide, deep, high = make.length(0.6, 1.6), make.length(0.3, 0.6), make.length(0.7, 2.0)
    base = 0.1
    if make.chance(0.1):
        make.box("plate", (0, 0, 0), (wide, 0.02, base))
    for x, y in ((0, 0.02), (wide - 0.05, 0.02), (0, deep - 0.05), (wide - 0.05, deep - 0.05)):
        make.box("foot", (x, y, 0), (0.05, 0.05, base))
    for x in (0.0, wide - 0.02):
        make.box("frame", (x, 0.02, base), (0.02, deep - 0.02, high), make.number(1, 3))
    make.box("frame", (0.02, 0.02, base), (wide - 0.04, deep - 0.02, 0.02), make.number(1, 2), 0)
    make.box("frame", (0.02, 0.02, base + high - 0.02), (wide - 0.04, deep - 0.02, 0.02), make.number(1, 2), 0)
    make.box("frame", (0.02, deep - 0.02, base + 0.02), (wide - 0.04, 0.02, high - 0.04), make.number(1, 4))
    for k in range(make.number(0, 3)):
        make.box("shelf", (0.02, 0.05, base + high * (k + 1) / 4), (wide - 0.04, deep - 0.07, 0.02))
    low = base
    if make.chance(0.4):
        low = base + 0.25
        make.box("drawer", (0.02, 0.0, base + 0.02), (wide - 0.04, 0.02, 0.2))
        make.box("handle", (wide / 2 - 0.05, -0.03, base + 0.1), (0.1, 0.03, 0.02))
    doors = make.number(1, 3)
    for k in range(doors):
        w = wide / doors
        make.box("door", (k * w, 0.0, low), (w - 0.005, 0.02, base + high - low), make.number(1, 3))
        if make.chance(0.9):
            make.box("handle", (k * w + w * 0.8, -0.03, (low + high) / 2), (0.02, 0.03, 0.1), make.number(1, 2))


def lamp(make: Builder) -> None:
    """A base, a pole, a shade with a bulb; some hang from the ceiling, some have a cord or a switch."""
    high = make.length(0.4, 1.8)
    hanging = make.chance(0.1)
    low = high if hanging else 0.0
    make.box("base", (-0.15, -0.15, low), (0.3, 0.3, 0.03), make.number(1, 3), 0)
    if make.chance(0.08):
        make.box("base", (-0.05, -0.05, low + 0.03 if not hanging else low - 0.03), (0.1, 0.1, 0.03))
    pole = 0.03 if not hanging else 0.3
    make.box("pole", (-0.02, -0.02, pole), (0.04, 0.04, high - pole), make.number(1, 4))
    middle = high if not hanging else 0.3
    long, across = (0.4, 0.02), (0.02, 0.36)
    for x, y, (w, d) in ((-0.2, -0.2, long), (-0.2, 0.18, long), (-0.2, -0.18, across), (0.18, -0.18, across)):
        make.box("shade", (x, y, middle - 0.1), (w, d, 0.25), make.number(1, 2))
    make.box("bulb", (-0.04, -0.04, middle if not hanging else middle - 0.08), (0.08, 0.08, 0.08))
    if make.chance(0.4):
        make.box("cord", (0.15, -0.01, low), (make.length(0.1, 0.4), 0.01, 0.01), make.number(1, 3), 0)
    if make.chance(0.3):
        make.box("switch", (0.02, -0.01, middle - 0.2 if not hanging else 0.5), (0.02, 0.02, 0.03))


def cup(make: Builder) -> None:
    """A base, walls of slabs, one handle (rarely two) of three pieces, at times a lid, a saucer, litter inside."""
    wide, high = make.length(0.06, 0.12), make.length(0.06, 0.16)
    make.box("base", (0, 0, 0), (wide, wide, 0.01), make.number(1, 3), 0)
    cuts = make.number(1, 3)
    make.box("wall", (0, 0, 0.01), (wide, 0.005, high), cuts)
    make.box("wall", (0, wide - 0.005, 0.01), (wide, 0.005, high), cuts)
    make.box("wall", (0, 0.005, 0.01), (0.005, wide - 0.01, high), cuts)
    make.box("wall", (wide - 0.005, 0.005, 0.01), (0.005, wide - 0.01, high), cuts)
    sides = [wide] if make.chance(0.9) else [wide, -0.03]
    for x in sides if make.chance(0.95) else []:
        grip = x + 0.02 if x > 0 else x
        make.box("handle", (x, wide / 2, high * 0.3), (0.03, 0.01, 0.01))
        make.box("handle", (x, wide / 2, high * 0.8), (0.03, 0.01, 0.01))
        make.box("handle", (grip, wide / 2, high * 0.3 + 0.01), (0.01, 0.01, high * 0.5 - 0.01), make.number(1, 3))
    if make.chance(0.3):
        make.box("lid", (0, 0, high + 0.01), (wide, wide, 0.01), make.number(1, 2), 0)
    if make.chance(0.2):
        make.box("saucer", (-0.03, -0.03, -0.01), (wide + 0.06, wide + 0.06, 0.01), make.number(1, 4), 0)
    for _ in range(make.number(0, 2)):
        make.box("misc", (wide / 2, wide / 2, make.length(0.02, high)), (0.003, 0.003, 0.003))


FAMILIES: dict[str, Callable[[Builder], None]] = {"table": table, "cabinet": cabinet, "lamp": lamp, "cup": cup}
VOCABULARIES: dict[str, tuple[str, ...]] = {
    "table": ("panel", "leg", "handle", "drawer", "bar", "pad", "misc"),
    "cabinet": ("frame", "door", "drawer", "handle", "shelf", "foot", "plate"),
    "lamp": ("base", "pole", "shade", "bulb", "cord", "switch"),
    "cup": ("base", "wall", "handle", "lid", "saucer", "misc"),
}


def family(name: str, count: int, seed: int) -> tuple[SymbolicMesh, ...]:
    """So many meshes of a family; each has a seed of its own, so a longer family begins with the shorter one."""
    meshes = []
    for k in range(count):
        make = Builder(np.random.default_rng([seed, k, *map(ord, name)]))
        FAMILIES[name](make)
        meshes.append(make.mesh())
    return tuple(meshes)
