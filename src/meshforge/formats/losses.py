"""What a written file does not hold of the asset it was made from, as sentences and as data."""

from __future__ import annotations

from dataclasses import dataclass

from meshforge.asset import What
from meshforge.words import counted, listed


@dataclass(frozen=True, slots=True)
class Loss:
    """Things of one kind that are not in the output as they were.

    why: the reason, a clause; instead: how they are there all the same (`written as triangles`), None where they are
    not; unnamed: how many there are that have no name.
    """

    kind: What
    names: tuple[str, ...]
    why: str
    instead: str | None = None
    unnamed: int = 0

    @property
    def count(self) -> int:
        return len(self.names) + self.unnamed

    def __str__(self) -> str:
        named = f" ({listed(self.names, 3)})" if self.names else ""
        verb = "is" if self.count == 1 else "are"
        head = f"{counted(self.count, self.kind.one, self.kind.many)}{named}"
        return f"{head} {verb} {self.instead or 'left out'}: {self.why}"
