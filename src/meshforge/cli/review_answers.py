"""Replies to the questions of a review: from a file, from the line that a person types, and what they contradict."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from meshforge.cli.review_text import letter_of
from meshforge.common import UsageError
from meshforge.signoff import HullPlace, ReviewQuestion, ReviewReply, ReviewState
from meshforge.symbolic import HUMAN_SOURCES

_FORM = (
    'Expected a list of {"id", "choice": a number from 0, or null for none of the choices, "exceptions": '
    '{"ASSET#HULL": LABEL}, "later": true}.'
)


def read_replies(path: Path) -> list[ReviewReply]:
    """Replies from a file. Raises UsageError, naming the entry and the field, where it is not what it should be."""
    try:
        rows = json.loads(path.read_text("utf-8-sig"))
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError("the replies cannot be read", where=str(path)) from error
    except (ValueError, RecursionError) as error:
        raise UsageError("this is no JSON", where=str(path), remedy=_FORM) from error
    if not isinstance(rows, list):
        raise UsageError("this is no list of replies", where=str(path), remedy=_FORM)
    try:
        return [_to_reply(number, row) for number, row in enumerate(rows, 1)]
    except ValueError as error:
        raise UsageError(str(error), where=str(path), remedy=_FORM) from error


def _to_reply(number: int, row: Any) -> ReviewReply:
    """One entry, of this number in the file. Raises ValueError that says what of it is wrong."""
    if not isinstance(row, dict) or "id" not in row:
        raise ValueError(f"reply {number} has no id")
    if odd := row.keys() - {"id", "choice", "exceptions", "later"}:
        raise ValueError(f"reply {number} has a field {min(odd)!r}, which is none of a reply")
    choice, later, exceptions = row.get("choice"), row.get("later", False), row.get("exceptions", {})
    if choice is not None and (isinstance(choice, bool) or not isinstance(choice, int)):
        raise ValueError(f"reply {number}: the choice {choice!r} is no number from 0")
    if not isinstance(later, bool):
        raise ValueError(f"reply {number}: {later!r} for later is not true or false")
    if not isinstance(exceptions, dict):
        raise ValueError(f"reply {number}: its exceptions are no labels by ASSET#HULL")
    for place, label in exceptions.items():
        if "#" not in place or not isinstance(label, str):
            raise ValueError(f"reply {number}: the exception {place!r} is no label of an ASSET#HULL")
    places = ((place.rpartition("#"), label) for place, label in exceptions.items())
    hulls = {HullPlace(asset, hull): label for (asset, _, hull), label in places}
    return ReviewReply(str(row["id"]), choice, hulls, later=later)


def parse_reply(line: str, question: ReviewQuestion) -> ReviewReply:
    """The reply that a person typed: nothing for the first choice, a number from 1, n for none of them, l for later;
    after the number those hulls of a group that are something else, as `c=leg`; y or n where that is all there is to
    say. Raises UsageError for anything else."""
    words = line.replace(",", " ").split()
    if question.kind == "span" and words in (["y"], ["n"]):
        return ReviewReply(question.id, int(words == ["n"]))
    if words == ["l"]:
        return ReviewReply(question.id, later=True)
    choice: int | None = 0
    if words and (words[0] == "n" or words[0].isdecimal()):
        word = words.pop(0)
        choice = None if word == "n" else int(word) - 1
    letters = {letter_of(place): hull for place, hull in enumerate(question.hulls)}
    exceptions = {}
    for word in words:
        letter, equals, label = word.partition("=")
        if not equals or not label or letter not in letters:
            raise UsageError(f"{word!r} is no reply")
        exceptions[letters[letter]] = label
    if choice is not None and not 0 <= choice < len(question.choices):
        raise UsageError(f"there is no choice {choice + 1}")
    return ReviewReply(question.id, choice, exceptions)


def find_contradictions(state: ReviewState, question: ReviewQuestion, reply: ReviewReply) -> Iterator[str]:
    """A sentence for each label of a person that the reply of a person changes: the last word counts."""
    choice = None if reply.choice is None else question.choices[reply.choice]
    given = dict.fromkeys(question.hulls, choice.label) if choice and not reply.later else {}
    for place, label in {**given, **reply.exceptions}.items():
        was = state.meshes[place.asset].hull_of(place.hull).annotation
        if label and was and was.source in HUMAN_SOURCES and was.name != label:
            yield (
                f"{place.hull} of {place.asset} was called {was.name} by a person before, and is {label} now: the last "
                "word counts"
            )
