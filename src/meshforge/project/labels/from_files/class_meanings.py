"""What the classes of other tools and datasets mean in the vocabulary of a project."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from meshforge.perception.names import Pattern, fitting, said


@dataclass(frozen=True, slots=True)
class Meaning:
    """label: the label that a class means, None for one that is to be left out; sure: how surely it means that."""

    label: str | None
    sure: float = 1.0


def meaning_of(name: str, vocabulary: Sequence[str], patterns: Sequence[Pattern] = ()) -> Meaning | None:
    """What a class means: by a pattern, else the label of its name, else the one whose words are in it; None: nothing.

    `rotation_door` means `door`; words that are only nearly those of a label do not count.
    """
    if pattern := fitting(name, patterns):
        return Meaning(pattern.label or None)
    if name in vocabulary:
        return Meaning(name)
    one = said(name, vocabulary)
    return Meaning(one.label, one.confidence) if one and one.exact else None
