"""Partial programs: extractors with holes, all ways to fill the first hole, the worklist of them, simplest first; and
what they select at least on one demonstrated mesh, under its labels or others."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import TypeAlias, assert_never

import numpy as np

from meshforge import language
from meshforge.synthesis.demonstration import Example, LabelChange
from meshforge.synthesis.options import Layers
from meshforge.synthesis.search.smallest import NearestExtractor
from meshforge.synthesis.search.terms import SetOperator

_ATTACH = language.Attach(language.All(), language.All())  # whose bases are given as what they select


@dataclass(frozen=True, slots=True)
class Hole:
    """Stands for any extractor."""


@dataclass(frozen=True, slots=True)
class BaseHole:
    """Stands for `All` or `Is(a)`, which is all that `Attach` and `Geo` take."""


@dataclass(frozen=True, slots=True)
class OpenAttach:
    """An `Attach` with a hole in one place or both."""

    selected: language.BaseExtractor | BaseHole
    anchor: language.BaseExtractor | BaseHole


@dataclass(frozen=True, slots=True)
class OpenGeo:
    """A `Geo` whose base is a hole."""

    direction: language.Direction


@dataclass(frozen=True, slots=True)
class OpenOperator:
    """A set operator with at least one hole below it."""

    operator: SetOperator
    left: Partial
    right: Partial


Open = Hole | OpenAttach | OpenGeo | OpenOperator
Partial: TypeAlias = Open | language.Extractor


class HoleGrammar:
    """What may be put in a hole.

    The order is fixed: labels as in the vocabulary, `All`, then what reads contact, position, and set operators.
    """

    def __init__(self, vocabulary: Sequence[str], layers: Layers) -> None:
        self.bases: tuple[language.BaseExtractor, ...] = (*map(language.Is, vocabulary), language.All())
        contact = [OpenAttach(BaseHole(), BaseHole())] if "T" in layers else []
        position = map(OpenGeo, language.DIRECTIONS) if "G" in layers else []
        operators = [OpenOperator(operator, Hole(), Hole()) for operator in language.SET_OPERATORS]
        self.extractors: tuple[Partial, ...] = (*self.bases, *contact, *position, *operators)

    def fill(self, partial: Open) -> Iterator[Partial]:
        """Yield the partial program with its first hole filled, in all ways."""
        match partial:
            case Hole():
                yield from self.extractors
            case OpenGeo(direction):
                yield from (language.Geo(base, direction) for base in self.bases)
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


def make_attach(
    selected: language.BaseExtractor | BaseHole, anchor: language.BaseExtractor | BaseHole
) -> language.Attach | OpenAttach:
    """Return `Attach` of two bases, either of which may be a hole."""
    if isinstance(selected, BaseHole) or isinstance(anchor, BaseHole):
        return OpenAttach(selected, anchor)
    return language.Attach(selected, anchor)


def make_operator(operator: SetOperator, left: Partial, right: Partial) -> Partial:
    """Return a set operator over two partial programs."""
    if isinstance(left, Open) or isinstance(right, Open):
        return OpenOperator(operator, left, right)
    return operator(left, right)


def count_nodes(partial: Partial) -> int:
    """Return the syntactic complexity: syntax nodes, of which a hole is one."""
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
            return language.size_of(partial)


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
        """Return the simplest with its size, None when there is none left."""
        for size, queue in enumerate(self._queues):
            if queue:
                return size, queue.popleft()
        return None


LabelMasks = Mapping[str, int]
"""The hulls of each label, as bit sets."""

Bounds = tuple[int, int]
"""The hulls selected by every completion, and those selected by any, as bit sets."""


class ExampleMasks:
    """An example with its hulls by label; what is in contact or farthest is looked up once for the same bit sets."""

    def __init__(self, example: Example, extremity: float = language.EXTREMITY) -> None:
        self.example, mesh = example, example.mesh
        self.name, self.target = example.name, example.selection
        self.everything = (1 << len(mesh.hulls)) - 1
        self.labels = _masks_by_label([hull.label for hull in mesh.hulls])

        hulls = language.HullTable([mesh], extremity=extremity)

        @cache
        def refine(leaf: language.Leaf, *bases: int) -> int:
            return language.to_bits(leaf.mask(hulls, *(_to_bools(bits, len(hulls)) for bits in bases)))

        self.refine = refine

    def select(self, extractor: language.Extractor, labels: LabelMasks | None = None) -> int:
        """Return what an extractor selects, as a bit set; labels: those to go by, without them the mesh's own."""
        labels = self.labels if labels is None else labels
        match extractor:
            case language.Is(label):
                return labels.get(label, 0)
            case language.Leaf():
                return self.refine(extractor, *(self.select(base, labels) for base in extractor.bases))
            case language.Union(left, right):
                return self.select(left, labels) | self.select(right, labels)
            case language.Intersect(left, right):
                return self.select(left, labels) & self.select(right, labels)
            case language.Diff(left, right):
                return self.select(left, labels) & ~self.select(right, labels)
            case _:
                assert_never(extractor)

    def differences(self, extractor: language.Extractor) -> int:
        """Return the hulls that an extractor selects though they were not shown, or the other way round, as a bit
        set."""
        return self.select(extractor) ^ self.target

    def relabel(self, changes: Iterable[LabelChange]) -> LabelMasks:
        """Return the labels after some changes."""
        labels = dict(self.labels)
        for index, to in changes:
            was = self.example.mesh.hulls[index].label
            if was is not None:
                labels[was] &= ~(1 << index)
            labels[to] = labels.get(to, 0) | 1 << index
        return labels


