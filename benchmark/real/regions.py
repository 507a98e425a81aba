"""Region labels of a family: which part of an asset's surface has which label, and of which part of the asset it is."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from benchmark.real.family import Family
from benchmark.real.surface import NEAR, AssetSurface, Patch, matches, split_patch
from meshforge.common import AssetError
from meshforge.geometry import Floats, Ints

_KEYS = frozenset({"label", "pieces", "box", "boxes", "part"})
_ON = 1e-9  # of the diagonal: a corner so near to a plane is on it

Box3 = tuple[tuple[float, float, float], tuple[float, float, float]]
"""The lowest and the highest corner, in shares of the asset's box."""


@dataclass(frozen=True)
class Region:
    """A label for pieces that fit patterns of names, or for what of them is in one of some boxes.

    part: of which part of the asset it is; None: each connected bit of it is a part of its own.
    """

    label: str
    pieces: tuple[str, ...]
    boxes: tuple[Box3, ...] = ()
    part: str | None = None


@dataclass(frozen=True, eq=False)
class RegionPatch:
    """A connected bit of a piece of the surface, with the region that it is of; region None: no region has it.

    part: the name of the part that it is of.
    """

    patch: Patch
    region: Region | None
    part: str = ""

    @property
    def label(self) -> str | None:
        return self.region.label if self.region else None


def read_regions(family: Family, asset: str) -> list[Region]:
    """The regions of an asset, the first one that fits winning. Raises AssetError naming asset and region."""
    path = family.folder / "regions.toml"
    rows = tomllib.loads(path.read_text("utf-8")).get(asset, {}).get("regions", []) if path.is_file() else []
    return [parse_region(row, family.vocabulary, f"{asset}, region {k}") for k, row in enumerate(rows, 1)]


def parse_region(row: Mapping[str, Any], vocabulary: Sequence[str], where: str) -> Region:
    """A region from its table. Raises AssetError naming `where`: a key, label or box that cannot be."""
    if unknown := sorted(row.keys() - _KEYS):
        raise AssetError(f"a region has no {', '.join(unknown)}", where=where, remedy=f"It has {', '.join(_KEYS)}.")
    if row.get("label") not in vocabulary:
        remedy = f"Labels are {', '.join(vocabulary)}."
        raise AssetError(f"{row.get('label')!r} is no label of the family", where=where, remedy=remedy)
    pieces = tuple(row.get("pieces", ("*",)))
    boxes = [*([row["box"]] if "box" in row else []), *row.get("boxes", [])]
    return Region(row["label"], pieces, tuple(_parse_box(box, where) for box in boxes), row.get("part"))


def _parse_box(box: Any, where: str) -> Box3:
    try:
        corners = np.asarray(box, dtype=np.float64)
    except ValueError:
        corners = np.zeros(0)
    if corners.shape != (2, 3) or not (corners[0] < corners[1]).all():
        remedy = "Write [[x, y, z], [x, y, z]]: the lowest corner, then the highest, in shares of the asset's box."
        raise AssetError(f"{box} is no box", where=where, remedy=remedy)
    low, high = (tuple(float(x) for x in corner) for corner in corners)
    return (low[0], low[1], low[2]), (high[0], high[1], high[2])


def label_surface(surface: AssetSurface, regions: Sequence[Region]) -> list[RegionPatch]:
    """Every bit of a surface with its region, cut where a box ends. Raises AssetError for a region that has nothing."""
    low, high = surface.bounds
    used: set[int] = set()
    found: list[RegionPatch] = []
    for piece in surface.pieces:
        rest = piece.corners
        for k, region in enumerate(regions):
            if not matches(piece.name, region.pieces):
                continue
            inside, rest = _take(rest, region, low, high)
            used |= {k} if len(inside) else set()
            found += [RegionPatch(bit, region) for bit in _bits(piece.name, inside, high - low)]
        found += [RegionPatch(bit, None) for bit in _bits(piece.name, rest, high - low)]
    for k, region in enumerate(regions):
        if k not in used:
            told = f"region {k + 1} ({region.label}, pieces {', '.join(region.pieces)}) has no surface"
            remedy = "`python -m benchmark.real look FAMILY ASSET --pieces` lists the pieces."
            raise AssetError(told, where=surface.name, remedy=remedy)
    return _name_parts(found)


