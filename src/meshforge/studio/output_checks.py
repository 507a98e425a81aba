"""Checks outputs beside their assets, in worker processes; the results are cached by content."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future
from dataclasses import dataclass
from pathlib import Path
from typing import get_args

from pydantic import ValidationError

from meshforge.batch import ExecutionOptions, WorkerFailure, count_processors, read_stamp, run_isolated
from meshforge.checks import CheckOptions, draw_examination, examine_mesh
from meshforge.common import MeshForgeError, ProjectError, describe_error, write_atomically
from meshforge.common.processes import memory_share
from meshforge.project import Project
from meshforge.rendering import LengthUnit, to_data_url
from meshforge.studio.output_measures import MeasureTask, check_key, measure, read_pair
from meshforge.studio.thumbnails import remove_oldest
from meshforge.studio.wire.asset import CheckPart, CheckPicture, CheckResult, Fault
from meshforge.studio.workers import WORK_TIMEOUT, Workers, future_of, project_of_one

PICTURE_SIZE = (800, 600)

CHECK_PARTS: tuple[CheckPart, ...] = get_args(CheckPart)
MOST_RESULTS = 8000
"""Files that are kept when a studio is opened."""


class OutputChecks:
    """The checks of a project's outputs. workers: for what pages ask for; a call that is cancelled ends at once."""

    def __init__(self, folder: Path, workers: Workers) -> None:
        self._cache, self._workers = ResultCache(folder), workers
        self._faults: dict[str, tuple[Fault, ...]] = {}
        remove_oldest(folder, MOST_RESULTS)

    def check_part(self, project: Project, asset: str, part: CheckPart) -> Future[CheckResult]:
        """Return one part of what is measured of an asset's output. Raises ProjectError where there is no output."""
        work = _make_task(project, asset)
        kept = self._cache.read(work.key, part)
        return future_of(kept) if kept else self._workers.start(_measure_part, work, part, self._cache)

    def draw_pictures(
        self, project: Project, asset: str, part: CheckPart, unit: LengthUnit = "m"
    ) -> Future[tuple[CheckPicture, ...]]:
        """Return the pictures of a part, drawn now. Raises ProjectError where there is no output."""
        return self._workers.start(_draw, _make_task(project, asset), part, unit)

    def faults_of(self, key: str | None) -> tuple[Fault, ...] | None:
        """Return the faults of the output of a key, None where not all of its parts are measured."""
        if key is None:
            return None
        if key not in self._faults and (found := self._cache.read_faults(key)) is not None:
            self._faults[key] = found
        return self._faults.get(key)

    def check_all(
        self, project: Project, assets: Sequence[str], done: Callable[[], None], stop: Callable[[], bool]
    ) -> Iterator[tuple[str, tuple[Fault, ...] | str]]:
        """Yield the faults of the outputs of some assets, or why one was not checked; those measured already come
        first.

        done: called for each output. Raises StoppedError where `stop` says so; what was measured stays.
        """
        fresh = []
        for asset in assets:
            try:
                work = _make_task(project, asset)
            except ProjectError as error:  # its output went meanwhile
                done()
                yield asset, error.sentence
                continue
            if self._cache.missing_parts(work.key):
                fresh.append(work)
            else:
                done()
                yield asset, self.faults_of(work.key) or ()
        bound = memory_share(min(count_processors(), max(len(fresh), 1)))
        todo = [(work, self._cache) for work in fresh]
        results = run_isolated(
            _measure_all, todo, ExecutionOptions(timeout=WORK_TIMEOUT, memory=bound, progress=done, stop=stop)
        )
        for work, result in zip(fresh, results, strict=True):
            problem = result.why if isinstance(result, WorkerFailure) else result
            yield work.asset, problem or self.faults_of(work.key) or ()


def _make_task(project: Project, asset: str) -> MeasureTask:
    key = check_key(read_stamp(project.layout.edited, asset))
    if key is None:
        raise ProjectError("it has no output that could be checked", where=asset, remedy="Apply the program.")
    return MeasureTask(project_of_one(project, asset), asset, key)


def _measure_part(task: MeasureTask, part: CheckPart, cache: "ResultCache") -> CheckResult:
    checked = measure(read_pair(task), part)
    cache.write(task.key, checked)
    return checked


def _measure_all(work: "tuple[MeasureTask, ResultCache]") -> str | None:
    task, cache = work
    problem = None
    try:
        pair = read_pair(task)
        for part in cache.missing_parts(task.key):
            try:
                cache.write(task.key, measure(pair, part))
            except MeshForgeError as error:  # the other parts can still be measured
                problem = problem or error.sentence
    except Exception as error:  # one that fails never stops the others
        return describe_error(error)
    return problem


def _draw(task: MeasureTask, part: CheckPart, unit: LengthUnit) -> tuple[CheckPicture, ...]:
    pair = read_pair(task)
    found = None if part == "engines" else examine_mesh(pair.after, CheckOptions((part,)), pair.before)
    rows = draw_examination(pair.after, found, PICTURE_SIZE, unit) if found else ()
    return tuple(CheckPicture(text=text, source=to_data_url(image)) for _, text, image in rows)


@dataclass(frozen=True, slots=True)
class ResultCache:
    """A folder of results; one that cannot be read there counts as not measured."""

    folder: Path

    def read(self, key: str, part: CheckPart) -> CheckResult | None:
        """Return a part that was measured."""
        try:
            return CheckResult.model_validate_json((self.folder / f"{key}.{part}.json").read_bytes())
        except (OSError, ValidationError):
            return None

    def write(self, key: str, checked: CheckResult) -> None:
        """Keep a part."""
        write_atomically(self.folder / f"{key}.{checked.part}.json", checked.model_dump_json())

    def missing_parts(self, key: str) -> tuple[CheckPart, ...]:
        """Return the parts that were not measured yet."""
        return tuple(part for part in CHECK_PARTS if self.read(key, part) is None)

    def read_faults(self, key: str) -> tuple[Fault, ...] | None:
        """Return the faults of all parts, None where one is not measured."""
        parts = [checked for part in CHECK_PARTS if (checked := self.read(key, part))]
        if len(parts) < len(CHECK_PARTS):
            return None
        found = [finding for checked in parts for finding in checked.findings]
        return tuple(Fault(rule=f.rule, severity=f.severity, engine=f.engine, new=f.new) for f in found)
