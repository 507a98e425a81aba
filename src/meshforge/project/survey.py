"""What the assets of a project hold, remembered, so that a status need not read hundreds of files again."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from pydantic import BaseModel, ConfigDict, ValidationError

from meshforge.batch import Found, Lost, asset_digests, isolated, software, source_files
from meshforge.errors import told
from meshforge.files import relative_name, write_atomically
from meshforge.formats import read
from meshforge.geometry import digest

TIMEOUT = 600.0
"""Seconds for reading one asset."""


class Facts(BaseModel):
    """What one asset holds. hulls: the digest of each by its name; files: the digest of each by its path from the base.

    times: modification time [ns] and size of each file, by which a change is guessed without reading it; only the
    digests decide what is stale. error: why the asset cannot be read.
    """

    model_config = ConfigDict(frozen=True)

    hulls: dict[str, str] = {}
    opaque: int = 0
    files: dict[str, str] = {}
    times: dict[str, tuple[int, int]] = {}
    error: str | None = None


class _SurveyFile(BaseModel):
    software: str
    assets: dict[str, Facts]


def survey(
    found: Found, memory: Path, *, workers: int | None = None, progress: Callable[[], None] | None = None
) -> dict[str, Facts]:
    """The facts of all assets by id; those whose files changed since are read, in worker processes.

    memory: the file where facts are kept; workers, progress: as of `meshforge.batch.isolated`.
    """
    known = _remembered(memory)
    fresh = {
        key: known[key] for key, path in found.ids.items() if key in known and _holds(known[key], path, found.base)
    }
    todo = [(key, path) for key, path in found.ids.items() if key not in fresh]
    results = isolated(
        _facts, [(path, found.base) for _, path in todo], workers=workers, timeout=TIMEOUT, done=progress
    )
    for (key, _), result in zip(todo, results, strict=True):
        fresh[key] = Facts(error=result.why) if isinstance(result, Lost) else result
    facts = {key: fresh[key] for key in found.ids}
    if todo or facts.keys() != known.keys():
        readable = {key: fact for key, fact in facts.items() if not fact.error}
        write_atomically(memory, _SurveyFile(software=software(), assets=readable).model_dump_json())
    return facts


def _remembered(memory: Path) -> dict[str, Facts]:
    """The facts that were kept; none of them where the file is damaged or from another version."""
    try:
        kept = _SurveyFile.model_validate_json(memory.read_bytes())
    except (OSError, ValidationError):
        return {}
    return kept.assets if kept.software == software() else {}


def _holds(facts: Facts, path: Path, base: Path) -> bool:
    """Whether every file still has the time and size it had."""
    try:
        main = {relative_name(file, base) for file in source_files(path)}
        return main <= facts.times.keys() and all(_time(base / name) == time for name, time in facts.times.items())
    except OSError:
        return False


def _facts(work: tuple[Path, Path]) -> Facts:
    path, base = work
    try:
        asset = read(path)
        times = {relative_name(file, base): _time(file) for file in (*source_files(path), *asset.files)}
        return Facts(
            hulls={geom.name: digest(geom.shape) for geom in asset.geoms},
            opaque=len(asset.opaque),
            files=asset_digests(path, asset.files, base),
            times=times,
        )
    except Exception as error:  # one asset never hides the others
        return Facts(error=told(error, str(path)))


def _time(path: Path) -> tuple[int, int]:
    stat = path.stat()
    return stat.st_mtime_ns, stat.st_size
