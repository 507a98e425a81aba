"""One asset of a batch, or many, checked in every way that is asked for, and written where it was fixed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

from meshforge.batch.discovery import asset_id
from meshforge.batch.execution import execute
from meshforge.batch.jobs import AssetJob
from meshforge.batch.journal import CheckInputs
from meshforge.batch.provenance import software_version, source_files
from meshforge.batch.workers import ExecutionOptions, WorkerFailure
from meshforge.checks import CheckOptions, Examination, FixResult, draw_examination, examine_mesh, find_engine, fix
from meshforge.common import AssetError, MeshForgeError, UsageError, describe_error, plain_path
from meshforge.formats import labels_beside, load, output_path_of, save
from meshforge.rendering import write_png
from meshforge.symbolic import SymbolicMesh, write_labels


@dataclass(frozen=True, slots=True)
class CheckTask:
    """What is to be done with each asset.

    out: the folder for fixed assets, None where nothing is to be fixed; tolerance: how far a fixed hull may stick out
    [m], None for the default of `fix`.
    against: a folder with the assets as they were, or the one asset as it was; pictures: a folder for pictures.
    """

    measures: CheckOptions
    out: Path | None = None
    tolerance: float | None = None
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
        return self.examination is None or any(f.severity == "error" for f in self.examination.findings)

    def to_json(self) -> dict[str, Any]:
        """The examination as JSON-able data; in SI units, volumes in litres."""
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


def check_asset(path: Path, base: Path, labels: Path | None, wanted: CheckTask) -> CheckOutcome:
    """The examination of an asset, which never raises for what is wrong with it; findings are those after fixes.

    base: the common folder of the assets. Raises UsageError for an engine that is not known.
    """
    engine = find_engine(wanted.measures.engine) if wanted.measures.engine else None
    fixed, written = None, None
    try:
        mesh = load(path, labels=labels)
        before = _load_before(path, base, wanted.against)
        if wanted.out and engine:
            fixed = fix(mesh, engine, wanted.tolerance)
            before, mesh = before or (mesh if fixed.changes else None), fixed.mesh
            written = write_fixed(mesh, base, wanted.out, overwrite=wanted.overwrite)
        found = examine_mesh(mesh, wanted.measures, before)
        drawn = _draw_pictures(mesh, found, asset_id(path, base), wanted.pictures)
        read = [part.asset for part in (mesh, before) if part and part.asset]
        files = {file for asset in read for file in (*source_files(asset.path), *asset.files)}
        files |= {file for file in (labels, written, *drawn) if file}
        return CheckOutcome(
            path, None, found, fixed, written, drawn, CheckInputs.of(sorted(files), _describe_task(wanted))
        )
    except MeshForgeError as problem:
        return CheckOutcome(path, problem.message)


def check_assets(
    work: Sequence[AssetJob],
    wanted: CheckTask,
    execution: ExecutionOptions,
    *,
    known: Mapping[str, CheckInputs] = MappingProxyType({}),
) -> Iterator[CheckOutcome | None]:
    """The examinations of many assets, in their order, in worker processes.

    One that crashes, takes too long or too much memory is an error of its own. known: what earlier examinations
    depended on, by id; None for an asset of which that is as it was.
    """
    items = [(job, known.get(job.id)) for job in work]
    results = execute(partial(_check_job, wanted), items, execution)
    for job, result in zip(work, results, strict=True):
        yield CheckOutcome(job.path, f"{job.path}: {result.why}") if isinstance(result, WorkerFailure) else result


def _describe_task(wanted: CheckTask) -> str:
    return f"{wanted} {software_version()}"


def _check_job(wanted: CheckTask, item: tuple[AssetJob, CheckInputs | None]) -> CheckOutcome | None:
    job, seen = item
    try:
        if seen and seen.is_current(job, _describe_task(wanted)):
            return None
        return check_asset(job.path, job.base, job.labels, wanted)
    except UsageError:
        raise
    except Exception as error:  # an asset that fails never stops the others
        return CheckOutcome(job.path, describe_error(error, str(job.path)))


def _load_before(path: Path, base: Path, against: Path | None) -> SymbolicMesh | None:
    """The asset as it was."""
    if against is None:
        return None
    place = against / asset_id(path, base) if against.is_dir() else against
    if not place.exists():
        raise AssetError("there is no such asset to compare with", where=str(place), remedy="Correct --against.")
    return load(place)


def _draw_pictures(mesh: SymbolicMesh, found: Examination, name: str, folder: Path | None) -> tuple[Path, ...]:
    """The pictures of an asset, written below a folder."""
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