def _to_bools(bits: int, count: int) -> language.Bools:
    packed = np.frombuffer(bits.to_bytes((count + 7) // 8, "little"), np.uint8)
    return np.unpackbits(packed, count=count, bitorder="little").astype(np.bool_)


def _masks_by_label(labels: Iterable[str | None]) -> dict[str, int]:
    masks: dict[str, int] = {}
    for index, label in enumerate(labels):
        if label is not None:
            masks[label] = masks.get(label, 0) | 1 << index
    return masks


def is_feasible(partial: Partial, demo: ExampleMasks) -> bool:
    """Return whether a completion may select what was shown, as far as bounds tell."""
    low, high = bounds(partial, demo)
    return not low & ~demo.target and not demo.target & ~high


def bounds(partial: Partial, demo: ExampleMasks) -> Bounds:
    """Return the bounds of a partial program on a demonstration; both are its selection where it has no holes.

    `Attach` grows with both its operands, so the bounds of these give its own; `Geo` does not grow with its base.
    """
    match partial:
        case Hole() | OpenGeo():
            return 0, demo.everything
        case OpenAttach(selected, anchor):
            (low, high), (anchor_low, anchor_high) = _base_bounds(selected, demo), _base_bounds(anchor, demo)
            return demo.refine(_ATTACH, low, anchor_low), demo.refine(_ATTACH, high, anchor_high)
        case OpenOperator(operator, left, right):
            return _combine_bounds(operator, bounds(left, demo), bounds(right, demo))
        case _:
            selection = demo.select(partial)
            return selection, selection


def _base_bounds(base: language.BaseExtractor | BaseHole, demo: ExampleMasks) -> Bounds:
    return (0, demo.everything) if isinstance(base, BaseHole) else bounds(base, demo)


def _combine_bounds(operator: SetOperator, left: Bounds, right: Bounds) -> Bounds:
    if operator is language.Union:
        return left[0] | right[0], left[1] | right[1]
    if operator is language.Intersect:
        return left[0] & right[0], left[1] & right[1]
    assert operator is language.Diff
    return left[0] & ~right[1], left[1] & ~right[0]


class NearestTracker:
    """The extractor with the fewest differing hulls so far; of several, the first met."""

    def __init__(self, demos: Sequence[ExampleMasks]) -> None:
        self._demos = demos
        self._best: tuple[int, language.Extractor] | None = None

    def offer(self, extractor: language.Extractor) -> int:
        """Return in how many hulls an extractor differs from what was shown: 0 is a match."""
        count = sum(demo.differences(extractor).bit_count() for demo in self._demos)
        if self._best is None or count < self._best[0]:
            self._best = (count, extractor)
        return count

    def miss(self) -> NearestExtractor | None:
        """Return how the nearest differs on the mesh where it differs most, None when nothing was offered."""
        if self._best is None:
            return None
        extractor = self._best[1]
        worst = max(self._demos, key=lambda demo: demo.differences(extractor).bit_count())
        wrong = worst.differences(extractor)
        names_of = worst.example.mesh.names_of
        return NearestExtractor(extractor, worst.name, names_of(wrong & ~worst.target), names_of(wrong & worst.target))
