"""The goals of a project, kept in meshforge.toml, and what comes of them on its assets."""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace

from meshforge import batch
from meshforge.checks.goals.base import Goal
from meshforge.checks.goals.registry import parse_goal
from meshforge.common import ProgramError, ProjectError, suggest_name
from meshforge.geometry import digest
from meshforge.language import Program, Replay
from meshforge.project.run import build_jobs, build_task, output_digest
from meshforge.signoff import GoalStatus
from meshforge.store import Store, change_goal
from meshforge.symbolic import SymbolicMesh


def read_goals(store: Store) -> dict[str, Goal]:
    """Return the goals of a project by name. Raises ProjectError for one that does not parse."""
    words, found = store.words, dict[str, Goal]()
    for name, text in store.settings.goals.items():
        try:
            found[name] = parse_goal(text, f"{store.layout.settings}, [goals] {name}", words)
        except ProgramError as error:
            raise ProjectError(error.problem, where=error.where, remedy=error.remedy) from None
    return found


def read_goal_statuses(
    store: Store, program: Program | None, edits: Mapping[str, batch.OutputInputs]
) -> dict[str, tuple[GoalStatus, ...]]:
    """Return what is known of the goals of a project on the edits of assets, by asset, without trying any; empty where
    it has no goals. Raises ProjectError as `read_goals`."""
    goals = read_goals(store)
    if not goals or program is None:
        return {}
    accepted = read_accepted_goals(store)
    return {
        one.asset: tuple(_describe_status(name, goal, one, accepted.get(one.asset, ())) for name, goal in goals.items())
        for one in batch.recall_goals(goals, build_task(store, program), edits)
    }


def read_accepted_goals(store: Store) -> dict[str, tuple[str, ...]]:
    """Return the texts of goals that a person accepted to fail on results as they are now, by asset."""
    last = (one[-1] for one in store.feedback().verdicts.values())
    return {
        one.asset: one.goals
        for one in last
        if one.goals and one.output == output_digest(batch.read_stamp(store.layout.edited, one.asset))
    }


def _describe_status(name: str, goal: Goal, known: batch.AssetGoals, accepted: Collection[str]) -> GoalStatus:
    after, before, text = known.after.get(name), known.before.get(name), str(goal)
    if after is None:
        return GoalStatus(name, text)
    fails = after.outcome in ("failed", "broken")
    was = before.outcome if before else None
    is_accepted, picture = fails and text in accepted, known.pictures.get(name) if fails else None
    return GoalStatus(name, text, after.outcome, after.why, after.hulls, was, is_accepted, picture)


def rename_in_goal(text: str, old: str, new: str) -> str:
    """Return the text of a goal with a label by another name; one that does not have it, or does not parse, stays."""
    try:
        goal = parse_goal(text)
    except ProgramError:
        return text
    renamed = goal.rename(old, new)
    return text if renamed == goal else str(renamed)


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
    away = store.exclusions().keys() - set(only or ())
    jobs = [job for job in build_jobs(store, only) if job.id not in away]
    task = batch.GoalTask(build_task(store, store.program() or _make_frame(store)), texts, again)
    yield from batch.try_goals(jobs, task, execution)


def try_goals_as_shown(
    store: Store, meshes: Mapping[str, SymbolicMesh], execution: batch.ExecutionOptions = batch.GOAL_EXECUTION
) -> Iterator[batch.AssetGoals]:
    """Yield what comes of the goals of a project on demonstrated assets, as the steps that were shown leave them.
    meshes: by asset. Raises ProjectError as `read_goals`."""
    goals, frame = read_goals(store), _make_frame(store)
    if goals:
        shown = [asset for asset in store.demonstration_ids() if asset in meshes]
        edits = {asset: tuple(_list_steps(store, meshes[asset], asset, frame)) for asset in shown}
        jobs = [replace(job, manual_edits=edits[job.id], selections=()) for job in build_jobs(store, shown)]
        texts = {name: str(goal) for name, goal in goals.items()}
        yield from batch.try_goals(jobs, batch.GoalTask(build_task(store, frame), texts), execution)


def _make_frame(store: Store) -> Program:
    limits = store.settings.thresholds
    return Program((), store.orientation, (), limits.contact, limits.extremity)


def _list_steps(store: Store, mesh: SymbolicMesh, asset: str, frame: Program) -> Iterator[batch.ManualEdit]:
    """The steps that were shown on an asset, as edits by hand."""
    replay, steps = Replay.begin(mesh, frame.orient, frame.contact), store.steps(asset)
    templates = store.templates(dict.fromkeys(name for step in steps for name in step.action.templates))
    for step in steps:
        if step.select:
            hulls = {name: (mesh if name in mesh.index else replay.mesh).hull_of(name) for name in sorted(step.select)}
            known = tuple((name, digest(hull.shape)) for name, hull in hulls.items())
            yield batch.ManualEdit(known, step.action, step.label)
            replay = replay.apply(replay.mask_of(step.select), step.action, step.label, templates)
