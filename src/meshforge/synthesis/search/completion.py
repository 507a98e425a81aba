"""Goal-directed search: what must the missing part of an extractor hold, and what must it avoid?

Knowing one operand of a set operator turns the goal of the whole into a wider goal for the other operand, and the
index of the bank finds at once what satisfies it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from meshforge.language import Diff, Intersect, Union
from meshforge.synthesis.options import Shortcuts, TimeBudget
from meshforge.synthesis.search.bank import Bank, Level
from meshforge.synthesis.search.terms import Key, SetOperator, Term, combine, first_term, operator_key


@dataclass(frozen=True, slots=True)
class Goal:
    """Met by every selection with all of `need` and nothing of `avoid`; what is in neither is free."""

    need: int
    avoid: int


@dataclass(frozen=True, slots=True)
class HalfTerm:
    """A set operator with one operand known, and the goal of the other; as_right: whether the known one is right."""

    operator: SetOperator
    known: Term
    rest: Goal
    as_right: bool = False

    def bits(self, other: int) -> int:
        """What the whole selects with an operand that selects `other` in its place."""
        if self.operator is Union:
            return self.known.bits | other
        if self.operator is Intersect:
            return self.known.bits & other
        return other & ~self.known.bits if self.as_right else self.known.bits & ~other

    def key(self, other: Key) -> Key:
        """The place of the whole in the order."""
        left, right = (other, self.known.key) if self.as_right else (self.known.key, other)
        return operator_key(self.operator, left, right)

    def complete(self, other: Term) -> Term:
        """The whole, with the other operand in its place."""
        return combine(self.operator, other, self.known) if self.as_right else combine(self.operator, self.known, other)


class Completion:
    """Finds the first term of exactly one size that meets a goal, given that no smaller term meets it.

    goals: how many goals of missing operands it has looked at.
    """

    def __init__(self, bank: Bank, budget: TimeBudget, shortcuts: Shortcuts) -> None:
        self._bank = bank
        self._budget = budget
        self._shortcuts = shortcuts
        self._known: dict[tuple[Goal, int], Term | None] = {}
        self.goals = 0

    def find_first(self, goal: Goal, size: int) -> Term | None:
        """The first term of that size that meets the goal. Raises OutOfTime."""
        if not self._shortcuts.complete:
            return _first_term_for(self._bank.level(size), goal)
        leaves = [leaf for leaf in self._bank.leaves(size) if satisfies(leaf.bits, goal)]
        return first_term([*leaves, *self._compounds(goal, size)])

    def _find_operand(self, goal: Goal, size: int) -> Term | None:
        self.goals += 1
        if size <= self._shortcuts.stored:
            return _first_term_for(self._bank.level(size), goal)
        if (goal, size) not in self._known:
            self._known[goal, size] = self.find_first(goal, size)
        return self._known[goal, size]

    def _compounds(self, goal: Goal, size: int) -> Iterator[Term]:
        """Of each set operator whose smaller operand is known, the first that meets the goal."""
        for small in range(1, (size - 1) // 2 + 1):
            self._budget.check()
            for half in half_terms_for(self._bank.level(small), goal, self._shortcuts.help):
                other = self._find_operand(half.rest, size - 1 - small)
                if other:
                    yield half.complete(other)


def satisfies(bits: int, goal: Goal) -> bool:
    """Whether a selection meets a goal."""
    return bits & goal.need == goal.need and not bits & goal.avoid


def terms_for(level: Level, goal: Goal) -> Iterator[Term]:
    """The terms of a level that meet a goal, in order."""
    columns = level.columns
    return level.select_rows(columns.rows_without(goal.avoid, columns.rows_with(goal.need, columns.every)))


def _first_term_for(level: Level, goal: Goal) -> Term | None:
    return next(terms_for(level, goal), None)


def half_terms_for(level: Level, goal: Goal, helpful: bool) -> Iterator[HalfTerm]:
    """Set operators with one operand from the level that can meet the goal.

    helpful: only where the operand leaves less to need or to avoid; else the other one would meet the goal alone.
    """
    need, avoid, columns = goal.need, goal.avoid, level.columns
    holding = columns.rows_with(need, columns.every)
    clear = columns.rows_without(avoid, columns.every)
    apart = columns.rows_without(need, columns.every)
    for x in level.select_rows(clear & ~apart if helpful else clear):
        yield HalfTerm(Union, x, Goal(need & ~x.bits, avoid))
    for x in level.select_rows(holding):
        if avoid & ~x.bits or not helpful:
            yield HalfTerm(Intersect, x, Goal(need, avoid & x.bits))
        yield HalfTerm(Diff, x, Goal(avoid & x.bits, need))
    for x in level.select_rows(apart & ~clear if helpful else apart):
        yield HalfTerm(Diff, x, Goal(need, avoid & ~x.bits), as_right=True)
