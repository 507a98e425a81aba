"""Every selection that small extractors make, each with the first extractor that makes it, grown size by size; an
index that finds at once all that hold one set of hulls and avoid another; and the target-directed search by it.

Knowing one operand of a set operator turns the target of the whole into a wider target for the other operand, and the
index finds at once what satisfies it.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from meshforge.language import Bools, Diff, Intersect, Union, to_bits
from meshforge.synthesis.options import TimeBudget
from meshforge.synthesis.search.terms import Key, SetOperator, Term, combine, first_term, operator_key

_REMEMBERED = 10_000  # answers of an index, so that a search that takes long does not take the memory

Draft = tuple[Key, SetOperator, Term, Term]
"""A set operator over two terms, before it is known to be worth keeping."""


class Level:
    """The terms of one size, in order, and the index over what they select."""

    __slots__ = ("columns", "terms")

    def __init__(self, terms: Sequence[Term], width: int) -> None:
        self.terms = tuple(sorted(terms, key=lambda term: term.key))
        self.columns = Columns([term.bits for term in self.terms], width)

    def select_rows(self, rows: int) -> Iterator[Term]:
        """Return the terms of a set of rows, in order."""
        return (self.terms[k] for k in positions(rows))


class Bank:
    """Terms by size, made when asked for; of the terms that select the same only the first in the order is kept.

    What selects nothing is not kept: a smallest extractor of something has no such part.
    """

    def __init__(self, leaves: Sequence[Term], width: int, budget: TimeBudget) -> None:
        self._leaves = leaves
        self._width = width
        self._budget = budget
        self._levels: list[Level] = []
        self._known: set[int] = {0}

    @property
    def levels(self) -> tuple[Level, ...]:
        """The levels made so far, from size 1 up."""
        return tuple(self._levels)

    def leaves(self, size: int) -> list[Term]:
        """Return the terms of that size without set operators."""
        return [leaf for leaf in self._leaves if leaf.key[0] == size]

    def level(self, size: int) -> Level:
        """Return the terms of that size, without those that select what a smaller one does."""
        while len(self._levels) < size:
            self._levels.append(self._grow(len(self._levels) + 1))
        return self._levels[size - 1]

    def _grow(self, size: int) -> Level:
        terms = {leaf.bits: leaf for leaf in sorted(self.leaves(size), key=lambda leaf: leaf.key, reverse=True)}
        for bits, (key, operator, x, y) in self._first_drafts(size).items():
            if bits not in terms or key < terms[bits].key:
                terms[bits] = combine(operator, x, y)
        fresh = [term for bits, term in terms.items() if bits not in self._known]
        self._known.update(terms)
        return Level(fresh, self._width)

    def _first_drafts(self, size: int) -> dict[int, Draft]:
        drafts: dict[int, Draft] = {}
        for bits, draft in self._drafts(size):
            if bits not in drafts or draft[0] < drafts[bits][0]:
                drafts[bits] = draft
        return drafts

    def _drafts(self, size: int) -> Iterator[tuple[int, Draft]]:
        """Every set operator over two smaller terms that selects something new, with what it selects."""
        known = self._known
        for small in range(1, (size - 1) // 2 + 1):
            large = self.level(size - 1 - small).terms
            for x in self.level(small).terms:
                self._budget.check()
                a, xk = x.bits, x.key
                for y in large:
                    b = y.bits
                    if a | b not in known:
                        yield a | b, (operator_key(Union, xk, y.key), Union, x, y)
                    if a & b not in known:
                        yield a & b, (operator_key(Intersect, xk, y.key), Intersect, x, y)
                    if a & ~b not in known:
                        yield a & ~b, (operator_key(Diff, xk, y.key), Diff, x, y)
                    if b & ~a not in known:
                        yield b & ~a, (operator_key(Diff, y.key, xk), Diff, y, x)


class Columns:
    """Bit sets ("rows") kept by position: column p is the set of the rows that have bit p.

    Answers are sets of rows, bit k for row k. Goals repeat what they need and what they avoid, so what was found for
    all rows is remembered.
    """

    __slots__ = ("_clear", "_columns", "_holding", "every")

    def __init__(self, rows: Sequence[int], width: int) -> None:
        self.every = (1 << len(rows)) - 1
        self._columns = _transpose(rows, width)
        self._holding: dict[int, int] = {}
        self._clear: dict[int, int] = {}

    def rows_with(self, need: int, among: int) -> int:
        """Return the rows of `among` that have every bit of `need`."""
        columns = self._columns
        while need and among:
            low = need & -need
            among &= columns[low.bit_length() - 1]
            need ^= low
        return among

    def rows_without(self, avoid: int, among: int) -> int:
        """Return the rows of `among` that have no bit of `avoid`."""
        columns = self._columns
        while avoid and among:
            low = avoid & -avoid
            among &= ~columns[low.bit_length() - 1]
            avoid ^= low
        return among

    def all_with(self, need: int) -> int:
        """Return all rows that have every bit of `need`."""
        found = self._holding.get(need)
        return self._remember(self._holding, need, self.rows_with(need, self.every)) if found is None else found

    def all_without(self, avoid: int) -> int:
        """Return all rows that have no bit of `avoid`."""
        found = self._clear.get(avoid)
        return self._remember(self._clear, avoid, self.rows_without(avoid, self.every)) if found is None else found

    @staticmethod
    def _remember(known: dict[int, int], bits: int, rows: int) -> int:
        if len(known) >= _REMEMBERED:
            known.clear()
        known[bits] = rows
        return rows


def positions(mask: int) -> Iterator[int]:
    """Yield the set bits, lowest first."""
    while mask:
        low = mask & -mask
        yield low.bit_length() - 1
        mask ^= low


def unpack_bits(rows: Sequence[int], width: int) -> Bools:
    """Return which of `width` bits each row has: (rows, width)."""
    size = (width + 7) // 8
    packed = np.frombuffer(b"".join(row.to_bytes(size, "little") for row in rows), np.uint8).reshape(len(rows), size)
    return np.unpackbits(packed, axis=1, count=width, bitorder="little").astype(np.bool_)


def _transpose(rows: Sequence[int], width: int) -> list[int]:
    if not rows:
        return [0] * width
    return [to_bits(column) for column in unpack_bits(rows, width).T]


class SearchTarget(NamedTuple):  # a tuple, as HalfTerm is: a search makes tens of thousands
    """Met by every selection with all of `need` and nothing of `avoid`; what is in neither is free."""

    need: int
    avoid: int


class HalfTerm(NamedTuple):
    """A set operator with one operand known, and the target of the other; as_right: whether the known one is right."""

    operator: SetOperator
    known: Term
    rest: SearchTarget
    as_right: bool = False

    def bits(self, other: int) -> int:
        """Return what the whole selects with an operand that selects `other` in its place."""
        if self.operator is Union:
            return self.known.bits | other
        if self.operator is Intersect:
            return self.known.bits & other
        return other & ~self.known.bits if self.as_right else self.known.bits & ~other

    def key(self, other: Key) -> Key:
        """Return the place of the whole in the order."""
        left, right = (other, self.known.key) if self.as_right else (self.known.key, other)
        return operator_key(self.operator, left, right)

    def complete(self, other: Term) -> Term:
        """Return the whole, with the other operand in its place."""
        return combine(self.operator, other, self.known) if self.as_right else combine(self.operator, self.known, other)


class Completion:
    """Finds the first term of exactly one size that meets a target, given that no smaller term meets it.

    stored: the size up to which operands are looked up in the bank; goals: how many goals of missing operands it has
    looked at.
    """

    def __init__(self, bank: Bank, budget: TimeBudget, stored: int) -> None:
        self._bank, self._budget, self._stored = bank, budget, stored
        self._known: dict[tuple[SearchTarget, int], Term | None] = {}
        self.goals = 0

    def find_first(self, target: SearchTarget, size: int) -> Term | None:
        """Return the first term of that size that meets the target. Raises OutOfTime."""
        leaves = [leaf for leaf in self._bank.leaves(size) if satisfies(leaf.bits, target)]
        return first_term([*leaves, *self._compounds(target, size)])

    def _find_operand(self, target: SearchTarget, size: int) -> Term | None:
        self.goals += 1
        if size <= self._stored:
            level = self._bank.level(size)
            return next(level.select_rows(rows_for(level, target)), None)
        if (target, size) not in self._known:
            self._known[target, size] = self.find_first(target, size)
        return self._known[target, size]

    def _compounds(self, target: SearchTarget, size: int) -> Iterator[Term]:
        """Of each set operator whose smaller operand is known, the first that meets the target."""
        for small in range(1, (size - 1) // 2 + 1):
            self._budget.check()
            for half in half_terms_for(self._bank.level(small), target, helpful=True):
                other = self._find_operand(half.rest, size - 1 - small)
                if other:
                    yield half.complete(other)


def satisfies(bits: int, target: SearchTarget) -> bool:
    """Return whether a selection meets a target."""
    return bits & target.need == target.need and not bits & target.avoid


def rows_for(level: Level, target: SearchTarget) -> int:
    """Return the rows of the terms of a level that meet a target."""
    holding = level.columns.all_with(target.need)
    return holding & level.columns.all_without(target.avoid) if holding else 0


def half_terms_for(level: Level, target: SearchTarget, helpful: bool) -> Iterator[HalfTerm]:
    """Set operators with one operand from the level that can meet the target.

    helpful: only where the operand leaves less to need or to avoid; else the other one would meet the target alone.
    """
    need, avoid, columns = target.need, target.avoid, level.columns
    holding, clear, apart = columns.all_with(need), columns.all_without(avoid), columns.all_without(need)
    for x in level.select_rows(clear & ~apart if helpful else clear):
        yield HalfTerm(Union, x, SearchTarget(need & ~x.bits, avoid))
    for x in level.select_rows(holding):
        if avoid & ~x.bits or not helpful:
            yield HalfTerm(Intersect, x, SearchTarget(need, avoid & x.bits))
        yield HalfTerm(Diff, x, SearchTarget(avoid & x.bits, need))
    for x in level.select_rows(apart & ~clear if helpful else apart):
        yield HalfTerm(Diff, x, SearchTarget(need, avoid & ~x.bits), as_right=True)
