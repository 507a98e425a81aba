"""The goals of a project, kept in meshforge.toml, and what comes of them on its assets."""

from collections.abc import Collection, Iterator, Mapping
from contextlib import suppress

from meshforge import batch
from meshforge.checks.goals.base import Goal
from meshforge.checks.goals.registry import parse_goal
from meshforge.common import ProgramError, ProjectError, suggest_name
from meshforge.language import Program
from meshforge.project.run import build_jobs, build_task
from meshforge.store import Store, change_goal


def read_goals(store: Store) -> dict[str, Goal]:
    """Return the goals of a project by name. Raises ProjectError for one that does not parse."""
    words, found = store.words, dict[str, Goal]()
    for name, text in store.settings.goals.items():
        try:
            found[name] = parse_goal(text, f"{store.layout.settings}, [goals] {name}", words)
        except ProgramError as error:
            raise ProjectError(error.problem, where=error.where, remedy=error.remedy) from None
    return found


def rename_in_goals(goals: Mapping[str, str], old: str, new: str) -> dict[str, str]:
    """Return the texts of goals with a label by another name; those that do not have it, or do not parse, stay."""
    found = dict(goals)
    for name, text in goals.items():
        with suppress(ProgramError):
            goal = parse_goal(text)
            found[name] = text if goal.rename(old, new) == goal else str(goal.rename(old, new))
    return found


def set_goal(store: Store, name: str, text: str | None) -> None:
    """Keep a goal under a name, or forget it by None. Raises ProgramError for a text that does not parse, ProjectError
    for a name that there is not."""
    if text is not None:
        parse_goal(text, name, store.words)
    elif name not in store.settings.goals:
        remedy = suggest_name(name, store.settings.goals) or "There are no goals."
        raise ProjectError(f"there is no goal {name!r}", where=str(store.folder), remedy=remedy)
    with store.lock():
        change_goal(store.folder, name, text)


def try_goals(
    store: Store,
    goals: Mapping[str, Goal | str] | None = None,
    *,
    again: bool = False,
    only: Collection[str] | None = None,
    execution: batch.ExecutionOptions = batch.GOAL_EXECUTION,
) -> Iterator[batch.AssetGoals]:
    """Yield what comes of goals on every asset that is not excluded, or on some, before and after the program.

    goals: or their texts, by name, by default those of the project; again: also where that is known. Without a program
    they are tried on the assets as they are. Raises ProjectError as `read_goals`, ProgramError for a text that does not
    parse.
    """
    chosen = read_goals(store) if goals is None else goals
    texts = {
        name: str(parse_goal(one, name, store.words) if isinstance(one, str) else one) for name, one in chosen.items()
    }
    program = store.program() or Program(orient=store.orientation)
    away = store.exclusions().keys() - set(only or ())
    jobs = [job for job in build_jobs(store, only) if job.id not in away]
    task = batch.GoalTask(build_task(store, program), texts, again)
    yield from batch.try_goals(jobs, task, execution)
