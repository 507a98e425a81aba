"""What an answer says of hulls: read leniently, and added up over pictures, questions and repeats."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from meshforge.common import join_names

_OBJECT = re.compile(r"\{[^{}]*\}")
_NUMBER = re.compile(r"#?\s*(\d{1,9})(?:\.0)?")
_MOST_SHOWN = 60  # characters of a word that is no label

LabelVote = tuple[str | None, float]
"""What one answer says of a hull, None for unknown, and how well it was seen, in 0..1."""

_AGAINST = 0.4
"""What speaks against every label from the outset, in votes of one clear look: one vote alone makes a confidence of
0.71, two that agree 0.83, two against one 0.59."""
_GLIMPSE = 300.0
"""Pixels of 1024 x 1024 of a hull from which on a look at it counts more than half."""


@dataclass(frozen=True, slots=True)
class HullAnswer:
    """What was said of the hulls asked about. labels: by number, None for unknown.

    odd: words that are no labels; open: numbers asked about of which nothing usable was said, in their order.
    """

    labels: Mapping[int, str | None]
    unrecognised: tuple[str, ...]
    open: tuple[int, ...]

    @property
    def problem(self) -> str:
        """Why hulls are left open, in words; empty where none is."""
        if not self.open:
            return ""
        if self.unrecognised:
            return f"the model said {join_names(self.unrecognised)}, which is no label"
        return "the model said nothing usable of it"


def read_answer(text: str, asked: Collection[int], vocabulary: Sequence[str], unknown: str) -> HullAnswer:
    """Return what a text says, be it JSON, JSON in chatter or code fences, or JSON that is cut off.

    Numbers that were not asked about are passed over; one with two labels is left open.
    """
    words: dict[str, str | None] = {_normalize(unknown): None} | {_normalize(word): word for word in vocabulary}
    found: dict[int, set[str | None]] = {}
    unrecognised = dict[str, None]()
    for number, word in _entries(text):
        if number not in asked:
            continue
        if word in vocabulary:
            found.setdefault(number, set()).add(word)
        elif (key := _normalize(word)) in words:
            found.setdefault(number, set()).add(words[key])
        else:
            unrecognised[word[:_MOST_SHOWN]] = None
    labels = {number: labels.pop() for number, labels in sorted(found.items()) if len(labels) == 1}
    return HullAnswer(labels, tuple(unrecognised), tuple(number for number in sorted(asked) if number not in labels))


def _normalize(word: str) -> str:
    """A word without what models change at whim: case, spaces for underscores, marks about it."""
    return " ".join(re.sub(r"[\s_\-]+", " ", word.strip().strip("\"'`*.")).casefold().split())


def _entries(text: str) -> Iterator[tuple[int, str]]:
    """The numbers with their words in the last list of hulls: before it a model may think aloud."""
    _, _, last = text.rpartition('"hulls"')
    for part in _OBJECT.findall(last):
        try:
            found = json.loads(part)
        except ValueError:
            continue
        rows = [(found["number"], found.get("label"))] if "number" in found else found.items()
        for number, word in rows:
            if isinstance(word, str) and (match := _NUMBER.fullmatch(str(number).strip())):
                yield int(match[1]), word


def clearness(pixels: int, size: int) -> float:
    """Return how well a hull is seen of which so many pixels show in pictures of `size` x `size`, in 0..1."""
    full = pixels * (1024 / size) ** 2
    return full / (full + _GLIMPSE)


def decide_label(votes: Iterable[LabelVote], vocabulary: Sequence[str]) -> tuple[str, float] | None:
    """Return the label with most evidence and its confidence; None where nothing was said, or unknown has most.

    Of equals the first of the vocabulary.
    """
    score: dict[str | None, float] = dict.fromkeys((*vocabulary, None), 0.0)
    for label, weight in votes:
        score[label] += weight
    best = max(score, key=lambda label: score[label])
    if best is None or not score[best]:
        return None
    return best, round(score[best] / (sum(score.values()) + _AGAINST), 4)
