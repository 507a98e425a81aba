"""The nodes of the language, frozen and validated at birth, and what extractors select, as bit sets over the hulls
of a mesh (paper, figures of the DSL and of its semantics)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import assert_never

from meshforge import symbolic
from meshforge.common import ProgramError
from meshforge.geometry import Aabb
from meshforge.language.labels import check_label, show_label
from meshforge.language.words import Direction, check_direction

EXTREMITY = 0.05
"""delta: how near the boundary counts as extreme, as a share of the base selection's diagonal (paper)."""
SLACK = 1e-9
"""Comparisons with a threshold forgive this share of the mesh's diagonal, against rounding."""


class _Selector:
    """Lets every extractor be asked for its selection, be printed, and be combined by `&`, `|` and `-`."""

    __slots__ = ()

    def __and__(self, other: Extractor) -> Intersect:
        return Intersect(_as_extractor(self), other)

    def __or__(self, other: Extractor) -> Union:
        return Union(_as_extractor(self), other)

    def __sub__(self, other: Extractor) -> Diff:
        return Diff(_as_extractor(self), other)

    def __str__(self) -> str:
        """The extractor as program text."""
        operands = ", ".join(str(getattr(self, field.name)) for field in fields(_as_extractor(self)))
        return f"{type(self).__name__}({operands})"

    def select(self, mesh: symbolic.SymbolicMesh, extremity: float = EXTREMITY) -> frozenset[int]:
        """Indices of the hulls selected in the mesh, in the frame it is in."""
        return select(_as_extractor(self), mesh, extremity)


@dataclass(frozen=True, slots=True)
class All(_Selector):
    """Every hull."""

    def __str__(self) -> str:
        return "All"


@dataclass(frozen=True, slots=True)
class Is(_Selector):
    """The hulls with a label."""

    label: str

    def __post_init__(self) -> None:
        check_label(self.label)

    def __str__(self) -> str:
        return f"Is({show_label(self.label)})"


BaseExtractor = All | Is


@dataclass(frozen=True, slots=True)
class Attach(_Selector):
    """The hulls of `selected` in contact with at least one hull of `anchor`."""

    selected: BaseExtractor
    anchor: BaseExtractor

    def __post_init__(self) -> None:
        _check_base(self, self.selected, self.anchor)


@dataclass(frozen=True, slots=True)
class Geo(_Selector):
    """The hulls of `base` that reach farthest along `direction`, within extremity times the diagonal of `base`."""

    base: BaseExtractor
    direction: Direction

    def __post_init__(self) -> None:
        _check_base(self, self.base)
        check_direction(self.direction)


@dataclass(frozen=True, slots=True)
class _SetOperator(_Selector):
    left: Extractor
    right: Extractor

    def __post_init__(self) -> None:
        for operand in (self.left, self.right):
            if not isinstance(operand, All | Is | Attach | Geo | Union | Intersect | Diff):
                remedy = f"Write {operand.__name__}()." if operand in (All, Is) else None
                raise ProgramError(f"{type(self).__name__} takes extractors, not {operand!r}", remedy=remedy)


@dataclass(frozen=True, slots=True)
class Union(_SetOperator):
    """The hulls of either."""


@dataclass(frozen=True, slots=True)
class Intersect(_SetOperator):
    """The hulls of both."""


@dataclass(frozen=True, slots=True)
class Diff(_SetOperator):
    """The hulls of `left` that are not in `right`."""


Extractor = All | Is | Attach | Geo | Union | Intersect | Diff


def _as_extractor(node: _Selector) -> Extractor:
    assert isinstance(node, All | Is | Attach | Geo | Union | Intersect | Diff)
    return node


@dataclass(frozen=True, slots=True)
class LandmarkPair:
    """The direction from the centre of `start` to the centre of `end` becomes `axis`."""

    axis: Direction
    start: BaseExtractor
    end: BaseExtractor

    def __post_init__(self) -> None:
        check_direction(self.axis)
        _check_base(self, self.start, self.end)


@dataclass(frozen=True, slots=True)
class Orient:
    """The orientation directive: one or two landmark pairs on different axes; snap: nearest axis-aligned turn."""

    pairs: tuple[LandmarkPair, ...]
    snap: bool = False

    def __post_init__(self) -> None:
        if len(self.pairs) not in (1, 2):
            raise ProgramError(f"orient takes one or two landmark pairs, not {len(self.pairs)}")
        axes = [pair.axis for pair in self.pairs]
        if len({axis[1] for axis in axes}) != len(axes):
            problem = f"orient names the axis {axes[0][1]} twice"
            raise ProgramError(problem, remedy="Give the second pair another axis than the first.")

    @property
    def names_z(self) -> bool:
        """Whether it says what +Z is, so that Z points up whatever the files say."""
        return any(pair.axis.endswith("Z") for pair in self.pairs)


def _check_base(node: object, *operands: object) -> None:
    for operand in operands:
        if not isinstance(operand, All | Is):
            remedy = "Combine selections with Union, Intersect and Diff instead of nesting them."
            raise ProgramError(f"{type(node).__name__} takes All or Is(label), not {operand!r}", remedy=remedy)


