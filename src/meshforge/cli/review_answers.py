"""Questions of a review and replies to them, as text: what is asked, how one replies, replies from a file and from the
line that a person types."""

import json
import shlex
from codecs import BOM_UTF8
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, PlainValidator, TypeAdapter, ValidationError

from meshforge.common import UsageError, first_validation_error, join_names, pluralize
from meshforge.signoff import Assessment, HullPlace, ReviewQuestion, ReviewReply
from meshforge.signoff.question import NO


def format_question(question: ReviewQuestion, pictures: Sequence[Path]) -> str:
    """Return a question as it is asked, with numbered choices, the hulls in question, and where its pictures lie."""
    lines = [f"{question.text}  [{question.id}, about {question.seconds:.0f} s]"]
    each = len(pictures) == len(question.choices) > 1
    for number, choice in enumerate(question.choices, 1):
        selected = "" if choice.select is None else f": {pluralize(len(choice.select), 'hull')}"
        selected += f", {join_names(choice.select)}" if choice.select else ""
        lines += [f"  {number} {choice.text}{selected}", *([f"    picture: {pictures[number - 1]}"] if each else [])]
    if len(question.hulls) > 1:
        lines.append("  hulls:")
        lines += [f"    {letter_of(k)} {hull.hull} of {hull.asset}" for k, hull in enumerate(question.hulls)]
    lines += [] if each else [f"  picture: {path}" for path in pictures]
    return "\n".join(lines)


