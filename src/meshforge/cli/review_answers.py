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
    """Replies from a file. Raises UsageError where it is not what it should be."""
    try:
        rows = json.loads(path.read_text("utf-8-sig"))
        return [_to_reply(row) for row in rows]
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError("the replies cannot be read", where=str(path)) from error
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        raise UsageError("these are no replies", where=str(path), remedy=_FORM) from error


def _to_reply(row: dict[str, Any]) -> ReviewReply:
    """One entry; a ValueError, TypeError, KeyError or AttributeError where it is none."""
    if odd := row.keys() - {"id", "choice", "exceptions", "later"}:
        raise ValueError(odd)
    exceptions = {}
    for place, label in row.get("exceptions", {}).items():
        asset, mark, hull = str(place).rpartition("#")
        if not mark or not isinstance(label, str):
            raise ValueError(place)
        exceptions[HullPlace(asset, hull)] = label
    choice, later = row.get("choice"), row.get("later", False)
    if not isinstance(later, bool) or (
        choice is not None and (isinstance(choice, bool) or not isinstance(choice, int))
    ):
        raise ValueError(choice)
    return ReviewReply(str(row["id"]), choice, exceptions, later=later)


def parse_reply(line: str, question: ReviewQuestion) -> ReviewReply:
    """The reply that a person typed: nothing for the first choice, a number from 1, n for none of them, l for later;
    after the number those hulls of a group that are something else, as `c=leg`. Raises UsageError for anything else."""
    words = line.replace(",", " ").split()
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
