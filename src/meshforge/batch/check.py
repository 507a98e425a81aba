"""Assets of a batch checked in every way that is asked for, written where they were fixed, and the journal by which a
run that was stopped goes on where it was."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any, BinaryIO

from meshforge.batch.discovery import asset_id
from meshforge.batch.engine_load import engine_version, examine_file
from meshforge.batch.execution import execute
from meshforge.batch.jobs import AssetJob
from meshforge.batch.lock import hold_lock
from meshforge.batch.provenance import are_unchanged, software_version, source_files, text_digest
from meshforge.batch.workers import ExecutionOptions, WorkerFailure
from meshforge.checks import CHECKS, CheckOptions, Examination, FixResult, draw_examination, fix
from meshforge.common import AssetError, MeshForgeError, UsageError, describe_error, file_digest, plain_path
from meshforge.engines import find_engine
from meshforge.formats import labels_beside, load, output_path_of, plugin_of_suffix, save
from meshforge.rendering import write_png
from meshforge.symbolic import SymbolicMesh, write_labels

_START = b'{"asset": '


@dataclass(frozen=True, slots=True)
class CheckInputs:
    """What decides what is found of an asset, and what was written for it.

    files: the digest of each file by its path; request: the digest of what was to be found out, and by which software.
    """

    files: dict[str, str]
    request: str

    @staticmethod
    def of(files: Iterable[Path], asked: str) -> CheckInputs:
        """Return what there is by now."""
        return CheckInputs({str(path): file_digest(path) for path in files}, text_digest(asked))

    def is_current(self, job: AssetJob, asked: str) -> bool:
        """Return whether all is as it was, without reading the asset."""
        own = [*source_files(job.path), *([job.labels] if job.labels else [])]
        if self.request != text_digest(asked) or not all(str(path) in self.files for path in own):
            return False
        return are_unchanged(Path(), self.files)


class CheckJournal:
    """A file of JSON lines, one for each asset that was looked at; the last one of an asset counts."""

    def __init__(self, path: Path, stream: BinaryIO) -> None:
        """Read what there is; a line that a killed run could not end is cut off. Raises MeshForgeError: no journal."""
        self._stream = stream
        self._places: dict[str, int] = {}
        self.inputs: dict[str, CheckInputs] = {}
        end = 0
        for number, line in enumerate(self._stream, 1):
            if not line.endswith(b"\n") and line[: len(_START)] == _START[: len(line)]:
                break  # a run was killed while it wrote this
            try:
                row = json.loads(line)
                self.inputs[row["asset"]] = CheckInputs(row["files"], row["asked"])
            except (ValueError, TypeError, KeyError, RecursionError) as error:
                remedy = "Give the file of an earlier run, or a new one."
                at = f"{path}:{number}"
                raise MeshForgeError("this is no journal of a check", where=at, remedy=remedy) from error
            self._places[row["asset"]], end = end, end + len(line)
        self._stream.truncate(end)

    def read_row(self, asset: str) -> dict[str, Any]:
        """Return what is kept of an asset."""
        self._stream.seek(self._places[asset])
        found: dict[str, Any] = json.loads(self._stream.readline())
        return found

    def add(self, asset: str, seen: CheckInputs, row: dict[str, Any]) -> None:
        """Keep what was found."""
        line = json.dumps({"asset": asset, "files": seen.files, "asked": seen.request, **row}) + "\n"
        self._places[asset] = self._stream.seek(0, os.SEEK_END)
        self._stream.write(line.encode())
        self._stream.flush()


@contextmanager
def open_journal(path: Path) -> Iterator[CheckJournal]:
    """Open the journal in a file, made if absent, for the time of a `with` block; one run at a time."""
    with hold_lock(path, str(path), wait=0), path.open("r+b") as stream:
        yield CheckJournal(path, stream)


@dataclass(frozen=True, slots=True)
class CheckTask:
    """What is to be done with each asset.

    out: the folder for fixed assets, None where nothing is to be fixed; tolerance: how far a fixed hull may stick out
    [m], None for the default of `fix`; max_vertices: the most vertices that a fixed hull may have.
    against: a folder with the assets as they were, or the one asset as it was; pictures: a folder for pictures.
    """

    measures: CheckOptions
    out: Path | None = None
    tolerance: float | None = None
    max_vertices: int | None = None
    overwrite: bool = False
    against: Path | None = None
    pictures: Path | None = None


@dataclass(frozen=True, eq=False, slots=True)
class CheckOutcome:
    """What was found of one asset; error: the whole message where it could not be read, or not be written.

    output: the file of the fixed asset; pictures: the files of pictures; inputs: what all this depends on.
    """

    path: Path
    error: str | None = None
    examination: Examination | None = None
    fix_result: FixResult | None = None
    output: Path | None = None
    pictures: tuple[Path, ...] = ()
    inputs: CheckInputs | None = None

    @property
    def has_failed(self) -> bool:
        """Whether there is an error."""
        return self.examination is None or self.examination.has_failed

    def to_json(self) -> dict[str, Any]:
        """Return the examination as JSON-able data; in SI units, volumes in litres."""
        rows = [
            {"rule": f.rule, "severity": f.severity, "hulls": list(f.hulls), "message": f.message, "remedy": f.remedy}
            for f in (self.examination.findings if self.examination else ())
        ]
        line: dict[str, Any] = {"asset": str(self.path), "error": self.error, "findings": rows}
        if self.fix_result:
            line["fixed"] = {"out": str(self.output)} | self.fix_result.to_json()
        if self.examination:
            line |= self.examination.to_json()
        if self.pictures:
            line["pictures"] = [str(path) for path in self.pictures]
        return line


def check_asset(path: Path, base: Path, labels: Path | None, task: CheckTask) -> CheckOutcome:
    """Return the examination of an asset, which never raises for what is wrong with it; findings are those after fixes.

    base: the common folder of the assets. Raises UsageError for an engine that is not known.
    """
    engine = find_engine(task.measures.engine) if task.measures.engine else None
    fixed, written = None, None
    try:
        mesh = load(path, labels=labels)
        before = _load_before(path, base, task.against)
        if task.out:
            fixed = fix(mesh, engine, task.tolerance, task.max_vertices)
            before, mesh = before or (mesh if fixed.changes else None), fixed.mesh
            written = write_fixed(mesh, base, task.out, overwrite=task.overwrite)
        found = examine_file(written or path, mesh, task.measures, before)
        found = found.add_notes(mesh.asset.notes if mesh.asset else ())
        drawn = _draw_pictures(mesh, found, asset_id(path, base), task.pictures)
        read = [part.asset for part in (mesh, before) if part and part.asset]
        files = {file for asset in read for file in (*source_files(asset.path), *asset.files)}
        files |= {file for file in (labels, written, *drawn) if file}
        # what an engine does not take may be for want of a file, so it is asked again
        kept = not (found.loaded and (found.loaded.refusal or found.loaded.untried))
        inputs = CheckInputs.of(sorted(files), _describe_task(task, path)) if kept else None
        return CheckOutcome(path, None, found, fixed, written, drawn, inputs)
    except MeshForgeError as problem:
        return CheckOutcome(path, problem.message)


def check_assets(
    work: Sequence[AssetJob],
    task: CheckTask,
    execution: ExecutionOptions,
    *,
    known: Mapping[str, CheckInputs] = MappingProxyType({}),
) -> Iterator[CheckOutcome | None]:
    """Yield the examinations of many assets, in their order, in worker processes.

    One that crashes, takes too long or too much memory is an error of its own. known: what earlier examinations
    depended on, by id; None for an asset of which that is as it was.
    """
    results = execute(partial(_check_job, task), [(job, known.get(job.id)) for job in work], execution)
    for job, result in zip(work, results, strict=True):
        yield CheckOutcome(job.path, f"{job.path}: {result.why}") if isinstance(result, WorkerFailure) else result


def _describe_task(task: CheckTask, path: Path) -> str:
    plugins = [plugin_of_suffix(path.suffix), *map(CHECKS.plugin, task.measures.names)]
    return f"{task} {software_version(plugins)}{engine_version(task.measures.engine)}"


def _check_job(task: CheckTask, item: tuple[AssetJob, CheckInputs | None]) -> CheckOutcome | None:
    job, seen = item
    try:
        if seen and seen.is_current(job, _describe_task(task, job.path)):
            return None
        return check_asset(job.path, job.base, job.labels, task)
    except UsageError:
        raise
    except Exception as error:  # an asset that fails never stops the others
        return CheckOutcome(job.path, describe_error(error, str(job.path)))


def _load_before(path: Path, base: Path, against: Path | None) -> SymbolicMesh | None:
    if against is None:
        return None
    place = against / asset_id(path, base) if against.is_dir() else against
    if not place.exists():
        raise AssetError("there is no such asset to compare with", where=str(place), remedy="Correct --against.")
    return load(place)


def _draw_pictures(mesh: SymbolicMesh, found: Examination, name: str, folder: Path | None) -> tuple[Path, ...]:
    if folder is None:
        return ()
    paths = []
    for kind, _, image in draw_examination(mesh, found):
        path = folder / f"{name}.{kind}.png"
        write_png(path, image)
        paths.append(path)
    return tuple(paths)


def write_fixed(mesh: SymbolicMesh, base: Path, out: Path, *, overwrite: bool = False) -> Path:
    """Write a mesh with its labels below `out`, in its own format; the main file.

    base: the folder whose tree the output mirrors. Every file is written whole or not at all, the main one last.
    Raises AssetError: `out` is the folder of the assets, a file of the input or another one with other content would
    be written over (this one unless `overwrite`), or the format cannot hold the mesh.
    """
    if mesh.asset is None or plain_path(out) == plain_path(base):
        raise AssetError(
            "the output folder is the folder of the assets", where=str(out), remedy="Choose another --out."
        )
    saved = save(mesh, output_path_of(mesh.asset, base, plain_path(out)), overwrite=overwrite)
    if mesh.labels:
        renamed = mesh.with_hulls(replace(hull, name=saved.names.get(hull.name, hull.name)) for hull in mesh.hulls)
        write_labels(labels_beside(saved.path), renamed, ())
    return saved.path
