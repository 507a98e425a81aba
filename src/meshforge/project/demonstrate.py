"""Demonstrating: the steps on an asset checked and written, and rules moved or taken out of all demonstrations."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from meshforge.common import ProjectError, UsageError, nearest_name
from meshforge.store import (
    AnswersFile,
    DemonstrationFile,
    StepLine,
    Store,
    read_json,
    write_json,
)
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, Step


def demonstrate(store: Store, asset: str, steps: tuple[Step, ...]) -> None:
    """Keep the steps on an asset; no steps take the file away.

    Raises DemonstrationError for steps that are not numbered in order, ProjectError for a hull that cannot be there.
    """
    mesh = store.mesh(asset)
    _check_hulls(asset, mesh, Demonstration(mesh, steps, asset).steps)
    store.write_steps(asset, steps)


def _check_hulls(asset: str, mesh: SymbolicMesh, steps: tuple[Step, ...]) -> None:
    """Every name is a hull of the mesh, or, after the first step, one that an edit of such a hull can have made."""
    for rule, name in find_unknown_hulls(steps, mesh.index):
        like = nearest_name(name, mesh.index)
        raise ProjectError(
            f"rule {rule}: there is no hull {name!r}", where=asset, remedy=f"Did you mean {like!r}?" if like else None
        )


def find_unknown_hulls(steps: Iterable[Step], hulls: Container[str]) -> Iterator[tuple[int, str]]:
    """The rules and names of steps that cannot be meant: no such hull, and none that an edit could have made it of."""
    for step in steps:
        for name in sorted(step.select or ()):
            stem = name.rpartition("~")[0] if step.rule > 1 else name
            if name not in hulls and stem not in hulls:
                yield step.rule, name


def move_rule(store: Store, rule: int, to: int) -> None:
    """Put a rule at another place; a demonstration that says nothing about a rule in between leaves it open."""
    with store.lock():
        kept = _read_demonstration_files(store)
        order = _rule_numbers(kept, rule, to)
        order.insert(to - 1, order.pop(rule - 1))
        _write_reordered(store, kept, order)


def delete_rule(store: Store, rule: int) -> None:
    """Take a rule away; a demonstration without any step goes away with it."""
    with store.lock():
        kept = _read_demonstration_files(store)
        order = _rule_numbers(kept, rule)
        order.remove(rule)
        _write_reordered(store, kept, order)


def _read_demonstration_files(store: Store) -> dict[Path, DemonstrationFile]:
    """All demonstrations by file. Raises ProjectError where one cannot be read, or its steps are not in order."""
    layout = store.layout
    paths = map(layout.demonstration, layout.ids_with("demonstrations"))
    found = {path: read_json(path, DemonstrationFile) for path in paths}
    kept = {path: file for path, file in found.items() if file}
    for path, file in kept.items():
        if [line.rule for line in file.steps] != list(range(1, len(file.steps) + 1)):
            remedy = "Number them 1, 2, 3 and so on by hand, in the order in which they were done."
            raise ProjectError("its steps are not numbered in order", where=str(path), remedy=remedy)
    return kept


def _rule_numbers(kept: Mapping[Path, DemonstrationFile], *asked: int) -> list[int]:
    """The numbers of all rules. Raises UsageError where one that is asked for is not among them."""
    most = max((len(file.steps) for file in kept.values()), default=0)
    for rule in asked:
        if not 1 <= rule <= most:
            shown = f"rules 1 to {most} are demonstrated" if most else "nothing is demonstrated"
            raise UsageError(f"there is no rule {rule}: {shown}")
    return list(range(1, most + 1))


def _write_reordered(store: Store, kept: Mapping[Path, DemonstrationFile], order: Sequence[int]) -> None:
    """Write demonstrations and answers with the rules in another order, each file for itself.

    order: the old number of the rule that is first from now on, of the second, and so on.
    """
    answers = store.answers()
    actions = _actions_by_rule(kept)
    for path, file in kept.items():
        steps = _reorder(file.steps, order, actions)
        if not steps:
            path.unlink(missing_ok=True)
        elif steps != file.steps:
            write_json(path, file.model_copy(update={"steps": steps}))
    now = _renumber(answers, order, len(actions))
    if now != answers:
        store.write_answers(now)


def _actions_by_rule(kept: Mapping[Path, DemonstrationFile]) -> dict[int, str]:
    """What each rule does, as the first demonstration that shows it says, or that at least mentions it."""
    lines = [line for file in [*kept.values()][::-1] for line in file.steps]
    return {line.rule: line.action for line in sorted(lines, key=lambda line: bool(line.select))}


def _reorder(lines: Sequence[StepLine], order: Sequence[int], actions: Mapping[int, str]) -> tuple[StepLine, ...]:
    """The steps in another order; those that are missing before the last one are open."""
    own = {line.rule: line for line in lines}
    last = max((place for place, rule in enumerate(order, 1) if rule in own), default=0)
    open_steps = {rule: StepLine(rule=rule, select=None, action=action) for rule, action in actions.items()}
    steps = [(open_steps | own)[rule] for rule in order[:last]]
    return tuple(step.model_copy(update={"rule": place}) for place, step in enumerate(steps, 1))


def _renumber(answers: AnswersFile, order: Sequence[int], before: int) -> AnswersFile:
    """The answers about other numbers; before: how many rules there were. Answers about rules beyond stay."""
    places = {rule: place for place, rule in enumerate(order, 1)}
    now = answers.model_copy(update={"answers": ()})
    for line in answers.answers:
        rule = places.get(line.rule, line.rule if line.rule > before else 0)
        if rule:
            now = now.with_line(line.model_copy(update={"rule": rule, "id": f"{rule}:{line.asset}"}))
    return now
