"""Contact sheets of labelled assets: small pictures whose hulls have the colours of their labels."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from io import BytesIO
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.batch import isolated
from meshforge.errors import MeshForgeError
from meshforge.project.reading import Place, places
from meshforge.views import UNLABELLED, label_colors, png, render, sheet, write_png

if TYPE_CHECKING:
    from meshforge.project.project import Project

PER_SHEET = 24
_COLUMNS = 6
_CELL = 320, 240
_TIMEOUT = 120.0


@dataclass(frozen=True, slots=True)
class _Work:
    place: Place
    vocabulary: tuple[str, ...]


def contact_sheets(
    project: Project, folder: Path, assets: Sequence[str], progress: Callable[[], None] | None = None
) -> tuple[Path, ...]:
    """Writes `labels-001.png` and so on, in place of those of an earlier time; what cannot be drawn is left out."""
    vocabulary = project.vocabulary
    works = [_Work(place, vocabulary) for place in places(project, assets)]
    images = isolated(_drawn, works, timeout=_TIMEOUT, done=progress)
    cells = iter([(asset, image) for asset, image in zip(assets, images, strict=True) if isinstance(image, bytes)])
    written = list[Path]()
    while batch := tuple(islice(cells, PER_SHEET)):
        written.append(folder / f"labels-{len(written) + 1:03d}.png")
        _write(written[-1], batch, vocabulary)
    for old in folder.glob("labels-[0-9][0-9][0-9]*.png"):
        if old not in written:
            old.unlink()
    return tuple(written)


def _drawn(work: _Work) -> bytes | None:
    try:
        mesh = work.place.read_mesh()
    except MeshForgeError:
        return None
    return png(render(mesh, color_by="label", size=_CELL, legend=False, vocabulary=work.vocabulary))


def _write(path: Path, batch: Sequence[tuple[str, bytes]], vocabulary: Sequence[str]) -> None:
    from PIL import Image

    images = [Image.open(BytesIO(image)) for _, image in batch]
    colors = label_colors(vocabulary) | {"no label": UNLABELLED}
    write_png(path, sheet(images, _COLUMNS, [asset for asset, _ in batch], colors))
