"""An extractor together with what it selects."""

from __future__ import annotations

from dataclasses import dataclass

from meshforge.language import All, Attach, Diff, Extractor, Geo, Is, Union
from meshforge.synthesis.search.order import Joint, Key, joint_key


@dataclass(frozen=True, slots=True, eq=False)
class Joined:
    """A set operator over two terms."""

    operator: Joint
    left: Term
    right: Term


@dataclass(frozen=True, slots=True, eq=False)
class Term:
    """An extractor, its place in the order, and its selection as a bit set over the search's groups of hulls.

    made: the extractor itself, or the operands it is put together from: most terms are never written out.
    """

    bits: int
    key: Key
    form: All | Is | Attach | Geo | Joined

    @property
    def extractor(self) -> Extractor:
        """The term written out."""
        made = self.form
        return made.operator(made.left.extractor, made.right.extractor) if isinstance(made, Joined) else made

    @property
    def size(self) -> int:
        """Its syntax nodes."""
        size: int = self.key[0]
        return size

    @property
    def doubts(self) -> int:
        """How much in it fits by accident easily (search/order.py)."""
        doubts: int = self.key[1]
        return doubts


def joined(joint: Joint, left: Term, right: Term) -> Term:
    """A set operator over two terms; the operands of `Union` and `Intersect` are put in order."""
    if joint is not Diff and right.key < left.key:
        left, right = right, left
    if joint is Union:
        bits = left.bits | right.bits
    else:
        bits = left.bits & ~right.bits if joint is Diff else left.bits & right.bits
    return Term(bits, joint_key(joint, left.key, right.key), Joined(joint, left, right))


def first(terms: list[Term]) -> Term | None:
    """The first of the terms in the order."""
    return min(terms, key=lambda term: term.key, default=None)
