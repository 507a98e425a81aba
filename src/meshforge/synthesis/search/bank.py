"""Every selection that small extractors make, each with the first extractor that makes it, grown size by size."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from meshforge.language import Diff, Intersect, Union
from meshforge.synthesis.search.columns import Columns, positions
from meshforge.synthesis.search.order import Joint, Key, joint_key
from meshforge.synthesis.search.term import Term, joined
from meshforge.synthesis.watch import Watch

Draft = tuple[Key, Joint, Term, Term]
"""A set operator over two terms, before it is known to be worth keeping."""


class Level:
    """The terms of one size, in order, and the index over what they select."""

    __slots__ = ("columns", "terms")

    def __init__(self, terms: Sequence[Term], width: int) -> None:
        self.terms = tuple(sorted(terms, key=lambda term: term.key))
        self.columns = Columns([term.bits for term in self.terms], width)

    def select_rows(self, rows: int) -> Iterator[Term]:
        """The terms of a set of rows, in order."""
        return (self.terms[k] for k in positions(rows))


class Bank:
    """Terms by size, made when asked for; of the terms that select the same only the first in the order is kept.

    What selects nothing is not kept: a smallest extractor of something has no such part.
    merge: False keeps every term instead (to test that the answer is the same).
    """

    def __init__(self, leaves: Sequence[Term], width: int, watch: Watch, merge: bool = True) -> None:
        self._leaves = leaves
        self._width = width
        self._watch = watch
        self._merge = merge
        self._levels: list[Level] = []
        self._known: set[int] = {0}

    @property
    def levels(self) -> tuple[Level, ...]:
        """The levels made so far, from size 1 up."""
        return tuple(self._levels)

    def leaves(self, size: int) -> list[Term]:
        """The terms of that size without set operators."""
        return [leaf for leaf in self._leaves if leaf.key[0] == size]

    def level(self, size: int) -> Level:
        """The terms of that size, without those that select what a smaller one does."""
        while len(self._levels) < size:
            self._levels.append(self._grow(len(self._levels) + 1))
        return self._levels[size - 1]

    def _grow(self, size: int) -> Level:
        if not self._merge:
            every = [joined(joint, x, y) for _, (_, joint, x, y) in self._drafts(size)]
            return Level([*self.leaves(size), *every], self._width)
        terms = {leaf.bits: leaf for leaf in sorted(self.leaves(size), key=lambda leaf: leaf.key, reverse=True)}
        for bits, (key, joint, x, y) in self._first_drafts(size).items():
            if bits not in terms or key < terms[bits].key:
                terms[bits] = joined(joint, x, y)
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
        known = self._known if self._merge else frozenset[int]()
        for small in range(1, (size - 1) // 2 + 1):
            large = self.level(size - 1 - small).terms
            for x in self.level(small).terms:
                self._watch.check()
                a, xk = x.bits, x.key
                for y in large:
                    b = y.bits
                    if a | b not in known:
                        yield a | b, (joint_key(Union, xk, y.key), Union, x, y)
                    if a & b not in known:
                        yield a & b, (joint_key(Intersect, xk, y.key), Intersect, x, y)
                    if a & ~b not in known:
                        yield a & ~b, (joint_key(Diff, xk, y.key), Diff, x, y)
                    if b & ~a not in known:
                        yield b & ~a, (joint_key(Diff, y.key, xk), Diff, y, x)
