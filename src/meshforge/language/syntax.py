"""The nodes of the language: frozen, validated at birth, data only (paper, figure of the DSL)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

from meshforge.errors import ProgramError

if TYPE_CHECKING:
    from meshforge.symbolic import SymbolicMesh

Direction = Literal["+X", "-X", "+Y", "-Y", "+Z", "-Z"]
DIRECTIONS: tuple[Direction, ...] = get_args(Direction)
OPERATORS = ("All", "Is", "Attach", "Geo", "Union", "Intersect", "Diff")
EXTREMITY = 0.05
"""delta: how near the boundary counts as extreme, as a share of the base selection's diagonal (paper)."""


class _Selecting:
    """Lets every extractor be asked for its selection."""

    __slots__ = ()

    def select(self, mesh: SymbolicMesh, extremity: float = EXTREMITY) -> frozenset[int]:
        """Indices of the hulls selected in the mesh, in the frame it is in."""
        from meshforge.language.evaluate import select

        assert isinstance(self, All | Is | Attach | Geo | Union | Intersect | Diff)
        return select(self, mesh, extremity)


@dataclass(frozen=True, slots=True)
class All(_Selecting):
    """Every hull."""


@dataclass(frozen=True, slots=True)
class Is(_Selecting):
    """The hulls with a label."""

    label: str

    def __post_init__(self) -> None:
        check_label(self.label)


Base = All | Is


@dataclass(frozen=True, slots=True)
class Attach(_Selecting):
    """The hulls of `selected` in contact with at least one hull of `anchor`."""

    selected: Base
    anchor: Base

    def __post_init__(self) -> None:
        _check_base(self, self.selected, self.anchor)


@dataclass(frozen=True, slots=True)
class Geo(_Selecting):
    """The hulls of `base` that reach farthest along `direction`, within extremity times the diagonal of `base`."""

    base: Base
    direction: Direction

    def __post_init__(self) -> None:
        _check_base(self, self.base)
        check_direction(self.direction)


@dataclass(frozen=True, slots=True)
class Union(_Selecting):
    """The hulls of either."""

    left: Extractor
    right: Extractor

    def __post_init__(self) -> None:
        _check_extractors(self, self.left, self.right)


@dataclass(frozen=True, slots=True)
class Intersect(_Selecting):
    """The hulls of both."""

    left: Extractor
    right: Extractor

    def __post_init__(self) -> None:
        _check_extractors(self, self.left, self.right)


@dataclass(frozen=True, slots=True)
class Diff(_Selecting):
    """The hulls of `left` that are not in `right`."""

    left: Extractor
    right: Extractor

    def __post_init__(self) -> None:
        _check_extractors(self, self.left, self.right)


Extractor = All | Is | Attach | Geo | Union | Intersect | Diff


@dataclass(frozen=True, slots=True)
class LandmarkPair:
    """The direction from the centre of `start` to the centre of `end` becomes `axis`."""

    axis: Direction
    start: Base
    end: Base

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
            raise ProgramError(
                f"orient names the axis {axes[0][1]} twice", remedy="Give the second pair another axis than the first."
            )


def check_label(label: str) -> None:
    """Raises ProgramError for what cannot be a label."""
    if not isinstance(label, str) or not label:
        raise ProgramError(f"a label is a text of at least one character, not {label!r}")


def check_direction(direction: str) -> None:
    """Raises ProgramError for what is no direction."""
    if direction not in DIRECTIONS:
        raise ProgramError(f"unknown direction {direction!r}", remedy=f"Directions are {', '.join(DIRECTIONS)}.")


def _check_base(node: object, *operands: object) -> None:
    for operand in operands:
        if not isinstance(operand, All | Is):
            raise ProgramError(
                f"{type(node).__name__} takes All or Is(label), not {operand!r}",
                remedy="Combine selections with Union, Intersect and Diff instead of nesting them.",
            )


def _check_extractors(node: object, *operands: object) -> None:
    for operand in operands:
        if not isinstance(operand, All | Is | Attach | Geo | Union | Intersect | Diff):
            raise ProgramError(f"{type(node).__name__} takes extractors, not {operand!r}")
