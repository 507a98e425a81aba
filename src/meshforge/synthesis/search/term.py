"""An extractor together with what it selects."""

from __future__ import annotations

from dataclasses import dataclass

from meshforge.language import Diff, Extractor, Union
from meshforge.synthesis.search.order import Joint, Key, joint_key


@dataclass(frozen=True, slots=True)
class Term:
    """An extractor, its place in the order, and its selection as a bit set over the search's groups of hulls."""

    bits: int
    key: Key
    extractor: Extractor


def joined(joint: Joint, left: Term, right: Term) -> Term:
    """A set operator over two terms; the operands of `Union` and `Intersect` are put in order."""
    if joint is not Diff and right.key < left.key:
        left, right = right, left
    if joint is Union:
        bits = left.bits | right.bits
    else:
        bits = left.bits & ~right.bits if joint is Diff else left.bits & right.bits
    return Term(bits, joint_key(joint, left.key, right.key), joint(left.extractor, right.extractor))


def first(terms: list[Term]) -> Term | None:
    """The first of the terms in the order."""
    return min(terms, key=lambda term: term.key, default=None)
