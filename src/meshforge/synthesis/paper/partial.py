"""Partial programs: extractors with holes, and all ways to fill the first hole (paper, section on synthesis).

A tree without holes is an extractor of the language; every other one has a node of this module at its root.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import assert_never

from meshforge.language import (
    DIRECTIONS,
    All,
    Attach,
    Base,
    Diff,
    Direction,
    Extractor,
    Geo,
    Intersect,
    Is,
    Union,
    size,
)
from meshforge.synthesis.options import Layers
from meshforge.synthesis.search.order import Joint

JOINTS: tuple[Joint, ...] = (Union, Intersect, Diff)


@dataclass(frozen=True, slots=True)
class Hole:
    """Stands for any extractor."""


@dataclass(frozen=True, slots=True)
class BaseHole:
    """Stands for `All` or `Is(a)`, which is all that `Attach` and `Geo` take."""


@dataclass(frozen=True, slots=True)
class OpenAttach:
    """An `Attach` with a hole in one place or both."""

    selected: Base | BaseHole
    anchor: Base | BaseHole


@dataclass(frozen=True, slots=True)
class OpenGeo:
    """A `Geo` whose base is a hole."""

    direction: Direction


@dataclass(frozen=True, slots=True)
class OpenJoint:
    """A set operator with at least one hole below it."""

    operator: Joint
    left: Partial
    right: Partial


Open = Hole | OpenAttach | OpenGeo | OpenJoint
Partial = Open | Extractor


class Grammar:
    """What may be put in a hole.

    The order is fixed: labels as in the vocabulary, `All`, then what reads contact, position, and set operators.
    """

    def __init__(self, vocabulary: Sequence[str], layers: Layers) -> None:
        self.bases: tuple[Base, ...] = (*map(Is, vocabulary), All())
        contact = [OpenAttach(BaseHole(), BaseHole())] if "T" in layers else []
        position = map(OpenGeo, DIRECTIONS) if "G" in layers else []
        joints = [OpenJoint(joint, Hole(), Hole()) for joint in JOINTS]
        self.extractors: tuple[Partial, ...] = (*self.bases, *contact, *position, *joints)

    def fill(self, partial: Open) -> Iterator[Partial]:
        """The partial program with its first hole filled, in all ways."""
        match partial:
            case Hole():
                yield from self.extractors
            case OpenGeo(direction):
                yield from (Geo(base, direction) for base in self.bases)
            case OpenAttach(BaseHole(), anchor):
                yield from (attach(base, anchor) for base in self.bases)
            case OpenAttach(selected, _):
                yield from (attach(selected, base) for base in self.bases)
            case OpenJoint(joint, left, right):
                if isinstance(left, Open):
                    yield from (join(joint, part, right) for part in self.fill(left))
                elif isinstance(right, Open):
                    yield from (join(joint, left, part) for part in self.fill(right))
            case _:
                assert_never(partial)


def attach(selected: Base | BaseHole, anchor: Base | BaseHole) -> Attach | OpenAttach:
    """`Attach` of two bases, either of which may be a hole."""
    if isinstance(selected, BaseHole) or isinstance(anchor, BaseHole):
        return OpenAttach(selected, anchor)
    return Attach(selected, anchor)


def join(joint: Joint, left: Partial, right: Partial) -> Partial:
    """A set operator over two partial programs."""
    if isinstance(left, Open) or isinstance(right, Open):
        return OpenJoint(joint, left, right)
    return joint(left, right)


def nodes(partial: Partial) -> int:
    """The syntactic complexity: syntax nodes, of which a hole is one."""
    match partial:
        case Hole():
            return 1
        case OpenGeo():
            return 2
        case OpenAttach():
            return 3
        case OpenJoint(_, left, right):
            return 1 + nodes(left) + nodes(right)
        case _:
            return size(partial)
