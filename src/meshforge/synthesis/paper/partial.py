"""Partial programs: extractors with holes, all ways to fill the first hole, and the worklist of them, simplest first
(paper, section on synthesis). A tree without holes is an extractor of the language; every other one has a node of
this module at its root."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import assert_never

from meshforge.language import (
    DIRECTIONS,
    All,
    Attach,
    BaseExtractor,
    Diff,
    Direction,
    Extractor,
    Geo,
    Intersect,
    Is,
    Union,
    size_of,
)
from meshforge.synthesis.options import Layers
from meshforge.synthesis.search.terms import SetOperator

OPERATORS: tuple[SetOperator, ...] = (Union, Intersect, Diff)


@dataclass(frozen=True, slots=True)
class Hole:
    """Stands for any extractor."""


@dataclass(frozen=True, slots=True)
class BaseHole:
    """Stands for `All` or `Is(a)`, which is all that `Attach` and `Geo` take."""


@dataclass(frozen=True, slots=True)
class OpenAttach:
    """An `Attach` with a hole in one place or both."""

    selected: BaseExtractor | BaseHole
    anchor: BaseExtractor | BaseHole


@dataclass(frozen=True, slots=True)
class OpenGeo:
    """A `Geo` whose base is a hole."""

    direction: Direction


@dataclass(frozen=True, slots=True)
class OpenOperator:
    """A set operator with at least one hole below it."""

    operator: SetOperator
    left: Partial
    right: Partial


Open = Hole | OpenAttach | OpenGeo | OpenOperator
Partial = Open | Extractor


class HoleGrammar:
    """What may be put in a hole.

    The order is fixed: labels as in the vocabulary, `All`, then what reads contact, position, and set operators.
    """

    def __init__(self, vocabulary: Sequence[str], layers: Layers) -> None:
        self.bases: tuple[BaseExtractor, ...] = (*map(Is, vocabulary), All())
        contact = [OpenAttach(BaseHole(), BaseHole())] if "T" in layers else []
        position = map(OpenGeo, DIRECTIONS) if "G" in layers else []
        operators = [OpenOperator(operator, Hole(), Hole()) for operator in OPERATORS]
        self.extractors: tuple[Partial, ...] = (*self.bases, *contact, *position, *operators)

    def fill(self, partial: Open) -> Iterator[Partial]:
        """The partial program with its first hole filled, in all ways."""
        match partial:
            case Hole():
                yield from self.extractors
            case OpenGeo(direction):
                yield from (Geo(base, direction) for base in self.bases)
            case OpenAttach(BaseHole(), anchor):
                yield from (make_attach(base, anchor) for base in self.bases)
            case OpenAttach(selected, _):
                yield from (make_attach(selected, base) for base in self.bases)
            case OpenOperator(operator, left, right):
                if isinstance(left, Open):
                    yield from (make_operator(operator, part, right) for part in self.fill(left))
                elif isinstance(right, Open):
                    yield from (make_operator(operator, left, part) for part in self.fill(right))
            case _:
                assert_never(partial)


def make_attach(selected: BaseExtractor | BaseHole, anchor: BaseExtractor | BaseHole) -> Attach | OpenAttach:
    """`Attach` of two bases, either of which may be a hole."""
    if isinstance(selected, BaseHole) or isinstance(anchor, BaseHole):
        return OpenAttach(selected, anchor)
    return Attach(selected, anchor)


def make_operator(operator: SetOperator, left: Partial, right: Partial) -> Partial:
    """A set operator over two partial programs."""
    if isinstance(left, Open) or isinstance(right, Open):
        return OpenOperator(operator, left, right)
    return operator(left, right)


def count_nodes(partial: Partial) -> int:
    """The syntactic complexity: syntax nodes, of which a hole is one."""
    match partial:
        case Hole():
            return 1
        case OpenGeo():
            return 2
        case OpenAttach():
            return 3
        case OpenOperator(_, left, right):
            return 1 + count_nodes(left) + count_nodes(right)
        case _:
            return size_of(partial)


class Worklist:
    """Partial programs by syntactic complexity; of those as complex, the first put in comes out first.

    One queue a size gives the order of a heap and keeps no keys: there are millions of entries.
    max_size: what is larger is not taken in.
    """

    def __init__(self, max_size: int) -> None:
        self._queues: list[deque[Partial]] = [deque() for _ in range(max_size + 1)]

    def put(self, partial: Partial) -> None:
        size = count_nodes(partial)
        if size < len(self._queues):
            self._queues[size].append(partial)

    def pop(self) -> tuple[int, Partial] | None:
        """The simplest with its size, None when there is none left."""
        for size, queue in enumerate(self._queues):
            if queue:
                return size, queue.popleft()
        return None
