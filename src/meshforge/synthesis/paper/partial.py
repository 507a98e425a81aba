"""Partial programs: extractors with holes, all ways to fill the first hole, the worklist of them, simplest first; and
what they select at least on one demonstrated mesh, under its labels or others."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import TypeAlias, assert_never

from meshforge import language
from meshforge.synthesis.demonstration import Example, LabelChange
from meshforge.synthesis.options import Layers
from meshforge.synthesis.search.bank import unpack_bits

_ATTACH = language.Attach(language.All(), language.All())  # whose bases are given as what they select


@dataclass(frozen=True, slots=True)
class Hole:
    """Stands for any extractor; of bases, for `All` or `Is(a)`, which is all that `Attach` and `Geo` take."""

    of_bases: bool = False


@dataclass(frozen=True, slots=True)
class OpenOperator:
    """An operator that has a hole somewhere. make: gives an extractor of its operands."""

    make: Callable[..., language.Extractor]
    operands: "tuple[Partial, ...]"


Open = Hole | OpenOperator
Partial: TypeAlias = Open | language.Extractor


class HoleGrammar:
    """What may be put in a hole.

    The order is fixed: labels as in the vocabulary, `All`, then what reads contact, position, and set operators.
    """

    def __init__(self, vocabulary: Sequence[str], layers: Layers) -> None:
        base = Hole(of_bases=True)
        self.bases: tuple[language.BaseExtractor, ...] = (*map(language.Is, vocabulary), language.All())
        contact = [OpenOperator(language.Attach, (base, base))] if "T" in layers else []
        ways = [partial(language.Geo, direction=one) for one in language.DIRECTIONS] if "G" in layers else []
        operators = [OpenOperator(operator, (Hole(), Hole())) for operator in language.SET_OPERATORS]
        position = [OpenOperator(make, (base,)) for make in ways]
        self.extractors: tuple[Partial, ...] = (*self.bases, *contact, *position, *operators)

    def fill(self, open_: Open) -> Iterator[Partial]:
        """Yield the partial program with its first hole filled, in all ways."""
        if isinstance(open_, Hole):
            yield from self.bases if open_.of_bases else self.extractors
            return
        place, first = next((k, one) for k, one in enumerate(open_.operands) if isinstance(one, Open))
        for part in self.fill(first):
            operands = (*open_.operands[:place], part, *open_.operands[place + 1 :])
            is_open = any(isinstance(one, Open) for one in operands[place:])
            yield OpenOperator(open_.make, operands) if is_open else open_.make(*operands)


def count_nodes(part: Partial) -> int:
    """Return the syntactic complexity: syntax nodes, of which a hole is one."""
    if isinstance(part, OpenOperator):
        return 1 + sum(map(count_nodes, part.operands))
    return 1 if isinstance(part, Hole) else language.size_of(part)


class Worklist:
    """Partial programs by syntactic complexity; of those as complex, the first put in comes out first.

    One queue a size gives the order of a heap and keeps no keys: there are millions of entries.
    max_size: what is larger is not taken in.
    """

    def __init__(self, max_size: int) -> None:
        self._queues: list[deque[Partial]] = [deque() for _ in range(max_size + 1)]

    def put(self, part: Partial) -> None:
        size = count_nodes(part)
        if size < len(self._queues):
            self._queues[size].append(part)

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
        self.labels = dict[str, int]()
        for index, hull in enumerate(mesh.hulls):
            if hull.label is not None:
                self.labels[hull.label] = self.labels.get(hull.label, 0) | 1 << index
        hulls = language.HullTable([mesh], extremity=extremity)

        @cache
        def refine(leaf: language.Leaf, *bases: int) -> int:
            return language.to_bits(leaf.mask(hulls, *unpack_bits(bases, len(hulls))))

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
        """Return the hulls (a bit set) that an extractor selects though they were not shown, or leaves out."""
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


def is_feasible(part: Partial, demo: ExampleMasks) -> bool:
    """Return whether a completion may select what was shown, as far as bounds tell."""
    low, high = bounds(part, demo)
    return not low & ~demo.target and not demo.target & ~high


def bounds(part: Partial, demo: ExampleMasks) -> Bounds:
    """Return the bounds of a partial program on a demonstration; both are its selection where it has no holes.

    `Attach` grows with both its operands, so the bounds of these give its own; `Geo` does not grow with its base.
    """
    match part:
        case OpenOperator(make, (one, other)):
            (low, high), (other_low, other_high) = bounds(one, demo), bounds(other, demo)
            if make is language.Attach:
                return demo.refine(_ATTACH, low, other_low), demo.refine(_ATTACH, high, other_high)
            if make is language.Union:
                return low | other_low, high | other_high
            if make is language.Intersect:
                return low & other_low, high & other_high
            assert make is language.Diff
            return low & ~other_high, high & ~other_low
        case Hole() | OpenOperator():
            return 0, demo.everything
        case _:
            selection = demo.select(part)
            return selection, selection
