"""Decomposing what the assets of a project have no hulls for, in worker processes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.batch import Lost, isolated
from meshforge.errors import MeshForgeError, told
from meshforge.formats import read
from meshforge.geometry.decompose import DecomposeSettings, cache_folder
from meshforge.preparation import Decomposed, Preparation, decompose_asset, read_preparation, record_digest
from meshforge.project.preparing import Prepared, exchanged

if TYPE_CHECKING:
    from meshforge.project.project import Project


@dataclass(frozen=True, slots=True)
class _Work:
    """One asset to be decomposed; folder: of its preparation."""

    path: Path
    folder: Path
    settings: DecomposeSettings
    only: tuple[str, ...]
    again: bool
    hollow: bool


def decompose(
    project: Project,
    assets: Sequence[str],
    settings: DecomposeSettings,
    *,
    only: Sequence[str],
    again: bool,
    hollow: bool,
    workers: int | None,
    timeout: float | None,
    progress: Callable[[], None] | None,
    stop: Callable[[], bool] | None,
    keeping: Callable[[str], AbstractContextManager[object]],
) -> Iterator[Prepared]:
    """Decompose what assets have no hulls for, in worker processes; each is kept as soon as it is done."""
    layout = project.layout
    work = [
        _Work(project.path(asset), layout.preparation(asset), settings, tuple(only), again, hollow) for asset in assets
    ]
    results = isolated(_decomposed, work, workers=workers, timeout=timeout, done=progress, stop=stop)
    for asset, result in zip(assets, results, strict=True):
        if isinstance(result, Lost):
            yield Prepared(asset, problems=(result.why,))
        elif isinstance(result, str):
            yield Prepared(asset, problems=(result,))
        else:
            with keeping(asset):
                kept = _kept(project, asset, *result)
            yield kept


def _decomposed(work: _Work) -> tuple[Decomposed, str | None] | str:
    """What a worker makes of an asset and the digest of the preparation it saw, or why it failed."""
    try:
        seen = record_digest(work.folder)
        before = read_preparation(work.folder) or Preparation()
        asset = read(work.path)
        done = decompose_asset(
            asset,
            before,
            work.settings,
            only=work.only,
            again=work.again,
            hollow=work.hollow,
            cache=cache_folder(),
        )
        return done, seen
    except Exception as error:  # one asset never stops the others
        return told(error, str(work.path))


def _kept(project: Project, asset: str, result: Decomposed, seen: str | None) -> Prepared:
    problems = [f"{lost.what}: {lost.why}" for lost in result.failed]
    notes = [f"given up, since {lost.what} {lost.why}" for lost in result.dropped]
    notes += [result.missed] if result.missed else []
    try:
        if result.made or result.dropped:
            notes += exchanged(project, asset, result.preparation, seen)
    except MeshForgeError as error:
        return Prepared(asset, problems=(*problems, error.message))
    return Prepared(asset, result.made, tuple(notes), tuple(problems))
