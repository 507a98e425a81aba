"""What `review` says of its questions, and of how one replies to them."""

from __future__ import annotations

import json
import shlex
from collections.abc import Sequence
from pathlib import Path

from meshforge.common import join_names, pluralize
from meshforge.signoff import ResultQuestion, ReviewQuestion
from meshforge.signoff.question import NO


def format_question(question: ReviewQuestion, pictures: Sequence[Path]) -> str:
    """A question as it is asked, with its numbered choices, the hulls in question, and where its pictures lie."""
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
    """What the hull at a place is called where exceptions are typed: a, b, ..., z, aa, ab, ..."""
    return (letter_of(place // 26 - 1) if place >= 26 else "") + chr(ord("a") + place % 26)


def format_prompt(question: ReviewQuestion) -> str:
    """What can be typed."""
    count = len(question.choices)
    if not count:
        return "l later, q stop: "
    numbers = ", ".join(map(str, range(1, count + 1)))
    but = " (what is something else after it: 1 b=LABEL)" if len(question.hulls) > 1 else ""
    if isinstance(question, ResultQuestion):
        but = " (what is right after it: 2 RULE:HULL,HULL HULL=LABEL)"
    none = "" if question.choice(NO) else ", n for none"
    return f"{numbers}{but}{none}, l later, q stop; Enter: 1: "


def format_reply_help(question: ReviewQuestion, folder: str) -> str:
    """How to reply where nobody can be asked; folder: of the project, as one types it."""
    if not question.choices:
        return f"Show it: meshforge demonstrate {folder} {shlex.quote(question.asset)} 'HULLS => ACTION' ..."
    entry = json.dumps([{"id": question.id, "choice": question.choices[0].id}])
    ids = ", ".join(choice.id for choice in question.choices)
    return (
        f"Reply in a terminal: meshforge review {folder}\n"
        f"  or in a script: meshforge review {folder} --answers FILE, where FILE holds {entry}\n"
        f'  (choices: {ids}; null for none of them; "later": true puts it off)'
    )
