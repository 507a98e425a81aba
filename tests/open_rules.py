"""Answers to what learning leaves open."""

from __future__ import annotations

from meshforge.synthesis import Answer, OpenRule


def choose(one: OpenRule, place: int | None) -> Answer:
    """The answer that takes a selection by its place, None for none of them."""
    if place is None:
        return Answer(one.rule, one.asset, None, one.selections)
    return Answer(one.rule, one.asset, one.selections[place])


def answer_truly(one: OpenRule, truth: frozenset[str]) -> Answer:
    """The answer that takes the right selection, or none of them where it is not offered."""
    return choose(one, one.selections.index(truth) if truth in one.selections else None)
