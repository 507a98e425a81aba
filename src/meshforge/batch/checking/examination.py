"""One asset of a batch checked in every way that is asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

from meshforge.batch.assets.digests import software, source_files
from meshforge.batch.assets.expand import asset_id
from meshforge.batch.assets.job import AssetJob
from meshforge.batch.checking.journal import Seen
from meshforge.batch.checking.mending import write_mended
from meshforge.batch.workers.pool import Lost
from meshforge.batch.workers.spread import Spread
from meshforge.checks import Examination, Fixed, Measures, engine_named, examine_mesh, fix, pictures
from meshforge.errors import AssetError, MeshForgeError, UsageError, told
from meshforge.formats import load
from meshforge.symbolic import SymbolicMesh


@dataclass(frozen=True, slots=True)
class Wanted:
    """What is to be done with each asset.

    out: the folder for mended assets, None where nothing is to be mended; tolerance: as of `fix` [m].
    against: a folder with the assets as they were, or the one asset as it was; pictures: a folder for pictures.
    """

    measures: Measures
    out: Path | None = None
    tolerance: float | None = None
    overwrite: bool = False
    against: Path | None = None
    pictures: Path | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Examined:
    """What was found of one asset; error: the whole message where it could not be read, or not be written.

    written: the file of the mended asset; pictures: the files of pictures; seen: what all this depends on.
    """

    path: Path
    error: str | None = None
    examination: Examination | None = None
    fix_result: Fixed | None = None
    output: Path | None = None
    pictures: tuple[Path, ...] = ()
    inputs: Seen | None = None

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


def examine(path: Path, base: Path, labels: Path | None, wanted: Wanted) -> Examined:
    """The examination of an asset, which never raises for what is wrong with it; findings are those after mending.

    base: the common folder of the assets. Raises UsageError for an engine that is not known.
    """
    engine = engine_named(wanted.measures.engine) if wanted.measures.engine else None
    fixed, written = None, None
    try:
        mesh = load(path, labels=labels)
        before = _before(path, base, wanted.against)
        if wanted.out and engine:
            fixed = fix(mesh, engine, wanted.tolerance)
            before, mesh = before or (mesh if fixed.changes else None), fixed.mesh
            written = write_mended(mesh, base, wanted.out, overwrite=wanted.overwrite)
        found = examine_mesh(mesh, wanted.measures, before)
        drawn = _drawn(mesh, found, asset_id(path, base), wanted.pictures)
        read = [part.asset for part in (mesh, before) if part and part.asset]
        files = {file for asset in read for file in (*source_files(asset.path), *asset.files)}
        files |= {file for file in (labels, written, *drawn) if file}
        return Examined(path, None, found, fixed, written, drawn, Seen.of(sorted(files), _asked(wanted)))
    except MeshForgeError as problem:
        return Examined(path, problem.message)


def examine_all(
    work: Sequence[AssetJob],
    wanted: Wanted,
    spread: Spread,
    *,
    done: Callable[[], None] | None = None,
    known: Mapping[str, Seen] = MappingProxyType({}),
) -> Iterator[Examined | None]:
    """The examinations of many assets, in their order, in worker processes.

    One that crashes, takes too long or too much memory is an error of its own. known: what earlier examinations
    depended on, by id; None for an asset of which that is as it was.
    """
    items = [(job, known.get(job.id)) for job in work]
    results = spread.run(partial(_examine, wanted), items, done)
    for job, result in zip(work, results, strict=True):
        yield Examined(job.path, f"{job.path}: {result.why}") if isinstance(result, Lost) else result


def _asked(wanted: Wanted) -> str:
    return f"{wanted} {software()}"


def _examine(wanted: Wanted, item: tuple[AssetJob, Seen | None]) -> Examined | None:
    job, seen = item
    try:
        if seen and seen.is_current(job, _asked(wanted)):
            return None
        return examine(job.path, job.base, job.labels, wanted)
    except UsageError:
        raise
    except Exception as error:  # an asset that fails never stops the others
        return Examined(job.path, told(error, str(job.path)))


def _before(path: Path, base: Path, against: Path | None) -> SymbolicMesh | None:
    """The asset as it was."""
    if against is None:
        return None
    place = against / asset_id(path, base) if against.is_dir() else against
    if not place.exists():
        raise AssetError("there is no such asset to compare with", where=str(place), remedy="Correct --against.")
    return load(place)


def _drawn(mesh: SymbolicMesh, found: Examination, name: str, folder: Path | None) -> tuple[Path, ...]:
    """The pictures of an asset, written below a folder."""
    if folder is None:
        return ()
    from meshforge.views import write_png

    paths = []
    for kind, _, image in pictures(mesh, found):
        path = folder / f"{name}.{kind}.png"
        write_png(path, image)
        paths.append(path)
    return tuple(paths)
