"""Assets of a batch checked in every way that is asked for, and written where they were fixed."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from meshforge.batch.ask_engines import ENGINES_TO_ASK, name_of
from meshforge.batch.discovery import asset_id
from meshforge.batch.execution import execute
from meshforge.batch.jobs import AssetJob
from meshforge.batch.provenance import asset_digests
from meshforge.batch.validators import ask_validator
from meshforge.batch.workers import ExecutionOptions, WorkerFailure
from meshforge.checks import CheckOptions, EngineLoad, Examination, FixResult, draw_examination, examine_mesh, fix
from meshforge.common import AssetError, MeshForgeError, UsageError, describe_error, plain_path
from meshforge.engines import Finding, find_engine
from meshforge.formats import labels_beside, load, output_path_of, save
from meshforge.rendering import write_png
from meshforge.symbolic import SymbolicMesh, write_labels


@dataclass(frozen=True, slots=True)
class CheckTask:
    """What is to be done with each asset.

    out: the folder for fixed assets, None where nothing is to be fixed; tolerance: how far a fixed hull may stick out
    [m], None for the default of `fix`; max_vertices: the most vertices that a fixed hull may have.
    against: a folder with the assets as they were, or the one asset as it was; pictures: a folder for pictures.
    exclude: pairs of bodies that are not to touch, `BODY:BODY` or `all` that are proposed.
    digests_from: the folder from which the paths in digests of files count, None where no digests are wanted.
    """

    measures: CheckOptions
    out: Path | None = None
    tolerance: float | None = None
    max_vertices: int | None = None
    overwrite: bool = False
    against: Path | None = None
    pictures: Path | None = None
    digests_from: Path | None = None
    exclude: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class CheckOutcome:
    """What was found of one asset; error: the whole message where it could not be read, or not be written.

    output: the file of the fixed asset; pictures: the files of pictures; digests: of all files of the asset, if wanted,
    None where one is missing, or not known; accepted: findings that a baseline has; is_unchanged: since the baseline,
    so that it was not checked again.
    """

    path: Path
    error: str | None = None
    examination: Examination | None = None
    fix_result: FixResult | None = None
    output: Path | None = None
    pictures: tuple[Path, ...] = ()
    digests: Mapping[str, str] | None = None
    accepted: frozenset[Finding] = frozenset()
    is_unchanged: bool = False

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What was found, also that it could not be read."""
        if self.examination is None:
            return (Finding("unreadable", "error", (), self.error or "", "", "read"),)
        return self.examination.findings

    @property
    def has_failed(self) -> bool:
        """Whether there is an error that no baseline has."""
        return any(one.severity == "error" and one not in self.accepted for one in self.findings)

    @property
    def is_spotless(self) -> bool:
        """Whether there is neither an error nor a warning that no baseline has."""
        return all(one in self.accepted for one in self.findings)

    def to_json(self) -> dict[str, Any]:
        """Return the examination as JSON-able data; in SI units, volumes in litres."""
        rows = [
            {"code": one.code, **asdict(one), "hulls": list(one.hulls), "known": one in self.accepted}
            for one in self.findings
        ]
        line: dict[str, Any] = {"asset": str(self.path), "error": self.error, "findings": rows}
        if self.is_unchanged:
            line["unchanged"] = True
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
            fixed = fix(mesh, engine, task.tolerance, task.max_vertices, task.exclude)
            before, mesh = before or (mesh if fixed.changes else None), fixed.mesh
            written = write_fixed(mesh, base, task.out, overwrite=task.overwrite)
        found = examine_file(written or path, mesh, task.measures, before)
        found = found.add_notes(mesh.asset.notes if mesh.asset else ())
        drawn = _draw_pictures(mesh, found, asset_id(path, base), task.pictures)
        digests = None
        may_come = mesh.asset and (mesh.asset.missing or mesh.asset.needed)  # files that are not there, unseen
        if task.digests_from and mesh.asset and not may_come:
            digests = asset_digests(path, mesh.asset.files, task.digests_from)
        return CheckOutcome(path, None, found, fixed, written, drawn, digests)
    except MeshForgeError as problem:
        return CheckOutcome(path, problem.message)


def check_assets(work: Sequence[AssetJob], task: CheckTask, execution: ExecutionOptions) -> Iterator[CheckOutcome]:
    """Yield the examinations of many assets, in their order, in worker processes.

    One that crashes, takes too long or too much memory is an error of its own.
    """
    for job, result in zip(work, execute(partial(_check_job, task), work, execution), strict=True):
        yield CheckOutcome(job.path, f"{job.path}: {result.why}") if isinstance(result, WorkerFailure) else result


def _check_job(task: CheckTask, job: AssetJob) -> CheckOutcome:
    try:
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


def examine_file(
    path: Path | None, mesh: SymbolicMesh, wanted: CheckOptions, before: SymbolicMesh | None
) -> Examination:
    """Return the examination of a mesh, and what the engine whose limits are asked for, and other validators, say of
    its file.

    path: of the file as it is now, None for a mesh that no file is of; before: the mesh that it was edited from.
    Raises UsageError for an unknown engine.
    """
    found = examine_mesh(mesh, wanted, before)
    for validator in wanted.validators:
        found = found.add_result(validator, ask_validator(validator, path, mesh))
    if (engine := wanted.engine) is None:
        return found
    ask = ENGINES_TO_ASK.get(engine)
    return found.add_engine_load(ask(engine, path, mesh) if ask else EngineLoad(engine, name_of(path)))
