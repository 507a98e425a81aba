"""What all the names of a hull say together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from meshforge.asset import Mentions
from meshforge.perception.names.patterns import Pattern, fitting
from meshforge.perception.names.saying import UNSURE, said

How = Literal["pattern", "word", "likeness"]

NAMELESS = "body"
"""What formats without bodies call the only one."""
_PATTERN = 0.9
_SURE = 0.5  # a name that is less sure gives way to the next
_LESS = {"body": 0.1, "class": 0.1, "shown": 0.1, "material": 0.2}  # what a name says of several things at once
_HULL = "hull"
_OWN = ("visual", "mesh", "group", "node")
_DIGITS = 2


@dataclass(frozen=True, slots=True)
class Names:
    """The names of a hull: its own, that of its body, and what else its file calls it."""

    hull: str
    body: str
    mentions: Mentions = ()

    @property
    def own(self) -> str:
        """Its name without that of its body."""
        return self.hull.removeprefix(f"{self.body}/")

    def own_names(self) -> Iterator[tuple[str, str]]:
        """The kinds and the names that are its own, not its body's."""
        yield _HULL, self.own
        yield from ((kind, name) for kind, name in self.mentions if kind in _OWN)

    def all_names(self) -> Iterator[tuple[str, str]]:
        """The kinds and the names, what is most its own first; a body that has no real name is left out."""
        yield from self.own_names()
        if self.body != NAMELESS:
            yield "body", self.body
        yield from ((kind, name) for kind, name in self.mentions if kind not in _OWN)


@dataclass(frozen=True, slots=True)
class Told:
    """What names say: a label, None for a hull that a pattern leaves without one; how sure, and by which name of what
    kind (`hull`, `body`, or one of `Mentions`)."""

    label: str | None
    confidence: float
    kind: str
    name: str
    how: How


def told(names: Names, vocabulary: Sequence[str], patterns: Sequence[Pattern] = ()) -> Told | None:
    """What the names of a hull say, None where they say nothing.

    Patterns come first, then words; each name of the hull is asked in turn, its own first.
    """
    return _by_pattern(names, patterns) or _by_words(names, vocabulary)


def _by_pattern(names: Names, patterns: Sequence[Pattern]) -> Told | None:
    for kind, name in (*names.all_names(), (_HULL, names.hull)):
        if pattern := fitting(name, patterns):
            return Told(pattern.label or None, _PATTERN, kind, name, "pattern")
    return None


def _by_words(names: Names, vocabulary: Sequence[str]) -> Told | None:
    """What the first name says that is sure of it, else the one that is surest.

    It is unsure after all where another name of the hull's own is as sure of another label.
    """
    found = list(_said(names, vocabulary))
    sure = [one for one in found if one.confidence >= _SURE]
    if not sure:
        return max(found, key=lambda one: one.confidence, default=None)
    own = {one.label for one in sure if one.kind in (_HULL, *_OWN)}
    return replace(sure[0], confidence=UNSURE) if len(own) > 1 else sure[0]


def _said(names: Names, vocabulary: Sequence[str]) -> Iterator[Told]:
    for kind, name in names.all_names():
        if one := said(name, vocabulary):
            confidence = round(one.confidence - _LESS.get(kind, 0.0), _DIGITS)
            yield Told(one.label, confidence, kind, name, "word" if one.exact else "likeness")
