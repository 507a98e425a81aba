"""Goals tried on many assets, before and after their edit, in worker processes; what came of it is kept beside the
outputs, by the digest of all that decides it, so that nothing is tried twice."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path

from pydantic import BaseModel, ValidationError

from meshforge import formats
from meshforge.batch import provenance
from meshforge.batch.discovery import STATE
from meshforge.batch.execution import execute
from meshforge.batch.jobs import ApplyTask, AssetJob, inputs_of
from meshforge.batch.manual_edits import replay_manual_edits, selections_of
from meshforge.batch.preparation.storage import prepare_from_folder
from meshforge.batch.workers import ExecutionOptions, WorkerFailure
from meshforge.checks.goals.base import Goal, GoalOutcome, GoalResult, GoalSubject, try_goal
from meshforge.checks.goals.registry import parse_goal
from meshforge.common import describe_error, write_atomically
from meshforge.geometry import Shape
from meshforge.language import Program
from meshforge.rendering import draw_volumes, render, write_png
from meshforge.symbolic import Asset, Surface, SymbolicMesh, transfer_labels

GOAL_EXECUTION = ExecutionOptions(timeout=60.0)
"""Seconds for all goals of one asset, by default."""
_FORM = 3  # counts the changes of what goals try
_MOST_KEPT = 16  # results of earlier states of an asset
_PICTURE = (640, 480)
_COLORS = {"at fault": "#D64545", "tried": "#E0A030"}


@dataclass(frozen=True, eq=False, slots=True)
class GoalTask:
    """What is tried on every asset. edit: what `apply` does, and where its outputs are; goals: texts by name; again:
    whether also what was tried before."""

    edit: ApplyTask
    goals: Mapping[str, str]
    again: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class AssetGoals:
    """What came of goals on one asset, by their names. before: on the asset as it was, where an edit changes it;
    pictures: of failures after it; error: the whole message where the asset cannot be read, or not be edited."""

    asset: str
    before: Mapping[str, GoalResult] = field(default_factory=dict)
    after: Mapping[str, GoalResult] = field(default_factory=dict)
    pictures: Mapping[str, Path] = field(default_factory=dict)
    error: str | None = None


def try_goals(jobs: Sequence[AssetJob], task: GoalTask, execution: ExecutionOptions) -> Iterator[AssetGoals]:
    """Yield what comes of goals on assets, in their order. Where a worker crashes or takes too long, each goal is tried
    by itself, so that the one at fault has a name. Raises StoppedError when `execution.stop` says so."""
    for job, result in zip(jobs, execute(partial(_try_asset, task), jobs, execution), strict=True):
        yield _try_one_by_one(task, job, execution) if isinstance(result, WorkerFailure) else result


def _try_one_by_one(task: GoalTask, job: AssetJob, execution: ExecutionOptions) -> AssetGoals:
    single = [replace(task, goals={name: text}) for name, text in task.goals.items()]
    bounded = replace(execution, progress=None, workers=1)
    found = AssetGoals(job.id, {}, {}, {})
    for one, result in zip(single, execute(partial(_try_asset, job=job), single, bounded), strict=True):
        ((name, text),) = one.goals.items()
        if isinstance(result, WorkerFailure):
            broken = {name: GoalResult(text, "broken", result.why)}
            result = AssetGoals(job.id, {}, broken, {})
        if result.error:
            return result
        found = AssetGoals(
            job.id,
            {**found.before, **result.before},
            {**found.after, **result.after},
            {**found.pictures, **result.pictures},
        )
    return found


def _try_asset(task: GoalTask, job: AssetJob) -> AssetGoals:
    try:
        return _GoalRun(task, job).run()
    except Exception as error:  # an asset that fails never stops the others
        return AssetGoals(job.id, error=describe_error(error, str(job.path)))


class _ResultRecord(BaseModel):
    goal: str
    outcome: GoalOutcome
    why: str = ""
    hulls: tuple[str, ...] = ()

    @property
    def result(self) -> GoalResult:
        return GoalResult(self.goal, self.outcome, self.why, self.hulls)


class _ResultFile(BaseModel):
    """By the digest of what decides each; the oldest first."""

    results: dict[str, _ResultRecord] = {}


def recall_goals(
    goals: Mapping[str, Goal], edit: ApplyTask, inputs: Mapping[str, provenance.OutputInputs]
) -> Iterator[AssetGoals]:
    """Yield what is known of goals on assets without trying any: of some nothing. inputs: of their edits, by asset."""
    for asset, made in inputs.items():
        file = _locate_kept(edit.out, asset)
        kept = _read_kept(file)
        keys = {
            name: [_digest_goal(goal, edit.program, made, edited=edited) for edited in (False, True)]
            for name, goal in goals.items()
        }
        before, after = ({name: kept[two[k]].result for name, two in keys.items() if two[k] in kept} for k in (0, 1))
        pictures = {name: _locate_picture(file, key) for name, (_, key) in keys.items()}
        yield AssetGoals(asset, before, after, {name: one for name, one in pictures.items() if one.exists()})


def _digest_goal(goal: Goal, program: Program, inputs: provenance.OutputInputs, *, edited: bool) -> str:
    """The digest of all that decides the result of a goal. inputs: of the edit."""
    made = inputs.model_dump(exclude={"settings", "software"})
    if not edited:
        made |= {"program": "", "templates": {}, "manual_edits": None, "selections": None}
    frame = [str(program.orient), program.contact, program.extremity]
    software = [provenance.software_version([goal.plugin]), provenance.find_version("mujoco")]
    return provenance.value_digest([_FORM, made, frame, str(goal), software])


def _locate_kept(out: Path, asset: str) -> Path:
    return out / STATE / "goals" / f"{asset}.json"


def _locate_picture(kept: Path, key: str) -> Path:
    return kept.with_name(f"{kept.stem}.{key[:12]}.png")


class _GoalRun:
    """One asset: what is known of its goals, and what has to be tried."""

    def __init__(self, task: GoalTask, job: AssetJob) -> None:
        self._task, self._job = task, job
        self._file = _locate_kept(task.edit.out, job.id)
        self._known = {} if task.again else _read_kept(self._file)
        self._present = dict[str, _ResultRecord]()

    def run(self) -> AssetGoals:
        goals = {name: parse_goal(text, name) for name, text in self._task.goals.items()}
        edits = bool(self._task.edit.program.rules or self._job.manual_edits)
        before = {name: self._find(goal, edited=False)[0] for name, goal in goals.items()} if edits else {}
        found = {name: self._find(goal, edited=True) for name, goal in goals.items()}
        self._keep()
        pictures = {name: picture for name, (_, picture) in found.items() if picture}
        return AssetGoals(self._job.id, before, {name: result for name, (result, _) in found.items()}, pictures)

    def _find(self, goal: Goal, *, edited: bool) -> tuple[GoalResult, Path | None]:
        """The result of a goal, and the picture of its failure after the edit."""
        key = self._key(goal, edited=edited)
        kept = self._known.get(key) or self._present.get(key)
        picture, result = _locate_picture(self._file, key), kept.result if kept else None
        if result is None:
            subject = self._subject_after if edited else self._subject_before
            result = try_goal(goal, subject)
            if edited and result.outcome == "failed":
                _draw_failure(result, subject, picture)
        self._present[key] = _ResultRecord(goal=result.goal, outcome=result.outcome, why=result.why, hulls=result.hulls)
        return replace(result, objects=()), picture if edited and result.outcome == "failed" else None

    def _key(self, goal: Goal, *, edited: bool) -> str:
        return _digest_goal(goal, self._task.edit.program, self._inputs, edited=edited)

    @cached_property
    def _inputs(self) -> provenance.OutputInputs:
        stamp = self._stamp
        if stamp and stamp.inputs and provenance.has_same_files(stamp.inputs.asset, self._job.path, self._job.base):
            return inputs_of(self._task.edit, self._job, stamp.inputs.asset)
        files = provenance.asset_digests(self._job.path, self._asset.files, self._job.base)
        return inputs_of(self._task.edit, self._job, files)

    @cached_property
    def _stamp(self) -> provenance.Stamp | None:
        return provenance.read_stamp(self._task.edit.out, self._job.id)

    @cached_property
    def _asset(self) -> Asset:
        return formats.read(self._job.path)

    @cached_property
    def _source(self) -> SymbolicMesh:
        job = self._job
        ready = prepare_from_folder(self._asset, job.preparation) if job.preparation else self._asset
        return transfer_labels(job.read_labels(), SymbolicMesh.of(ready)).mesh

    @cached_property
    def _edited(self) -> SymbolicMesh:
        """The output where it is up to date, else the edit in memory."""
        edit, stamp = self._task.edit, self._stamp
        if stamp and stamp.inputs == self._inputs and stamp.is_whole(edit.out):
            return formats.load(edit.out / stamp.out)
        selections = selections_of(self._job.selections, edit.program)
        result = edit.program.run(self._source, edit.templates, selections=selections)
        return replay_manual_edits(self._job.manual_edits, self._source, result.mesh, edit.program, edit.templates)[0]

    @cached_property
    def _subject_before(self) -> GoalSubject:
        return GoalSubject.of(self._source, self._source, self._task.edit.program)

    @cached_property
    def _subject_after(self) -> GoalSubject:
        return GoalSubject.of(self._source, self._edited, self._task.edit.program)

    def _keep(self) -> None:
        """Write what is known now, and some of what was of earlier states; pictures of the rest go."""
        earlier = {key: one for key, one in _read_kept(self._file).items() if key not in self._present}
        recent = dict(list(earlier.items())[-_MOST_KEPT:])
        for key in earlier.keys() - recent.keys():
            _locate_picture(self._file, key).unlink(missing_ok=True)
        text = _ResultFile(results={**recent, **self._present}).model_dump_json(indent=1)
        write_atomically(self._file, text)


def _read_kept(path: Path) -> dict[str, _ResultRecord]:
    """What a file keeps; nothing where there is none, or none that can be read, so that it is tried again."""
    try:
        return _ResultFile.model_validate_json(path.read_bytes()).results
    except (OSError, ValidationError):
        return {}


def _draw_failure(result: GoalResult, subject: GoalSubject, path: Path) -> None:
    """Draw what is at fault and what was tried, solid, within the other hulls."""
    mesh = SymbolicMesh(subject.hulls)
    faulty = [(mesh.hull_of(name).shape, "at fault") for name in result.hulls if name in mesh.index]
    parts = [*faulty, *((shape, "tried") for shape in result.objects)]
    marks = [(name, _COLORS[name], _to_surface(shape)) for shape, name in parts]
    image = draw_volumes(mesh, marks, size=_PICTURE, title=result.goal) if marks else render(mesh, size=_PICTURE)
    write_png(path, image)


def _to_surface(shape: Shape) -> Surface:
    hull = shape.tessellate()
    return Surface(hull.vertices, hull.faces)
