"""`meshforge goal`: what assets must do, tried on a family, and kept with the project."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from shutil import copyfile
from typing import Annotated, Any

import typer

from meshforge.batch import GOAL_EXECUTION, AssetGoals
from meshforge.checks.goals.base import Goal
from meshforge.checks.goals.registry import GOALS, parse_goal
from meshforge.cli import options
from meshforge.cli.console import progress
from meshforge.cli.terminal import print_json, remark
from meshforge.common import UsageError, escape_name, pluralize
from meshforge.project import Project
from meshforge.project.goals import read_goals, set_goal, try_goals

_USAGES = "; ".join(kind.usage() for kind in GOALS.built_in.values())


def goal(
    project: Annotated[Path, typer.Argument(help="A project folder.")],
    expression: Annotated[
        str | None,
        typer.Argument(metavar="[GOAL]", help="A goal or the name of a kept one; all kept ones without it."),
    ] = None,
    add: Annotated[str | None, typer.Option("--add", metavar="NAME", help="Keep GOAL in meshforge.toml.")] = None,
    remove: Annotated[str | None, typer.Option("--remove", metavar="NAME", help="Forget a kept goal.")] = None,
    strict: Annotated[bool, typer.Option("--strict", help="Exit with 1 also where a goal could not be tried.")] = False,
    again: Annotated[bool, typer.Option("--again", help="Try also what was tried before.")] = False,
    pictures: Annotated[Path | None, typer.Option("--pictures", help="Folder for pictures of failures.")] = None,
    execution: options.ExecutionArguments = options.EXECUTION,
    json: options.Json = False,
) -> None:
    """Try what assets must do, such as 'supports(Is(top))', on all of a project, before and after its program.

    Goals are stands, supports(E), contains(E), graspable(E), passes(E), swings(E), clear(E) and fits(E) on an extractor
    E. Lengths are metres, or have a unit: width = 80 mm. Exit code 1 when a goal fails on an asset, or could be tried
    on none.
    """
    opened = Project.open(project)
    if remove is not None:
        if expression is not None or add is not None:
            raise UsageError("--remove goes alone", remedy="meshforge goal PROJECT --remove NAME")
        set_goal(opened, remove, None)
        remark(f"{escape_name(remove)} is no goal any more")
        return
    if add is not None:
        if expression is None:
            raise UsageError("--add needs a goal", remedy=f"Goals: {_USAGES}")
        set_goal(opened, add, expression)
    goals = _choose_goals(opened, expression, add)
    if not goals:
        remedy = "meshforge goal PROJECT 'supports(Is(top))' --add NAME"
        raise UsageError("the project has no goals", where=str(project), remedy=remedy)
    count = len(opened.assets())
    with progress(count, "trying goals") as advance:
        seconds = GOAL_EXECUTION.timeout if execution.timeout is None else execution.timeout or None
        run = replace(execution.to_options(), progress=advance, timeout=seconds)
        found = list(try_goals(opened, goals, again=again, execution=run))
    if pictures:
        _copy_pictures(found, pictures)
    if json:
        print_json({"goals": [_to_json(name, one, found) for name, one in goals.items()]})
    else:
        for name, kind in goals.items():
            typer.echo("\n".join(_describe_goal(name, kind, found)))
    for one in found:
        if one.error:
            remark(one.error)
    raise typer.Exit(int(any(one.error for one in found) or any(_has_failed(name, found, strict) for name in goals)))


def _choose_goals(project: Project, expression: str | None, add: str | None) -> Mapping[str, Goal]:
    kept = read_goals(project)
    if expression is None:
        return kept
    if add is not None:
        return {add: kept[add]}
    if expression in kept:
        return {expression: kept[expression]}
    return {expression: parse_goal(expression, "goal", project.words)}


def _has_failed(name: str, found: list[AssetGoals], strict: bool) -> bool:
    outcomes = [one.after[name].outcome for one in found if name in one.after]
    is_tried = any(outcome != "untried" for outcome in outcomes)
    return not is_tried or any(
        outcome in ("failed", "broken") or (strict and outcome == "untried") for outcome in outcomes
    )


def _describe_goal(name: str, goal: Goal, found: list[AssetGoals]) -> list[str]:
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
            lines.append(f"  {result.outcome} on {escape_name(one.asset)}{too}: {result.why}")
            if name in one.pictures:
                lines.append(f"    picture: {escape_name(str(one.pictures[name]))}")
    reasons = dict[str, list[str]]()
    for one in untried:
        reasons.setdefault(one.after[name].why, []).append(one.asset)
    lines += [f"  not tried on {pluralize(len(assets), 'asset')}: {why}" for why, assets in reasons.items()]
    return lines


def _to_json(name: str, goal: Goal, found: list[AssetGoals]) -> dict[str, Any]:
    return {
        "name": name,
        "goal": str(goal),
        "assets": [
            {
                "asset": one.asset,
                "before": one.before[name].outcome if name in one.before else None,
                "now": one.after[name].outcome if name in one.after else None,
                "why": one.after[name].why if name in one.after else one.error,
                "hulls": list(one.after[name].hulls) if name in one.after else [],
                "picture": str(one.pictures[name]) if name in one.pictures else None,
            }
            for one in found
        ],
    }


def _copy_pictures(found: list[AssetGoals], folder: Path) -> None:
    for one in found:
        for picture in one.pictures.values():
            target = folder / f"{one.asset}.{picture.name.rsplit('.', 2)[1]}.png"
            target.parent.mkdir(parents=True, exist_ok=True)
            copyfile(picture, target)
