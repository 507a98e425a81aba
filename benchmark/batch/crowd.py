"""Very many assets out of few: variants of another size each, which are there many times as hard links."""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from meshforge.formats import labels_beside, save
from meshforge.geometry import Aabb, aabb_box
from meshforge.samples import TABLES
from meshforge.symbolic import Hull, Label, SymbolicMesh, write_labels

_LINKS = 50
"""Times that a variant is there."""
_FOLDER = 500  # assets
_STOOL = {
    "seat": ((0, 0, 0.4), (0.4, 0.4, 0.44), "panel"),
    "leg_0": ((0, 0, 0), (0.04, 0.04, 0.4), "leg"),
    "leg_1": ((0.36, 0, 0), (0.4, 0.04, 0.4), "leg"),
    "leg_2": ((0, 0.36, 0), (0.04, 0.4, 0.4), "leg"),
    "leg_3": ((0.36, 0.36, 0), (0.4, 0.4, 0.4), "leg"),
    "crumb": ((0.6, 0.6, 0), (0.61, 0.61, 0.01), "misc"),
}
STOOLS = """\
labels panel, leg, misc

Is(misc)              => Delete
Geo(Is(panel), +Z)    => Scale(all, 1.1)
Is(leg)               => Each(Replace(cylinder))
"""


def tables() -> list[Path]:
    """The bundled tables, of 26 to 66 hulls."""
    return sorted(TABLES.glob("*.obj"))


def stools(folder: Path) -> list[Path]:
    """Two stools of six boxes each: as little work for an asset as there can be."""
    made = []
    for number in range(2):
        boxes = [
            Hull(name, "body", aabb_box(Aabb(np.array(low, float), np.array(high, float))), Label(label))
            for name, (low, high, label) in _STOOL.items()
        ]
        mesh = SymbolicMesh(hulls=tuple(boxes[number:] + boxes[:number]))
        path = folder / f"stool_{number}.obj"
        save(mesh, path)
        write_labels(labels_beside(path), mesh, ("panel", "leg", "misc"))
        made.append(path)
    return made


def crowd(models: Sequence[Path], count: int, folder: Path) -> None:
    """Write so many assets with their labels below a folder, some hundred in each of its folders."""
    for number in range(count):
        place, link = _place(models, number, folder), number // len(models) % _LINKS
        place.parent.mkdir(parents=True, exist_ok=True)
        model = models[number % len(models)]
        if link == 0:
            _write_scaled(model, place, 1 + number // len(models) // _LINKS / 1000)
            shutil.copyfile(labels_beside(model), labels_beside(place))
        else:
            first = _place(models, number - link * len(models), folder)
            os.link(first, place)
            os.link(labels_beside(first), labels_beside(place))


def _place(models: Sequence[Path], number: int, folder: Path) -> Path:
    return folder / f"{number // _FOLDER:04}" / f"{models[number % len(models)].stem}_{number:06}.obj"


def _write_scaled(model: Path, place: Path, factor: float) -> None:
    with place.open("w", encoding="utf-8") as out:
        for line in model.read_text("utf-8").splitlines(keepends=True):
            kind, *numbers = line.split()
            is_vertex = kind == "v" and factor != 1
            out.write(" ".join(["v", *(repr(float(x) * factor) for x in numbers)]) + "\n" if is_vertex else line)
