"""Draws assets that turn, before and after the program, in worker processes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge import batch
from meshforge.common import MeshForgeError, pluralize
from meshforge.formats import load
from meshforge.language import Program, to_canonical_frame
from meshforge.rendering import ColorBy, draw_turn, list_turns, make_contact_sheet

if TYPE_CHECKING:
    from PIL.Image import Image


FRAMES_A_TASK = 3
"""Pictures that one worker draws at a time; each reads the asset anew."""
_ALONE, _AMONG_OTHERS = (480, 400), (300, 240)  # pixels of a picture


@dataclass(frozen=True, slots=True)
class TurntableAsset:
    """An asset that is to be drawn. read: reads it as it is before the program; output: the file that was written."""

    name: str
    read: batch.MeshReader
    output: Path


@dataclass(frozen=True, slots=True)
class _TurnTask:
    """The work of a worker. program: says how the asset stands upright."""

    asset: TurntableAsset
    program: Program
    vocabulary: tuple[str, ...]
    turns: tuple[float, ...]
    size: tuple[int, int]


@dataclass(frozen=True, eq=False, slots=True)
class _TurnPictures:
    """Pictures before and after, one pair for each turn, and how many hulls they show."""

    counts: tuple[int, int]
    pairs: tuple[tuple[Image, ...], ...]


def draw_turntable(
    assets: Sequence[TurntableAsset], program: Program, vocabulary: tuple[str, ...], execution: batch.ExecutionOptions
) -> list[Image]:
    """Return the pictures of one turn, each with all assets before and after.

    execution: its `progress` is called for every `FRAMES_A_TASK` pictures of an asset. Raises StoppedError where its
    `stop` says so, MeshForgeError for an asset that cannot be drawn.
    """
    turns, size = list_turns(), _ALONE if len(assets) == 1 else _AMONG_OTHERS
    parts = [tuple(turns[k : k + FRAMES_A_TASK]) for k in range(0, len(turns), FRAMES_A_TASK)]
    tasks = [_TurnTask(asset, program, vocabulary, part, size) for asset in assets for part in parts]
    titles: list[str] = []
    rows: list[list[tuple[Image, ...]]] = []
    found = batch.execute(_draw, tasks, execution)
    for asset in assets:
        drawn = [_check(asset, next(found)) for _ in parts]
        titles += _titles(asset.name, *drawn[0].counts, alone=len(assets) == 1)
        rows.append([pair for some in drawn for pair in some.pairs])
    columns = 2 if len(assets) <= 2 else 4
    return [
        make_contact_sheet([image for row in rows for image in row[k]], columns=columns, titles=titles)
        for k in range(len(turns))
    ]


def _titles(name: str, before: int, after: int, *, alone: bool) -> Iterator[str]:
    yield f"before: {pluralize(before, 'hull')}" if alone else f"{name}: {pluralize(before, 'hull')}"
    yield f"after: {pluralize(after, 'hull')}"


def _check(asset: TurntableAsset, drawn: _TurnPictures | str | batch.WorkerFailure) -> _TurnPictures:
    if isinstance(drawn, _TurnPictures):
        return drawn
    raise MeshForgeError(drawn if isinstance(drawn, str) else drawn.why, where=asset.name)


def _draw(task: _TurnTask) -> _TurnPictures | str:
    """The pictures, or why there are none: errors of their own classes may not come back from every worker."""
    try:
        before, after = task.asset.read(), load(task.asset.output)
    except MeshForgeError as error:
        return error.message
    before, pose = to_canonical_frame(before, task.program.orient, task.program.contact)
    after = after.with_hulls(hull.move(pose) for hull in after.hulls)
    color_by: ColorBy = "label" if before.labels or after.labels else "hull"
    pairs = draw_turn([before, after], task.turns, size=task.size, color_by=color_by, vocabulary=task.vocabulary)
    return _TurnPictures((len(before.hulls), len(after.hulls)), tuple(pairs))
