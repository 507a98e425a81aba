"""Rules are numbered alike in all demonstrations: putting one at another place, or taking it away."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.errors import ProjectError, UsageError
from meshforge.project.answering import answers, write_answers
from meshforge.project.answers_file import AnswersFile
from meshforge.project.json_files import read_json, write_json
from meshforge.project.steps import DemonstrationFile, StepLine

if TYPE_CHECKING:
    from meshforge.project.project import Project


def move(project: Project, rule: int, to: int) -> None:
    """Put a rule at another place; a demonstration that says nothing about a rule in between leaves it open."""
    with project.lock():
        kept = _demonstrations(project)
        order = _rules(kept, rule, to)
        order.insert(to - 1, order.pop(rule - 1))
        _write(project, kept, order)


def delete(project: Project, rule: int) -> None:
    """Take a rule away; a demonstration without any step goes away with it."""
    with project.lock():
        kept = _demonstrations(project)
        order = _rules(kept, rule)
        order.remove(rule)
        _write(project, kept, order)


def _demonstrations(project: Project) -> dict[Path, DemonstrationFile]:
    """All demonstrations by file. Raises ProjectError where one cannot be read, or its steps are not in order."""
    layout = project.layout
    found = {path: read_json(path, DemonstrationFile) for path in map(layout.demonstration, _ids(project))}
    kept = {path: file for path, file in found.items() if file}
    for path, file in kept.items():
        if [line.rule for line in file.steps] != list(range(1, len(file.steps) + 1)):
            remedy = "Number them 1, 2, 3 and so on by hand, in the order in which they were done."
            raise ProjectError("its steps are not numbered in order", where=str(path), remedy=remedy)
    return kept


def _ids(project: Project) -> tuple[str, ...]:
    return project.layout.ids_with("demonstrations")


def _rules(kept: Mapping[Path, DemonstrationFile], *asked: int) -> list[int]:
    """The numbers of all rules. Raises UsageError where one that is asked for is not among them."""
    most = max((len(file.steps) for file in kept.values()), default=0)
    for rule in asked:
        if not 1 <= rule <= most:
            shown = f"rules 1 to {most} are demonstrated" if most else "nothing is demonstrated"
            raise UsageError(f"there is no rule {rule}: {shown}")
    return list(range(1, most + 1))


def _write(project: Project, kept: Mapping[Path, DemonstrationFile], order: Sequence[int]) -> None:
    """Write demonstrations and answers with the rules in another order, each file for itself.

    order: the old number of the rule that is first from now on, of the second, and so on.
    """
    said = answers(project)
    actions = _actions(kept)
    for path, file in kept.items():
        steps = _reordered(file.steps, order, actions)
        if not steps:
            path.unlink(missing_ok=True)
        elif steps != file.steps:
            write_json(path, file.model_copy(update={"steps": steps}))
    now = _renumbered(said, order, len(actions))
    if now != said:
        write_answers(project, now)


def _actions(kept: Mapping[Path, DemonstrationFile]) -> dict[int, str]:
    """What each rule does, as the first demonstration that shows it says, or that at least mentions it."""
    lines = [line for file in [*kept.values()][::-1] for line in file.steps]
    return {line.rule: line.action for line in sorted(lines, key=lambda line: bool(line.select))}


def _reordered(lines: Sequence[StepLine], order: Sequence[int], actions: Mapping[int, str]) -> tuple[StepLine, ...]:
    """The steps in another order; those that are missing before the last one are open."""
    own = {line.rule: line for line in lines}
    last = max((place for place, rule in enumerate(order, 1) if rule in own), default=0)
    open_steps = {rule: StepLine(rule=rule, select=None, action=action) for rule, action in actions.items()}
    steps = [(open_steps | own)[rule] for rule in order[:last]]
    return tuple(step.model_copy(update={"rule": place}) for place, step in enumerate(steps, 1))


def _renumbered(said: AnswersFile, order: Sequence[int], before: int) -> AnswersFile:
    """The answers about other numbers; before: how many rules there were. Answers about rules beyond stay."""
    places = {rule: place for place, rule in enumerate(order, 1)}
    now = said.model_copy(update={"answers": ()})
    for line in said.answers:
        rule = places.get(line.rule, line.rule if line.rule > before else 0)
        if rule:
            now = now.with_line(line.model_copy(update={"rule": rule, "id": f"{rule}:{line.asset}"}))
    return now
