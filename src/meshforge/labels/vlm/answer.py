"""What an answer says of hulls: read leniently, with the chances of its tokens, and added up over pictures,
questions and repeats."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import accumulate
from math import prod

from meshforge.common import join_names
from meshforge.labels.vlm.transport import Reply, Token
from meshforge.symbolic import Label

_OBJECT = re.compile(r"\{[^{}]*\}")
_NUMBER = re.compile(r"#?\s*(\d{1,9})(?:\.0)?")
_MOST_SHOWN = 60  # characters of a word that is no label

Chances = Mapping[str | None, float]
"""The chance of each label, None for unknown; they sum up to one."""

_PRIOR_WEIGHT = 0.4
"""What speaks against every label from the outset, in votes of one clear look: one vote alone makes a confidence of
0.71, two that agree 0.83, two against one 0.59."""
_LESS_UNCERTAIN = 0.1
"""The same where the server told how sure the model was, which then says most of it."""
_GLIMPSE = 300.0
"""Pixels of 1024 x 1024 of a hull from which on a look at it counts more than half."""


@dataclass(frozen=True, slots=True)
class HullAnswer:
    """What was said of the hulls asked about. said: the label of each number, None for unknown.

    odd: words that are no labels; open: numbers asked about of which nothing usable was said, in their order.
    """

    given: Mapping[int, str | None]
    unrecognised: tuple[str, ...]
    open: tuple[int, ...]

    @property
    def problem(self) -> str:
        """Why hulls are left open, in words; empty where none is."""
        if not self.open:
            return ""
        return (
            f"the model said {join_names(self.unrecognised)}, which is no label"
            if self.unrecognised
            else "the model said nothing usable of it"
        )


def read_answer(text: str, asked: Collection[int], vocabulary: Sequence[str], unknown: str) -> HullAnswer:
    """What a text says, be it JSON, JSON in chatter or code fences, or JSON that is cut off.

    Numbers that were not asked about are passed over; one with two labels is left open.
    """
    words = {_normalize(word): word for word in vocabulary}
    given: dict[int, set[str | None]] = {}
    unrecognised: list[str] = []
    for number, word in _entries(text):
        if number not in asked:
            continue
        label = word if word in vocabulary else words.get(_normalize(word))
        if label is not None:
            given.setdefault(number, set()).add(label)
        elif _normalize(word) == _normalize(unknown):
            given.setdefault(number, set()).add(None)
        else:
            unrecognised.append(word[:_MOST_SHOWN])
    clear = {number: next(iter(labels)) for number, labels in sorted(given.items()) if len(labels) == 1}
    left = tuple(number for number in sorted(asked) if number not in clear)
    return HullAnswer(clear, tuple(dict.fromkeys(unrecognised)), left)


def _normalize(word: str) -> str:
    """A word without what models change at whim: case, spaces for underscores, marks about it."""
    return " ".join(re.sub(r"[\s_\-]+", " ", word.strip().strip("\"'`*.")).casefold().split())


def _entries(text: str) -> Iterator[tuple[int, str]]:
    """The numbers with their words in the last list of hulls, since a model may think aloud before it; an entry that
    is cut off is left out."""
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


def label_chances(reply: Reply, answer: HullAnswer, vocabulary: Sequence[str], unknown: str) -> dict[int, Chances]:
    """The chances of all labels for each number that has one, as far as the server gave them.

    That of the label itself is the product over its tokens; the others share what is left.
    """
    text, whole = reply.text.encode(), b"".join(token.text for token in reply.tokens or ())
    start = whole.rfind(text)
    if not reply.tokens or start < 0:
        return {}
    words: dict[bytes, str | None] = {word.encode(): word for word in vocabulary} | {unknown.encode(): None}
    found = dict[int, Chances]()
    for number, label in answer.given.items():
        places = list(re.finditer(rb'"number"\s*:\s*%d\s*,\s*"label"\s*:\s*"([^"\\]*)"' % number, text))
        if places and words.get(places[-1][1], "") == label:
            own = _chance_of(reply.tokens, start + places[-1].start(1), start + places[-1].end(1))
            others = (1 - own) / (len(words) - 1)
            found[number] = {word: own if word == label else others for word in words.values()}
    return found


def _chance_of(tokens: Sequence[Token], start: int, end: int) -> float:
    """The product of the chances of the tokens between two places of their text."""
    ends = list(accumulate(len(token.text) for token in tokens))
    rows = zip(tokens, [0, *ends], ends, strict=False)
    return prod(token.chance for token, first, last in rows if first < end and last > start)


@dataclass(frozen=True, slots=True)
class LabelVote:
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


def decide_label(votes: Iterable[LabelVote], vocabulary: Sequence[str]) -> tuple[str, float] | None:
    """The label with most evidence and its confidence; None where nothing was said, or unknown has most.

    Of equals the first of the vocabulary.
    """
    score: dict[str | None, float] = dict.fromkeys((*vocabulary, None), 0.0)
    total = reason = 0.0
    for vote in votes:
        for label, chance in (vote.chances or {vote.label: 1.0}).items():
            score[label] += vote.weight * chance
        total += vote.weight
        reason = max(reason, _PRIOR_WEIGHT if vote.chances is None else _LESS_UNCERTAIN)
    best = max(score, key=lambda label: score[label])
    if not total or best is None:
        return None
    return best, round(score[best] / (total + reason), 4)


@dataclass(frozen=True, slots=True)
class VlmAnswers:
    """What a model said of a mesh. labels: by hull; open: why others that were asked about have none, by hull.

    failed: complaints about questions that got no answer, in their order, each once; asked: the digests of all
    questions that got one.
    """

    labels: Mapping[str, Label] = field(default_factory=dict)
    open: Mapping[str, str] = field(default_factory=dict)
    failed: tuple[str, ...] = ()
    asked: tuple[str, ...] = ()
