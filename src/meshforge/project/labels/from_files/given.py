"""What a file gives to the hulls of an asset."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from meshforge.errors import nearest
from meshforge.symbolic import Label
from meshforge.words import counted


@dataclass(frozen=True, slots=True)
class Given:
    """labels, names: by hull, its label and what the file itself calls it; problems: a sentence on each left out."""

    labels: Mapping[str, Label] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)
    problems: Sequence[str] = ()


def unknown(name: str, hulls: int, vocabulary: Sequence[str]) -> str:
    """The sentence on a name that means nothing in a vocabulary."""
    like = nearest(name, vocabulary)
    hint = f"; did you mean {like!r}?" if like else ""
    return (
        f"{counted(hulls, 'hull')} left out: {name!r} is not in the vocabulary, and no pattern says what it means{hint}"
    )