def letter_of(place: int) -> str:
    """Return what the hull at a place is called where exceptions are typed: a, b, ..., z, aa, ab, ..."""
    return (letter_of(place // 26 - 1) if place >= 26 else "") + chr(ord("a") + place % 26)


def format_prompt(question: ReviewQuestion) -> str:
    """Return what can be typed."""
    count = len(question.choices)
    if not count:
        return "l later, q stop: "
    numbers = ", ".join(map(str, range(1, count + 1)))
    but = " (what is something else after it: 1 b=LABEL)" if len(question.hulls) > 1 else ""
    if question.kind == "result":
        but = " (what is right after it: 2 RULE:HULL,HULL HULL=LABEL)"
    none = "" if question.choice(NO) else ", n for none"
    return f"{numbers}{but}{none}, l later, q stop; Enter: 1: "


def format_reply_help(question: ReviewQuestion, folder: str) -> str:
    """Return how to reply where nobody can be asked; folder: of the project, as one types it."""
    if not question.choices:
        return f"Show it: meshforge demonstrate {folder} {shlex.quote(question.asset)} 'HULLS => ACTION' ..."
    entry = json.dumps([{"id": question.id, "choice": question.choices[0].id}])
    ids = ", ".join(choice.id for choice in question.choices)
    return (
        f"Reply in a terminal: meshforge review {folder}\n"
        f"  or in a script: meshforge review {folder} --answers FILE, where FILE holds {entry}\n"
        f'  (choices: {ids}; null for none of them; "later": true snoozes it)'
    )


_FORM = (
    'Expected a list of {"id", "choice": the id of a choice, or null for none of them, "exceptions": '
    '{"ASSET#HULL": LABEL}, "selections": {"RULE": ["HULL", ...]}, "labels": {"HULL": LABEL}, "later": true}.'
)


def _check_choice(choice: Any) -> Any:
    if isinstance(choice, bool) or not isinstance(choice, str | int | None):
        raise ValueError("expected the id of a choice, a number from 0, or null")
    return choice


class ScriptReply(BaseModel):
    """A reply of a file. choice: an id, or a number from 0; exceptions: labels by `ASSET#HULL`; selections: names of
    hulls by the numbers of rules; labels: by hull."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)

    id: str
    choice: Annotated[str | int | None, PlainValidator(_check_choice)] = None
    exceptions: dict[Annotated[str, Field(pattern="#")], str] = {}
    selections: dict[Annotated[str, Field(pattern="^[0-9]+$")], frozenset[str]] = {}
    labels: dict[str, str] = {}
    later: bool = False

    def find(self, found: Assessment) -> ReviewQuestion | None:
        """Return the question that it replies to, if it is asked now."""
        return next((one for one in found.questions if one.id == self.id), None)

    def to_reply(self, question: ReviewQuestion) -> ReviewReply:
        """Return the reply. Raises UsageError for a choice that there is not."""
        choice = self.choice
        if isinstance(choice, int):
            if not 0 <= choice < len(question.choices):
                problem = f"there is no choice {choice}: question {question.id} has {len(question.choices)} choices"
                raise UsageError(problem, remedy="Name one by its id, or count them from 0.")
            choice = question.choices[choice].id
        places = ((place.rpartition("#"), label) for place, label in self.exceptions.items())
        exceptions = {HullPlace(asset, hull): label for (asset, _, hull), label in places}
        selections = {int(rule): hulls for rule, hulls in self.selections.items()}
        return ReviewReply(self.id, choice, exceptions, selections, self.labels, later=self.later)


_REPLIES = TypeAdapter(tuple[ScriptReply, ...])


def read_replies(path: Path) -> tuple[ScriptReply, ...]:
    """Return replies from a file. Raises UsageError, naming the entry, from 0, and the field, where one is wrong."""
    try:
        return _REPLIES.validate_json(path.read_bytes().removeprefix(BOM_UTF8))
    except OSError as error:
        raise UsageError(f"the replies cannot be read: {error.strerror}", where=str(path)) from error
    except ValidationError as error:
        raise UsageError(first_validation_error(error), where=str(path), remedy=_FORM) from error


def parse_reply(line: str, question: ReviewQuestion) -> ReviewReply:
    """Return the reply that a person typed: nothing for the first choice, the number of one from 1 or its id, n for
    none of them, l for later; after it, for a group, those hulls that are something else, as `c=leg`; for a result that
    is wrong, `RULE:HULL,HULL` for what a rule should select, and `HULL=LABEL`. Raises UsageError for anything else."""
    words = line.split()
    if words == ["l"] or not question.choices:
        return ReviewReply(question.id, later=True)
    chosen = (
        _parse_choice(words.pop(0), question) if words and not set(words[0]) & set("=:") else question.choices[0].id
    )
    if question.kind == "result":
        return _parse_manual_edit(words, question, chosen)
    letters = {letter_of(place): hull for place, hull in enumerate(question.hulls)}
    exceptions = {}
    for word in " ".join(words).replace(",", " ").split():
        letter, equals, label = word.partition("=")
        if not equals or not label or letter not in letters:
            raise UsageError(f"{word!r} is no reply")
        exceptions[letters[letter]] = label
    return ReviewReply(question.id, chosen, exceptions)


def _parse_choice(word: str, question: ReviewQuestion) -> str | None:
    ids = [choice.id for choice in question.choices]
    if word in ids:
        return word
    starts = [name for name in ids if name.startswith(word)]
    if len(starts) == 1 and word in "yn":
        return starts[0]
    if word == "n":
        return None
    if word.isdecimal() and not 0 < int(word) <= len(ids):
        raise UsageError(f"there is no choice {word}")
    if not word.isdecimal():
        raise UsageError(f"{word!r} is no reply")
    return ids[int(word) - 1]


def _parse_manual_edit(words: Sequence[str], question: ReviewQuestion, chosen: str | None) -> ReviewReply:
    selections, labels = dict[int, frozenset[str]](), dict[str, str]()
    for word in words:
        rule, colon, names = word.partition(":")
        hull, equals, label = word.rpartition("=")
        if colon and rule.isdecimal():
            selections[int(rule)] = frozenset(name for name in names.split(",") if name)
        elif equals and hull and label:
            labels[hull] = label
        else:
            raise UsageError(f"{word!r} is no RULE:HULL,HULL and no HULL=LABEL")
    return ReviewReply(question.id, chosen, selections=selections, labels=labels)
