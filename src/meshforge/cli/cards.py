"""The cards that a person is asked with: a question between choices, and a label that may be wrong."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from meshforge.language import Program
    from meshforge.synthesis import Choice, Question, Repair


def question_card(question: Question, program: Program, pictures: Sequence[Path] = ()) -> str:
    """What a rule does as it stands, and what else it may be meant to select."""
    from meshforge.language import explain

    rule = program.rules[question.rule - 1]
    lines = [f"Rule {question.rule} can be read in more than one way.", f"  now: {rule}", f"       {explain(rule)}"]
    return "\n".join([*lines, choices_card(question, pictures)])


def choices_card(question: Question, pictures: Sequence[Path] = ()) -> str:
    """The choices alone, numbered from 1."""
    lines = [f"What should rule {question.rule} take on {question.asset}?"]
    for number, choice in enumerate(question.choices, 1):
        lines.append(f"  {number}  {_selected(choice, number, question.choices[0])}")
        lines += [f"     {pictures[number - 1]}"] if pictures else []
    return "\n".join(lines)


def _selected(choice: Choice, number: int, first: Choice) -> str:
    """The hulls of a choice; those of a later one by how they differ from the first, where that says it shorter."""
    from meshforge.words import counted, listed

    if not choice.select:
        return "nothing"
    count = counted(len(choice.select), "hull")
    more = [name for name in choice.select if name not in first.select]
    less = [name for name in first.select if name not in choice.select]
    if number == 1 or len(more) + len(less) >= len(choice.select):
        return f"{count}: {listed(choice.select)}"
    parts = [f"and {listed(more)}"] * bool(more) + [f"without {listed(less)}"] * bool(less)
    return f"{count}: those of 1, {', '.join(parts)}"


def repair_card(repair: Repair, picture: Path | None = None) -> str:
    """A label that may be wrong, and why."""
    lines = ["A label may be wrong.", f"  {change(repair)}", f"  why: {repair.why}"]
    lines += [f"  how sure: {sureness(repair)}"] if sureness(repair) else []
    return "\n".join([*lines, f"  picture: {picture}"] if picture else lines)


def change(repair: Repair) -> str:
    """`hull of asset: door -> handle`."""
    wrong = repair.correction
    return f"{wrong.hull} of {wrong.asset}: {wrong.was or 'no label'} -> {wrong.to}"


def sureness(repair: Repair) -> str | None:
    """How likely the repair is right, for people; None where that is not known, as of the paper's strategy."""
    return f"{min(round(100 * repair.belief), 99)} %" if repair.belief < 1 else None


def answer_help(question: Question, project: str) -> str:
    """How to answer where nobody can be asked; project: its folder, as one types it."""
    from json import dumps

    example = dumps([{"question": question.id, "choice": 1}], ensure_ascii=False)
    return (
        f"Answer it in a terminal: meshforge synthesize {project}\n"
        f"  or in a script: meshforge synthesize {project} --answers FILE, where FILE holds {example}\n"
        "  (null in place of 1: neither)"
    )
