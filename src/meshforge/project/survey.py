"""What the assets of a project hold, remembered, so that a status need not read hundreds of files again."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict, ValidationError

from meshforge.asset import Mentions
from meshforge.batch import Found, Lost, asset_digests, isolated, software, source_files, text_digest
from meshforge.errors import told
from meshforge.files import relative_name, write_atomically
from meshforge.formats import read
from meshforge.geometry import digest
from meshforge.preparation import Preparation, prepared, read_preparation, record_digest, sources
from meshforge.project.layout import Layout

TIMEOUT = 600.0
"""Seconds for reading one asset."""


class Facts(BaseModel):
    """What one asset holds. hulls: the digest of each by its name; files: the digest of each by its path from the base.

    bodies, mentions: the name of the body of each hull, in order, and what else its file calls it; sources: how many
    pieces and bodies have no hulls but could be decomposed; preparation: the digest of what was done to the asset
    before; prepared: that in words; replaced: what each hull that was split has become.
    times: modification time [ns] and size of each file, by which a change is guessed without reading it; only the
    digests decide what is stale. error: why the asset cannot be read.
    """

    model_config = ConfigDict(frozen=True)

    hulls: dict[str, str] = {}
    bodies: tuple[str, ...] = ()
    mentions: tuple[Mentions, ...] = ()
    sources: int = 0
    preparation: str | None = None
    prepared: tuple[str, ...] = ()
    replaced: dict[str, tuple[str, ...]] = {}
    files: dict[str, str] = {}
    times: dict[str, tuple[int, int]] = {}
    error: str | None = None


class _SurveyFile(BaseModel):
    """form: counts the forms that this file had, as facts were added."""

    form: Literal[3]
    software: str
    assets: dict[str, Facts]


def survey(
    found: Found,
    layout: Layout,
    only: Collection[str] | None = None,
    *,
    workers: int | None = None,
    progress: Callable[[], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> dict[str, Facts]:
    """The facts of all assets by id, or of some; those whose files changed since are read, in worker processes.

    layout: where the project keeps preparations, and these facts; workers, progress, stop: as of `isolated`.
    """
    memory, ids = layout.survey, found.ids
    known = _remembered(memory)
    wanted = {key: path for key, path in ids.items() if only is None or key in only}
    work = {key: _Work(path, found.base, layout.preparation(key)) for key, path in wanted.items()}
    fresh = {key: known[key] for key, own in work.items() if key in known and _holds(known[key], own)}
    todo = {key: own for key, own in work.items() if key not in fresh}
    results = isolated(_facts, tuple(todo.values()), workers=workers, timeout=TIMEOUT, done=progress, stop=stop)
    for key, result in zip(todo, results, strict=True):
        fresh[key] = Facts(error=result.why) if isinstance(result, Lost) else result
    every = known | fresh
    kept = {key: every[key] for key in ids if key in every and not every[key].error}
    if todo or kept.keys() != known.keys():
        write_atomically(memory, _SurveyFile(form=3, software=software(), assets=kept).model_dump_json())
    return {key: fresh[key] for key in wanted}


def geometry_digest(hulls: Mapping[str, str]) -> str:
    """One digest of all hulls of an asset; hulls: the digest of each by its name, in order."""
    return text_digest("\n".join(f"{name} {known}" for name, known in hulls.items()))


def _remembered(memory: Path) -> dict[str, Facts]:
    """The facts that were kept; none of them where the file is damaged or from another version."""
    try:
        kept = _SurveyFile.model_validate_json(memory.read_bytes())
    except (OSError, ValidationError):
        return {}
    return kept.assets if kept.software == software() else {}


@dataclass(frozen=True, slots=True)
class _Work:
    """An asset, the folder that names of its files count from, and that of its preparation."""

    path: Path
    base: Path
    preparation: Path


def _holds(facts: Facts, work: _Work) -> bool:
    """Whether every file still has the time and size it had, and the preparation is what it was."""
    base = work.base
    try:
        main = {relative_name(file, base) for file in source_files(work.path)}
        same = main <= facts.times.keys() and all(_time(base / name) == time for name, time in facts.times.items())
        return same and record_digest(work.preparation) == facts.preparation
    except OSError:
        return False


def _facts(work: _Work) -> Facts:
    path, base = work.path, work.base
    try:
        source = read(path)
        times = {relative_name(file, base): _time(file) for file in (*source_files(path), *source.files)}
        preparation = read_preparation(work.preparation) or Preparation()
        asset = prepared(source, preparation)
        entries = [entry for step in preparation.steps for entry in step.replaced]
        return Facts(
            hulls={geom.name: digest(geom.shape) for geom in asset.geoms},
            bodies=tuple(geom.body for geom in asset.geoms),
            mentions=tuple(geom.mentions for geom in asset.geoms),
            sources=sum(not source.is_hopeless for source in sources(asset)),
            preparation=record_digest(work.preparation),
            prepared=tuple(map(str, preparation.steps)),
            replaced={entry.what: tuple(entry.made) for entry in entries if entry.kind == "hull"},
            files=asset_digests(path, source.files, base),
            times=times,
        )
    except Exception as error:  # one asset never hides the others
        return Facts(error=told(error, str(path)))


def _time(path: Path) -> tuple[int, int]:
    stat = path.stat()
    return stat.st_mtime_ns, stat.st_size
