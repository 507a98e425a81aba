"""What learning leaves open, and what a person says to it: answers, and corrections of labels."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from meshforge.common import DemonstrationError


@dataclass(frozen=True, slots=True, order=True)
class LabelFix:
    """One hull of a demonstrated mesh gets another label; was: None where it has none.

    asset: how messages call the mesh.
    """

    asset: str
    hull: str
    was: str | None
    to: str

    @property
    def id(self) -> str:
        """What it is called: `ASSET#HULL=LABEL`, with the label that it gives."""
        return f"{self.asset}#{self.hull}={self.to}"

    @property
    def reverse(self) -> LabelFix | None:
        """The correction that undoes this one, None where the hull had no label."""
        return None if self.was is None else LabelFix(self.asset, self.hull, self.to, self.was)


@dataclass(frozen=True, slots=True)
class OpenRule:
    """A rule that the demonstrations leave open, and the asset where that is best seen.

    selections: what its believable readings select there, names of hulls, each once; that of the program first.
    """

    rule: int
    asset: str
    selections: tuple[frozenset[str], ...]

    @property
    def id(self) -> str:
        return f"{self.rule}:{self.asset}"


@dataclass(frozen=True, slots=True, init=False)
class Answer:
    """What a person said: the hulls that a rule selects on an asset; None: neither of the choices.

    refused: where it is neither, the choices there were. price: of a reading that does otherwise [nats], where labels
    may be at fault; None where an answer is certain.
    """

    rule: int
    asset: str
    select: frozenset[str] | None
    refused: tuple[frozenset[str], ...] = ()
    price: float | None = None

    def __init__(
        self,
        rule: int,
        asset: str,
        select: Iterable[str] | None,
        refused: Iterable[Iterable[str]] = (),
        price: float | None = None,
    ) -> None:
        if isinstance(select, str):
            problem = f"rule {rule}: an answer is a set of hull names, not the text {select!r}"
            raise DemonstrationError(problem, remedy=f"Write {{{select!r}}}.")
        object.__setattr__(self, "rule", rule)
        object.__setattr__(self, "asset", asset)
        object.__setattr__(self, "select", None if select is None else frozenset(select))
        object.__setattr__(self, "refused", tuple(map(frozenset, refused)))
        object.__setattr__(self, "price", price)


@dataclass(frozen=True, slots=True)
class Repair:
    """A label that is probably wrong, with what would be right.

    rule: the first one that needs it; belief: that it is right, in 0..1; why: one sentence.
    """

    fix: LabelFix
    rule: int
    belief: float
    why: str


@dataclass(frozen=True, slots=True)
class Hint:
    """The asset that is best demonstrated next, and why, in a sentence."""

    asset: str
    why: str
