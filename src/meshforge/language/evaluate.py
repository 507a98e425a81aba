"""What extractors select, as bit sets over the hulls of a mesh (paper, figure of the semantics)."""

from __future__ import annotations

from typing import assert_never

from meshforge.geometry import Aabb
from meshforge.language.syntax import (
    EXTREMITY,
    All,
    Attach,
    Diff,
    Direction,
    Extractor,
    Geo,
    Intersect,
    Is,
    Union,
)
from meshforge.symbolic import SymbolicMesh, bits

SLACK = 1e-9
"""Comparisons with a threshold forgive this share of the mesh's diagonal, against rounding."""


def select(extractor: Extractor, mesh: SymbolicMesh, extremity: float = EXTREMITY) -> frozenset[int]:
    """Indices of the hulls that an extractor selects, in the frame the mesh is in."""
    return bits(select_mask(extractor, mesh, extremity))


def select_mask(extractor: Extractor, mesh: SymbolicMesh, extremity: float = EXTREMITY) -> int:
    """The selection as a bit set."""
    match extractor:
        case All():
            return (1 << len(mesh.hulls)) - 1
        case Is(label):
            return label_mask(mesh, label)
        case Attach(selected, anchor):
            return attach_mask(mesh, select_mask(selected, mesh, extremity), select_mask(anchor, mesh, extremity))
        case Geo(base, direction):
            return geo_mask(mesh, select_mask(base, mesh, extremity), direction, extremity)
        case Union(left, right):
            return select_mask(left, mesh, extremity) | select_mask(right, mesh, extremity)
        case Intersect(left, right):
            return select_mask(left, mesh, extremity) & select_mask(right, mesh, extremity)
        case Diff(left, right):
            return select_mask(left, mesh, extremity) & ~select_mask(right, mesh, extremity)
        case _:
            assert_never(extractor)


def label_mask(mesh: SymbolicMesh, label: str) -> int:
    """The hulls with a label."""
    mask = 0
    for index, hull in enumerate(mesh.hulls):
        if hull.label == label:
            mask |= 1 << index
    return mask


def attach_mask(mesh: SymbolicMesh, selected: int, anchor: int) -> int:
    """The hulls of `selected` in contact with at least one of `anchor`."""
    mask = 0
    for index in bits(selected):
        if mesh.adjacency[index] & anchor:
            mask |= 1 << index
    return mask


def geo_mask(mesh: SymbolicMesh, base: int, direction: Direction, extremity: float = EXTREMITY) -> int:
    """The hulls of `base` within `extremity` times its diagonal of its boundary along `direction`."""
    if not base:
        return 0
    boxes = {index: mesh.hulls[index].aabb for index in bits(base)}
    reach = {index: _reach(box, direction) for index, box in boxes.items()}
    nearest = max(reach.values()) - extremity * Aabb.union(boxes.values()).diagonal - SLACK * length(mesh)
    mask = 0
    for index, value in reach.items():
        if value >= nearest:
            mask |= 1 << index
    return mask


def length(mesh: SymbolicMesh) -> float:
    """L, the length [m] that relative thresholds refer to: fixed in a run, else the diagonal."""
    return mesh.diagonal if mesh.scale is None else mesh.scale


def size(extractor: Extractor) -> int:
    """The number of syntax nodes: All, Is 1; Geo 2; Attach 3; set operators 1 and both operands."""
    match extractor:
        case All() | Is():
            return 1
        case Geo():
            return 2
        case Attach():
            return 3
        case Union(left, right) | Intersect(left, right) | Diff(left, right):
            return 1 + size(left) + size(right)
        case _:
            assert_never(extractor)


def labels_used(extractor: Extractor) -> tuple[str, ...]:
    """The labels an extractor asks for, each once, in order of mention."""
    match extractor:
        case All():
            return ()
        case Is(label):
            return (label,)
        case Geo(base, _):
            return labels_used(base)
        case Attach(left, right) | Union(left, right) | Intersect(left, right) | Diff(left, right):
            return tuple(dict.fromkeys(labels_used(left) + labels_used(right)))
        case _:
            assert_never(extractor)


def _reach(box: Aabb, direction: Direction) -> float:
    """How far a box reaches along a direction [m]."""
    axis = "XYZ".index(direction[1])
    return float(box.max[axis] if direction[0] == "+" else -box.min[axis])
