"""What an answer says of hulls: read leniently, with the chances of its tokens, and added up over pictures,
questions and repeats."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from meshforge.common import join_names
from meshforge.labels.vlm.transport import Reply, Token
from meshforge.symbolic import Label

_BRACKET = re.compile(r"[{\[]")
_NUMBER = re.compile(r"#?\s*(\d{1,9})")
_MOST_SHOWN = 60  # characters of a word that is no label

Chances = Mapping[str | None, float]
"""The chance of each label, None for unknown; they sum up to one."""

_DOUBT = 0.4
"""What speaks against every label from the outset, in votes of one clear look: one vote alone makes a confidence of
0.71, two that agree 0.83, two against one 0.59."""
_LESS_DOUBT = 0.1
"""The same where the server told how sure the model was, which then says most of it."""
_GLIMPSE = 300.0
"""Pixels of 1024 x 1024 of a hull from which on a look at it counts more than half."""


@dataclass(frozen=True, slots=True)
class HullAnswer:
    """What was said of the hulls asked about. said: the label of each number, None for unknown.

    odd: words that are no labels; open: numbers asked about of which nothing usable was said, in their order.
    """

    said: Mapping[int, str | None]
    odd: tuple[str, ...]
    open: tuple[int, ...]

    @property
    def problem(self) -> str:
        """Why hulls are left open, in words; empty where none is."""
        if not self.open:
            return ""
        return (
            f"the model said {join_names(self.odd)}, which is no label"
            if self.odd
            else "the model said nothing usable of it"
        )


def read_answer(text: str, asked: Collection[int], vocabulary: Sequence[str], unknown: str) -> HullAnswer:
    """What a text says, be it JSON, JSON in chatter or code fences, or JSON that is cut off.

    Numbers that were not asked about are passed over; one with two labels is left open.
    """
    words = {_normalize(word): word for word in vocabulary}
    said: dict[int, set[str | None]] = {}
    odd: list[str] = []
    for number, word in _entries(text):
        if number not in asked:
            continue
        label = word if word in vocabulary else words.get(_normalize(word))
        if label is not None:
            said.setdefault(number, set()).add(label)
        elif _normalize(word) == _normalize(unknown):
            said.setdefault(number, set()).add(None)
        else:
            odd.append(word[:_MOST_SHOWN])
    clear = {number: next(iter(labels)) for number, labels in sorted(said.items()) if len(labels) == 1}
    left = tuple(number for number in sorted(asked) if number not in clear)
    return HullAnswer(clear, tuple(dict.fromkeys(odd)), left)


def _normalize(word: str) -> str:
    """A word without what models change at whim: case, spaces for underscores, marks about it."""
    return " ".join(re.sub(r"[\s_\-]+", " ", word.strip().strip("\"'`*.")).casefold().split())


def _entries(text: str) -> list[tuple[int, str]]:
    """Numbers with the words said of them, in the last form that is filled in: before it a model may think aloud.

    Entries without a form around them belong together: they are of an answer that was cut off.
    """
    found: list[tuple[int, str]] = []
    loose = False
    for value in _documents(text):
        rows, single = list(_rows(value)), isinstance(value, dict) and "number" in value
        if rows:
            found = [*found, *rows] if single and loose else rows
            loose = single
    return found


def _documents(text: str) -> Iterator[Any]:
    decoder, place = json.JSONDecoder(), 0
    while match := _BRACKET.search(text, place):
        try:
            value, place = decoder.raw_decode(text, match.start())
        except ValueError:
            place = match.start() + 1
        except RecursionError:  # nobody means that
            return
        else:
            yield value


def _rows(value: Any) -> Iterator[tuple[int, str]]:
    """The entries in a document of the form asked for, or of those that models like to take instead."""
    match value:
        case {"hulls": list() | dict() as inner}:
            yield from _rows(inner)
        case {"number": number, "label": str(word)}:
            yield from _row(number, word)
        case list():
            for entry in value:
                if isinstance(entry, dict):
                    yield from _rows(entry)
        case dict():
            for key, word in value.items():
                if isinstance(word, str):
                    yield from _row(key, word)


def _row(number: Any, word: str) -> Iterator[tuple[int, str]]:
    if isinstance(number, int) and not isinstance(number, bool):
        yield number, word
    elif isinstance(number, float) and number.is_integer():
        yield int(number), word
    elif isinstance(number, str) and (match := _NUMBER.fullmatch(number.strip())):
        yield int(match[1]), word


def label_chances(reply: Reply, answer: HullAnswer, vocabulary: Sequence[str], unknown: str) -> dict[int, Chances]:
    """The chances of all labels for each number that has one, as far as the server told them."""
    if not reply.tokens:
        return {}
    text, whole = reply.text.encode(), b"".join(token.text for token in reply.tokens)
    start = whole.rfind(text)
    if start < 0:
        return {}
    words: dict[bytes, str | None] = {word.encode(): word for word in vocabulary} | {unknown.encode(): None}
    found = {}
    for number, label in answer.said.items():
        places = list(re.finditer(rb'"number"\s*:\s*%d\s*,\s*"label"\s*:\s*"([^"\\]*)"' % number, text))
        word = places[-1][1] if places else b""
        if words.get(word, "") == label and word in words:
            found[number] = _spread_chances(reply.tokens, start + places[-1].start(1), word, words)
    return found


def _spread_chances(tokens: Sequence[Token], start: int, word: bytes, words: Mapping[bytes, str | None]) -> Chances:
    """The chances of all words in the place of one that begins at `start`.

    That of the word itself is the product over its tokens. The others share what is left: as the tokens say that were
    likely instead of the first, then evenly.
    """
    own, first, place, before = 1.0, None, 0, 0
    for token in tokens:
        end = place + len(token.text)
        if place < start + len(word) and end > start:
            own *= token.chance
            if first is None:
                first, before = token, max(0, start - place)
        place = end
    if first is None:
        return {words[word]: 1.0}
    share = dict.fromkeys(words, 0.0)
    for text, chance in first.others.items():
        head, rest = text[:before], text[before:]
        like = [one for one in words if one != word and rest and (one.startswith(rest) or rest.startswith(one))]
        if head == first.text[:before] and text != first.text and like:
            for one in like:
                share[one] += chance / len(like)
    share[word] = own
    left, others = max(0.0, 1 - sum(share.values())), len(words) - 1
    spread = {one: chance + (left / others if one != word else 0.0) for one, chance in share.items()}
    total = sum(spread.values()) or 1.0
    return {words[one]: chance / total for one, chance in spread.items()}


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
