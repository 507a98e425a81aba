"""Extractors as the search sees them: leaves, terms with what they select, and the order in which the search
answers.

The order says which of two extractors that select the same a person would rather believe. It is total, but for
the operands of `Union` and `Intersect` changing places. Putting an earlier part in place of a part makes the
whole earlier, so the earliest extractor is made of earliest parts, and of all parts that select the same the
search may forget all but the first.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, assert_never

from meshforge import language
from meshforge.language import All, Attach, BaseExtractor, Diff, Geo, Is, Union
from meshforge.synthesis.options import Layers

Leaf = All | Is | Attach | Geo

Key = tuple[Any, ...]
"""Sorts extractors; entry 0 is the size, entry 1 the doubts."""

SetOperator = type[Union] | type[language.Intersect] | type[Diff]

_IS, _ALL, _ATTACH, _GEO = range(4)
OPERATOR_RANK: Mapping[SetOperator, int] = {Union: 4, language.Intersect: 5, Diff: 6}
"""Of equal size and doubts: labels, then contact, then position, then what adds, and last what takes away."""

DIRECTION_RANK: Mapping[language.Direction, int] = {"+Z": 0, "-Z": 1, "+X": 2, "-X": 3, "+Y": 4, "-Y": 5}
"""Up and down first: an orientation settles them, while the turn about the upright axis is often a convention."""


def enumerate_leaves(vocabulary: Sequence[str], layers: Layers = "S+T+G") -> tuple[Leaf, ...]:
    """Every extractor without set operators over the labels of a vocabulary."""
    bases: list[BaseExtractor] = [*map(Is, vocabulary), All()]
    attached = [Attach(selected, anchor) for selected, anchor in product(bases, bases)] if "T" in layers else []
    extreme = [Geo(base, direction) for base, direction in product(bases, language.DIRECTIONS)] if "G" in layers else []
    return (*bases, *attached, *extreme)


def leaf_key(leaf: All | Is | Attach | Geo, labels: Mapping[str, int]) -> Key:
    """The key of an extractor without set operators; labels: the place of each label in the vocabulary.

    Doubts count what fits by accident more easily than labels, and contact between two labels, do: `All`; a
    direction, since there are six to try; an `Attach` that is not between two labels, since it says how parts
    were cut rather than what they are.
    """
    match leaf:
        case Is(label):
            return (1, 0, _IS, labels[label])
        case All():
            return (1, 1, _ALL)
        case Attach(selected, anchor):
            doubts = _count_all(selected, anchor) + (not _is_between_labels(selected, anchor))
            return (3, doubts, _ATTACH, leaf_key(selected, labels), leaf_key(anchor, labels))
        case Geo(base, direction):
            return (2, 1 + _count_all(base), _GEO, leaf_key(base, labels), DIRECTION_RANK[direction])
        case _:
            assert_never(leaf)


def operator_key(operator: SetOperator, left: Key, right: Key) -> Key:
    """The key of a set operator over two extractors; the operands of `Union` and `Intersect` count in order."""
    if operator is not Diff and right < left:
        left, right = right, left
    return (1 + left[0] + right[0], left[1] + right[1], OPERATOR_RANK[operator], left, right)


def order_key(extractor: language.Extractor, labels: Mapping[str, int]) -> Key:
    """The key of any extractor: what sorts first is smaller, or as small and more believable."""
    match extractor:
        case Union(left, right) | language.Intersect(left, right) | Diff(left, right):
            return operator_key(type(extractor), order_key(left, labels), order_key(right, labels))
        case All() | Is() | Attach() | Geo():
            return leaf_key(extractor, labels)
        case _:
            assert_never(extractor)


def _count_all(*bases: BaseExtractor) -> int:
    return sum(isinstance(base, All) for base in bases)


def _is_between_labels(selected: BaseExtractor, anchor: BaseExtractor) -> bool:
    return isinstance(selected, Is) and isinstance(anchor, Is) and selected != anchor


@dataclass(frozen=True, slots=True, eq=False)
class Compound:
    """A set operator over two terms."""

    operator: SetOperator
    left: Term
    right: Term


@dataclass(frozen=True, slots=True, eq=False)
class Term:
    """An extractor, its place in the order, and its selection as a bit set over the search's groups of hulls.

    form: the extractor itself, or the operands it is put together from: most terms are never written out.
    """

    bits: int
    key: Key
    form: All | Is | Attach | Geo | Compound

    @property
    def extractor(self) -> language.Extractor:
        """The term written out."""
        made = self.form
        return made.operator(made.left.extractor, made.right.extractor) if isinstance(made, Compound) else made

    @property
    def size(self) -> int:
        """Its syntax nodes."""
        size: int = self.key[0]
        return size


def combine(operator: SetOperator, left: Term, right: Term) -> Term:
    """A set operator over two terms; the operands of `Union` and `Intersect` are put in order."""
    if operator is not Diff and right.key < left.key:
        left, right = right, left
    if operator is Union:
        bits = left.bits | right.bits
    else:
        bits = left.bits & ~right.bits if operator is Diff else left.bits & right.bits
    return Term(bits, operator_key(operator, left.key, right.key), Compound(operator, left, right))


def first_term(terms: list[Term]) -> Term | None:
    """The first of the terms in the order."""
    return min(terms, key=lambda term: term.key, default=None)
