"""Reading an answer about hulls: strictly what it says, leniently how it says it."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from meshforge.words import listed

_OPENING = re.compile(r"[{\[]")
_NUMBER = re.compile(r"#?\s*(\d{1,9})")
_SHOWN = 60  # characters of a word that is no label


@dataclass(frozen=True, slots=True)
class Answer:
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
            f"the model said {listed(self.odd)}, which is no label"
            if self.odd
            else "the model said nothing usable of it"
        )


def read_answer(text: str, asked: Collection[int], vocabulary: Sequence[str], unknown: str) -> Answer:
    """What a text says, be it JSON, JSON in chatter or code fences, or JSON that is cut off.

    Numbers that were not asked about are passed over; one with two labels is left open.
    """
    words = {_plain(word): word for word in vocabulary}
    said: dict[int, set[str | None]] = {}
    odd: list[str] = []
    for number, word in _entries(text):
        if number not in asked:
            continue
        label = word if word in vocabulary else words.get(_plain(word))
        if label is not None:
            said.setdefault(number, set()).add(label)
        elif _plain(word) == _plain(unknown):
            said.setdefault(number, set()).add(None)
        else:
            odd.append(word[:_SHOWN])
    clear = {number: next(iter(labels)) for number, labels in sorted(said.items()) if len(labels) == 1}
    left = tuple(number for number in sorted(asked) if number not in clear)
    return Answer(clear, tuple(dict.fromkeys(odd)), left)


def _plain(word: str) -> str:
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
    """All JSON objects and lists in a text that are whole, outermost only."""
    decoder, place = json.JSONDecoder(), 0
    while match := _OPENING.search(text, place):
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