def _name_parts(found: Sequence[RegionPatch]) -> list[RegionPatch]:
    """The bits with the names of their parts: what the region says, or the label and a number."""
    count: dict[str, int] = {}
    named = []
    for row in found:
        if row.region and not row.region.part:
            count[row.region.label] = count.get(row.region.label, 0) + 1
            row = replace(row, part=f"{row.region.label}_{count[row.region.label]}")
        elif row.region and row.region.part:
            row = replace(row, part=row.region.part)
        named.append(row)
    return named


def _take(corners: Floats, region: Region, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """What of triangles (m, 3, 3) a region takes, and what it leaves."""
    if not region.boxes:
        return corners, corners[:0]
    taken, rest = [], corners
    for box in region.boxes:
        inside, outside = rest, []
        for axis, side, at in planes_of_box(box, low, high):
            inside, beyond = cut_triangles(inside, axis, side, at, float(np.linalg.norm(high - low)))
            outside.append(beyond)
        taken.append(inside)
        rest = np.concatenate(outside) if outside else rest[:0]
    return np.concatenate(taken), rest


def planes_of_box(box: Box3, low: Floats, high: Floats) -> Iterator[tuple[int, float, float]]:
    """Axis, side (1: the box is above, -1: below) and place [m] of the planes of a box that cut the asset's box."""
    for axis in range(3):
        if box[0][axis] > 0:
            yield axis, 1.0, float(low[axis] + box[0][axis] * (high - low)[axis])
        if box[1][axis] < 1:
            yield axis, -1.0, float(low[axis] + box[1][axis] * (high - low)[axis])


def cut_triangles(corners: Floats, axis: int, side: float, at: float, size: float) -> tuple[Floats, Floats]:
    """Triangles (m, 3, 3) on one side of a plane across an axis, and on the other; those that cross it are cut."""
    heights = side * (corners[:, :, axis] - at)
    heights[np.abs(heights) < _ON * size] = 0.0
    crossing = (heights.min(axis=1, initial=0) < 0) & (heights.max(axis=1, initial=0) > 0)
    above = ~crossing & (heights.sum(axis=1) >= 0)
    inside, outside = [corners[above]], [corners[~crossing & ~above]]
    for triangle, height in zip(corners[crossing], heights[crossing], strict=True):
        inside.append(_clip(triangle, height))
        outside.append(_clip(triangle, -height))
    return np.concatenate(inside), np.concatenate(outside)


def _clip(triangle: Floats, height: Floats) -> Floats:
    """What of a triangle (3, 3) is where its height is positive, as triangles."""
    ring: list[Floats] = []
    for k in range(3):
        a, b, u, v = triangle[k], triangle[(k + 1) % 3], height[k], height[(k + 1) % 3]
        if u >= 0:
            ring.append(a)
        if u * v < 0:
            ring.append(a + (b - a) * (u / (u - v)))
    return np.array([[ring[0], ring[k], ring[k + 1]] for k in range(1, len(ring) - 1)]).reshape(-1, 3, 3)


def _bits(name: str, corners: Floats, size: Floats) -> list[Patch]:
    """What hangs together of triangles (m, 3, 3), by vertices in one place."""
    faces: Ints = np.arange(3 * len(corners)).reshape(-1, 3)
    reach = NEAR * float(np.linalg.norm(size))
    return (
        [replace(bit, name=name) for bit in split_patch(name, corners.reshape(-1, 3), faces, reach)]
        if len(faces)
        else []
    )
