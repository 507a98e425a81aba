"""Questions of a review and replies to them, as text: what is asked, how one replies, replies from a file and from the
line that a person types, and what they contradict."""

import json
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from meshforge.common import UsageError, join_names, pluralize
from meshforge.signoff import Assessment, HullPlace, ReviewQuestion, ReviewReply, ReviewState
from meshforge.signoff.question import NO
from meshforge.symbolic import HUMAN_SOURCES


def format_question(question: ReviewQuestion, pictures: Sequence[Path]) -> str:
    """Return a question as it is asked, with its numbered choices, the hulls in question, and where its pictures
    lie."""
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


@dataclass(frozen=True, slots=True)
class ScriptReply:
    """A reply of a file. number: its place there, from 1; choice: an id, or a number from 0."""

    number: int
    question: str
    choice: str | int | None = None
    exceptions: Mapping[HullPlace, str] = field(default_factory=dict)
    selections: Mapping[int, frozenset[str]] = field(default_factory=dict)
    labels: Mapping[str, str] = field(default_factory=dict)
    later: bool = False
    by: str | None = None

    def find(self, found: Assessment) -> ReviewQuestion | None:
        """Return the question that it replies to, if it is asked now."""
        return next((one for one in found.questions if one.id == self.question), None)

    def to_reply(self, question: ReviewQuestion) -> ReviewReply:
        """Return the reply. Raises UsageError for a choice that there is not."""
        choice = self.choice
        if isinstance(choice, int):
            if not 0 <= choice < len(question.choices):
                problem = f"reply {self.number}: question {question.id} has {len(question.choices)} choices"
                raise UsageError(problem, remedy="Name one by its id, or count them from 0.")
            choice = question.choices[choice].id
        return ReviewReply(
            self.question, choice, self.exceptions, self.selections, self.labels, later=self.later, by=self.by
        )


def read_replies(path: Path) -> list[ScriptReply]:
    """Return replies from a file. Raises UsageError, naming the entry and the field, where it is not what it should
    be."""
    try:
        rows = json.loads(path.read_text("utf-8-sig"))
    except (OSError, UnicodeDecodeError) as error:
        why = "they are not UTF-8 text" if isinstance(error, UnicodeDecodeError) else error.strerror
        raise UsageError(f"the replies cannot be read: {why}", where=str(path)) from error
    except (ValueError, RecursionError) as error:
        raise UsageError("this is no JSON", where=str(path), remedy=_FORM) from error
    if not isinstance(rows, list):
        raise UsageError("this is no list of replies", where=str(path), remedy=_FORM)
    try:
        return [_to_reply(number, row) for number, row in enumerate(rows, 1)]
    except ValueError as error:
        raise UsageError(str(error), where=str(path), remedy=_FORM) from error


def _to_reply(number: int, row: Any) -> ScriptReply:
    """One entry, of this number in the file. Raises ValueError that says what of it is wrong."""
    if not isinstance(row, dict) or "id" not in row:
        raise ValueError(f"reply {number} has no id")
    if unknown := row.keys() - {"id", "choice", "exceptions", "selections", "labels", "later"}:
        raise ValueError(f"reply {number} has a field {min(unknown)!r}, which is none of a reply")
    choice, later = row.get("choice"), row.get("later", False)
    if choice is not None and (isinstance(choice, bool) or not isinstance(choice, int | str)):
        raise ValueError(f"reply {number}: the choice {choice!r} is no id, and no number from 0")
    if not isinstance(later, bool):
        raise ValueError(f"reply {number}: {later!r} for later is not true or false")
    exceptions, selections, labels = (row.get(name, {}) for name in ("exceptions", "selections", "labels"))
    if not isinstance(exceptions, dict):
        raise ValueError(f"reply {number}: its exceptions are no labels by ASSET#HULL")
    for place, label in exceptions.items():
        if "#" not in place or not isinstance(label, str):
            raise ValueError(f"reply {number}: the exception {place!r} is no label of an ASSET#HULL")
    if not isinstance(selections, dict) or not all(map(_is_selection, selections.items())):
        raise ValueError(f"reply {number}: its selections are no lists of hulls by the numbers of rules")
    if not isinstance(labels, dict) or not all(isinstance(label, str) for label in labels.values()):
        raise ValueError(f"reply {number}: its labels are no labels by hull")
    places = ((place.rpartition("#"), label) for place, label in exceptions.items())
    hulls = {HullPlace(asset, hull): label for (asset, _, hull), label in places}
    chosen = {int(rule): frozenset(names) for rule, names in selections.items()}
    return ScriptReply(number, str(row["id"]), choice, hulls, chosen, labels, later)


def _is_selection(row: tuple[str, Any]) -> bool:
    rule, hulls = row
    return rule.isdecimal() and isinstance(hulls, list) and all(isinstance(name, str) for name in hulls)


def parse_reply(line: str, question: ReviewQuestion) -> ReviewReply:
    """Return the reply that a person typed: nothing for the first choice, the number of one from 1 or its id, n for
    none of them, l for later; after it, for a group, those hulls that are something else, as `c=leg`; for a result that
    is wrong, `RULE:HULL,HULL` for what a rule should have selected, and `HULL=LABEL`. Raises UsageError for anything
    else."""
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


def find_contradictions(state: ReviewState, question: ReviewQuestion, reply: ReviewReply) -> Iterator[str]:
    """Yield a sentence for each label of a person that the reply of a person changes: the last word counts."""
    choice = question.choice(reply.choice)
    given = dict.fromkeys(question.hulls, choice.label) if choice and not reply.later else {}
    given_before = {HullPlace(question.asset, hull): label for hull, label in reply.labels.items()}
    for place, label in {**given, **reply.exceptions, **given_before}.items():
        was = state.meshes[place.asset].hull_of(place.hull).annotation
        if label and was and was.source in HUMAN_SOURCES and was.name != label:
            yield (
                f"{place.hull} of {place.asset} was called {was.name} by a person before, and is {label} now: the last "
                "word counts"
            )
