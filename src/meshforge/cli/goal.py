"""`meshforge goal`: what assets must do, tried on a family, and kept with the project."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from shutil import copyfile
from types import MappingProxyType
from typing import Annotated, Any

import typer

from meshforge.batch import GOAL_EXECUTION, AssetGoals, list_goal_cases, write_build_files
from meshforge.checks.goals.base import Goal
from meshforge.checks.goals.registry import GOALS, parse_goal
from meshforge.cli import options
from meshforge.cli.console import progress
from meshforge.cli.terminal import print_json, remark
from meshforge.common import UsageError, escape_name, pluralize
from meshforge.engines import CODES_BY_RULE
from meshforge.project import Project

NONE_ACCEPTED: Mapping[str, Collection[str]] = MappingProxyType({})
_USAGES = "; ".join(kind.usage() for kind in GOALS.built_in.values())


@dataclass(frozen=True, slots=True)
class GoalArguments:
    """What is typed after `meshforge goal`."""

    project: Annotated[Path, typer.Argument(help="A project folder.")]
    goal: Annotated[
        str | None, typer.Argument(metavar="[GOAL]", help="A goal or the name of a kept one; all kept ones without it.")
    ] = None
    add: Annotated[str | None, typer.Option("--add", metavar="NAME", help="Keep GOAL in meshforge.toml.")] = None
    remove: Annotated[str | None, typer.Option("--remove", metavar="NAME", help="Forget a kept goal.")] = None
    strict: Annotated[bool, typer.Option("--strict", help="Exit with 1 also where a goal could not be tried.")] = False
    again: Annotated[bool, typer.Option("--again", help="Try also what was tried before.")] = False
    pictures: Annotated[Path | None, typer.Option("--pictures", help="Folder for pictures of failures.")] = None
    sarif: options.SarifPath = None
    junit: options.JunitPath = None
    execution: options.ExecutionArguments = options.EXECUTION
    json: options.Json = False


@options.takes(GoalArguments)
def goal(given: GoalArguments) -> None:
    """Try what assets must do, such as to stand or to be gripped, before and after the program.

    Goals are stands, supports(E), contains(E), graspable(E), passes(E), swings(E), clear(E) and fits(E) on an extractor
    E. Lengths are metres, or have a unit: width = 80 mm. Exit code 1 when a goal fails on an asset, or could be tried
    on none.
    """
    project = Project.open(given.project)
    if given.remove is not None:
        if given.goal is not None or given.add is not None:
            raise UsageError("--remove goes alone", remedy="meshforge goal PROJECT --remove NAME")
        project.set_goal(given.remove, None)
        remark(f"{escape_name(given.remove)} is no goal any more")
        return
    if given.add is not None:
        if given.goal is None:
            raise UsageError("--add needs a goal", remedy=f"Goals: {_USAGES}")
        project.set_goal(given.add, given.goal)
    goals = _choose_goals(project, given.goal, given.add)
    if not goals:
        remedy = "meshforge goal PROJECT 'supports(Is(top))' --add NAME"
        raise UsageError("the project has no goals", where=str(given.project), remedy=remedy)
    count = len(project.assets())
    with progress(count, "trying goals") as advance:
        seconds = GOAL_EXECUTION.timeout if given.execution.timeout is None else given.execution.timeout or None
        run = replace(given.execution.to_options(), progress=advance, timeout=seconds)
        found = list(project.try_goals(goals, again=given.again, execution=run))
    if given.pictures:
        _copy_pictures(found, given.pictures)
    cases = [case for one in found for case in list_goal_cases(project.path(one.asset), one)]
    write_build_files(given.sarif, given.junit, "goal", cases)
    if given.json:
        print_json([{"asset": one.asset, "error": one.error, "goals": list_rows(one)} for one in found])
    else:
        typer.echo("\n".join(describe_goals(goals, found)))
    for one in found:
        if one.error:
            remark(one.error)
    raise typer.Exit(int(any(one.error for one in found) or have_failed(goals, found, given.strict)))


def _choose_goals(project: Project, expression: str | None, add: str | None) -> Mapping[str, Goal]:
    kept = project.read_goals()
    if expression is None:
        return kept
    if add is not None:
        return {add: kept[add]}
    if expression in kept:
        return {expression: kept[expression]}
    found = parse_goal(expression, "goal", project.words)
    return {str(found): found}


def have_failed(
    goals: Iterable[str],
    found: Sequence[AssetGoals],
    strict: bool = False,
    accepted: Mapping[str, Collection[str]] = NONE_ACCEPTED,
) -> bool:
    """Return whether a goal fails or breaks on an asset, or was tried on none; strict: or not on one; accepted: texts
    of those that do not count, by asset."""
    wrong = {"failed", "broken", *(["untried"] if strict else [])}
    for name in goals:
        results = [(one.asset, one.after[name]) for one in found if name in one.after]
        if all(result.outcome == "untried" for _, result in results) or any(
            result.outcome in wrong and result.goal not in accepted.get(asset, ()) for asset, result in results
        ):
            return True
    return False


def describe_goals(
    goals: Mapping[str, Goal], found: Sequence[AssetGoals], accepted: Mapping[str, Collection[str]] = NONE_ACCEPTED
) -> list[str]:
    """Return what came of goals, line by line; accepted: see `have_failed`."""
    return [line for name, kind in goals.items() for line in _describe_goal(name, kind, found, accepted)]


def _describe_goal(
    name: str, goal: Goal, found: Sequence[AssetGoals], accepted: Mapping[str, Collection[str]]
) -> list[str]:
    title = f"{goal}" if name == str(goal) else f"{escape_name(name)}: {goal}"
    before = [one.before[name].outcome for one in found if name in one.before]
    after = {one.asset: one for one in found if name in one.after}
    tried = [one for one in after.values() if one.after[name].outcome != "untried"]
    passed = sum(one.after[name].outcome == "passed" for one in tried)
    counts = f"{passed} of {pluralize(len(tried), 'asset')}"
    counts += f", {before.count('passed')} before" if before else ""
    untried = [one for one in after.values() if one.after[name].outcome == "untried"]
    counts += f", {len(untried)} not tried" if untried else ""
    lines = [f"{title}: {counts}"]
    for one in after.values():
        result = one.after[name]
        if result.outcome in ("failed", "broken"):
            too = ", as before" if name in one.before and one.before[name].outcome == "failed" else ""
            too += ", accepted all the same" if result.goal in accepted.get(one.asset, ()) else ""
            lines.append(f"  {result.outcome} on {escape_name(one.asset)}{too}: {result.why}")
            if name in one.pictures:
                lines.append(f"    picture: {escape_name(str(one.pictures[name]))}")
    reasons = dict[str, list[str]]()
    for one in untried:
        reasons.setdefault(one.after[name].why, []).append(one.asset)
    lines += [f"  not tried on {pluralize(len(assets), 'asset')}: {why}" for why, assets in reasons.items()]
    return lines


def list_rows(one: AssetGoals) -> list[dict[str, Any]]:
    """Return what came of goals on an asset as JSON-able data."""
    return [
        {
            "name": name,
            "goal": result.goal,
            "before": one.before[name].outcome if name in one.before else None,
            "now": result.outcome,
            "code": CODES_BY_RULE.get(f"goal-{result.outcome}"),
            "why": result.why,
            "hulls": list(result.hulls),
            "picture": str(one.pictures[name]) if name in one.pictures else None,
        }
        for name, result in one.after.items()
    ]


def _copy_pictures(found: Sequence[AssetGoals], folder: Path) -> None:
    for one in found:
        for picture in one.pictures.values():
            target = folder / f"{one.asset}.{picture.name.rsplit('.', 2)[1]}.png"
            target.parent.mkdir(parents=True, exist_ok=True)
            copyfile(picture, target)
