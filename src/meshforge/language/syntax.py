"""The nodes of the language: frozen, validated at birth, data only (paper, figure of the DSL)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, get_args

Direction = Literal["+X", "-X", "+Y", "-Y", "+Z", "-Z"]
DIRECTIONS: tuple[Direction, ...] = get_args(Direction)
EXTREMITY = 0.05
"""delta: how near the boundary counts as extreme, as a share of the base selection's diagonal (paper)."""


@dataclass(frozen=True, slots=True)
class All:
    """Every hull."""


@dataclass(frozen=True, slots=True)
class Is:
    """The hulls with a label."""

    label: str


Base = All | Is


@dataclass(frozen=True, slots=True)
class Attach:
    """The hulls of `selected` in contact with at least one hull of `anchor`."""

    selected: Base
    anchor: Base


@dataclass(frozen=True, slots=True)
class Geo:
    """The hulls of `base` that reach farthest along `direction`, within extremity times the diagonal of `base`."""

    base: Base
    direction: Direction


@dataclass(frozen=True, slots=True)
class Union:
    """The hulls of either."""

    left: Extractor
    right: Extractor


@dataclass(frozen=True, slots=True)
class Intersect:
    """The hulls of both."""

    left: Extractor
    right: Extractor


@dataclass(frozen=True, slots=True)
class Diff:
    """The hulls of `left` that are not in `right`."""

    left: Extractor
    right: Extractor


Extractor = All | Is | Attach | Geo | Union | Intersect | Diff


@dataclass(frozen=True, slots=True)
class LandmarkPair:
    """The direction from the centre of `start` to the centre of `end` becomes `axis`."""

    axis: Direction
    start: Base
    end: Base


@dataclass(frozen=True, slots=True)
class Orient:
    """The orientation directive: one or two landmark pairs on different axes; snap: nearest axis-aligned turn."""

    pairs: tuple[LandmarkPair, ...]
    snap: bool = False

    def __post_init__(self) -> None:
        axes = [pair.axis[1] for pair in self.pairs]
        if len(axes) not in (1, 2) or len(set(axes)) != len(axes):
            raise ValueError("orient takes one or two landmark pairs on different axes")


@dataclass(frozen=True, slots=True)
class Comments:
    """The comment lines above a statement and the comment at its end, without `#`, as a text keeps them.

    blank: whether an empty line stood above the statement and its comments.
    """

    above: tuple[str, ...] = ()
    beside: str | None = None
    blank: bool = field(default=False)