def select(extractor: Extractor, mesh: symbolic.SymbolicMesh, extremity: float = EXTREMITY) -> frozenset[int]:
    """Indices of the hulls that an extractor selects, in the frame the mesh is in."""
    return symbolic.bits_of(select_mask(extractor, mesh, extremity))


def select_mask(
    extractor: Extractor,
    mesh: symbolic.SymbolicMesh,
    extremity: float = EXTREMITY,
    labels: Sequence[str | None] | None = None,
) -> int:
    """The selection as a bit set. labels: of the hulls, in place of those that they have."""
    names = [hull.label for hull in mesh.hulls] if labels is None else labels

    def select(one: Extractor) -> int:
        match one:
            case All():
                return (1 << len(mesh.hulls)) - 1
            case Is(label):
                return symbolic.mask_of(index for index, name in enumerate(names) if name == label)
            case Attach(selected, anchor):
                return attach_mask(mesh, select(selected), select(anchor))
            case Geo(base, direction):
                return geo_mask(mesh, select(base), direction, extremity)
            case Union(left, right):
                return select(left) | select(right)
            case Intersect(left, right):
                return select(left) & select(right)
            case Diff(left, right):
                return select(left) & ~select(right)
            case _:
                assert_never(one)

    return select(extractor)


def attach_mask(mesh: symbolic.SymbolicMesh, selected: int, anchor: int) -> int:
    """The hulls of `selected` in contact with at least one of `anchor`."""
    return symbolic.mask_of(index for index in symbolic.bits_of(selected) if mesh.adjacency[index] & anchor)


def geo_mask(mesh: symbolic.SymbolicMesh, base: int, direction: Direction, extremity: float = EXTREMITY) -> int:
    """The hulls of `base` within `extremity` times its diagonal of its boundary along `direction`."""
    if not base:
        return 0
    boxes = {index: mesh.hulls[index].aabb for index in symbolic.bits_of(base)}
    reach = {index: _reach_of(box, direction) for index, box in boxes.items()}
    nearest = max(reach.values()) - extremity * Aabb.union(boxes.values()).diagonal - SLACK * reference_length(mesh)
    return symbolic.mask_of(index for index, value in reach.items() if value >= nearest)


def _reach_of(box: Aabb, direction: Direction) -> float:
    """How far a box reaches along a direction [m]."""
    axis = "XYZ".index(direction[1])
    return float(box.max[axis] if direction[0] == "+" else -box.min[axis])


def reference_length(mesh: symbolic.SymbolicMesh) -> float:
    """L, the length [m] that relative thresholds refer to: fixed in a run, else the diagonal."""
    return mesh.diagonal if mesh.scale is None else mesh.scale


def size_of(extractor: Extractor) -> int:
    """The number of syntax nodes: All, Is 1; Geo 2; Attach 3; set operators 1 and both operands."""
    match extractor:
        case All() | Is():
            return 1
        case Geo():
            return 2
        case Attach():
            return 3
        case Union(left, right) | Intersect(left, right) | Diff(left, right):
            return 1 + size_of(left) + size_of(right)
        case _:
            assert_never(extractor)


def labels_of(extractor: Extractor) -> tuple[str, ...]:
    """The labels an extractor asks for, each once, in order of mention."""
    match extractor:
        case All():
            return ()
        case Is(label):
            return (label,)
        case Geo(base, _):
            return labels_of(base)
        case Attach(left, right) | Union(left, right) | Intersect(left, right) | Diff(left, right):
            return tuple(dict.fromkeys(labels_of(left) + labels_of(right)))
        case _:
            assert_never(extractor)


def rename_in_orient(orient: Orient, old: str, new: str) -> Orient:
    """The orientation with a label by another name."""
    pairs = (
        replace(pair, start=_rename_in_base(pair.start, old, new), end=_rename_in_base(pair.end, old, new))
        for pair in orient.pairs
    )
    return replace(orient, pairs=tuple(pairs))


def _rename_in_base(base: BaseExtractor, old: str, new: str) -> BaseExtractor:
    return Is(new) if base == Is(old) else base


def rename_in_extractor(node: Extractor, old: str, new: str) -> Extractor:
    """An extractor that asks for the label `new` wherever it asked for `old`."""
    match node:
        case All() | Is():
            return _rename_in_base(node, old, new)
        case Geo(base, direction):
            return Geo(_rename_in_base(base, old, new), direction)
        case Attach(selected, anchor):
            return Attach(_rename_in_base(selected, old, new), _rename_in_base(anchor, old, new))
        case Union(left, right) | Intersect(left, right) | Diff(left, right):
            return type(node)(rename_in_extractor(left, old, new), rename_in_extractor(right, old, new))
        case _:
            assert_never(node)


def check_threshold(name: str, value: float | None) -> None:
    """Raises ProgramError for a threshold that is not a number above 0 and at most 1."""
    if value is not None and not (math.isfinite(value) and 0 < value <= 1):
        raise ProgramError(f"{name} is a share of a diagonal, above 0 and at most 1, not {value:g}")
