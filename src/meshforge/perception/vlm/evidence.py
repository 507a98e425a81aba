"""Adding up what was said of a hull in several pictures, questions and repeats."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from meshforge.perception.vlm.certainty import Chances

_DOUBT = 0.4
"""What speaks against every label from the outset, in votes of one clear look: one vote alone makes a confidence of
0.71, two that agree 0.83, two against one 0.59."""
_LESS_DOUBT = 0.1
"""The same where the server told how sure the model was, which then says most of it."""
_GLIMPSE = 300.0
"""Pixels of 1024 x 1024 of a hull from which on a look at it counts more than half."""


@dataclass(frozen=True, slots=True)
class Vote:
    """What one answer says of a hull: None for unknown; weight: how well it was seen, in 0..1.

    chances: of all labels, None where the server did not tell.
    """

    label: str | None
    weight: float
    chances: Chances | None = None


def clearness(pixels: int, size: int) -> float:
    """How well a hull is seen of which so many pixels show in pictures of `size` x `size`, in 0..1."""
    full = pixels * (1024 / size) ** 2
    return full / (full + _GLIMPSE)


def verdict(votes: Iterable[Vote], vocabulary: Sequence[str]) -> tuple[str, float] | None:
    """The label with most evidence and its confidence; None where nothing was said, or unknown has most.

    Of equals the first of the vocabulary.
    """
    score: dict[str | None, float] = dict.fromkeys((*vocabulary, None), 0.0)
    total = doubt = 0.0
    for vote in votes:
        for label, chance in (vote.chances or {vote.label: 1.0}).items():
            score[label] += vote.weight * chance
        total += vote.weight
        doubt = max(doubt, _DOUBT if vote.chances is None else _LESS_DOUBT)
    best = max(score, key=lambda label: score[label])
    if not total or best is None:
        return None
    return best, round(score[best] / (total + doubt), 4)
