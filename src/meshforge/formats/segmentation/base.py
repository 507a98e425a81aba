"""Points or faces with a class each, as some other tool left them; and where such files lie beside an asset."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

from meshforge.common import AssetError, pluralize
from meshforge.geometry import Floats, Ints

LABELS = (
    *("label", "segment", "segmentation", "seg", "part", "semantic"),
    *("class", "category", "prediction", "pred", "cluster"),
)
"""What properties and arrays with classes are called, what is most plainly one first."""
_LARGEST = 2**31

POINTS_SUFFIXES = (".ply", ".npz", ".npy")
"""The suffixes of segmented points and meshes."""
_MARK = ".points"


@dataclass(frozen=True, eq=False, slots=True)
class Segmentation:
    """The class of each point or face, a whole number; below zero for none.

    vertices: (n, 3) in the frame of the tool, None where the classes are of the asset's own mesh, as it is in its file;
    faces: (m, 3), none for points alone. classes: (m,) of the faces where `of_faces`, else (n,) of the vertices.
    names: those of some classes by their number.
    """

    classes: Ints
    vertices: Floats | None = None
    faces: Ints = field(default_factory=lambda: np.zeros((0, 3), dtype=np.int64))
    names: Mapping[int, str] = field(default_factory=dict)
    of_faces: bool = False


def label_rank_of(name: str) -> int | None:
    """How plainly a property or an array is one of classes by its name, 0 for most plainly; None for one that is not.

    `scalar_Label` is what CloudCompare writes, `part_id` what many do.
    """
    words = [word for word in re.split(r"[^a-z]+", name.lower()) if word not in ("", "scalar", "id", "ids")]
    last = words[-1].removesuffix("ids").removesuffix("id") if words else ""
    forms = {last, last.removesuffix("s"), last.removesuffix("es")}
    return next((rank for rank, known in enumerate(LABELS) if known in forms), None)


def check_segmentation(found: Segmentation, where: str) -> Segmentation:
    """What was read, if it makes sense. Raises AssetError: nothing in it, wrong lengths, or no finite numbers."""
    points, faces, classes = found.vertices, found.faces, found.classes
    if not len(classes):
        raise AssetError("there is nothing in this file that has a class", where=where)
    if points is not None and not np.isfinite(points).all():
        raise AssetError("a coordinate is not a finite number", where=where, remedy="Fix or export it again.")
    if points is not None and len(faces) and (faces.min() < 0 or faces.max() >= len(points)):
        raise AssetError("a face names a vertex that is not there", where=where)
    if points is not None and len(classes) != len(faces if found.of_faces else points):
        holds = pluralize(len(points), "point") + (f" and {pluralize(len(faces), 'face')}" if len(faces) else "")
        problem = f"it has {holds}, but {pluralize(len(classes), 'class', 'classes')}"
        raise AssetError(problem, where=where, remedy="Each point needs one, or each face.")
    return found


def to_whole_numbers(values: npt.ArrayLike, where: str) -> Ints:
    """Classes (n,) as whole numbers; one column of a table counts. Raises AssetError for what is none."""
    array = np.asarray(values)
    array = array.reshape(-1) if array.size == max(array.shape, default=0) else array
    if array.ndim != 1 or array.dtype.kind not in "iufb":
        shape = " x ".join(map(str, array.shape)) or "no"
        problem = f"its classes are {shape} values of type {array.dtype}, not one whole number each"
        raise AssetError(problem, where=where)
    numbers = array.astype(np.float64)
    odd = np.flatnonzero(~((np.abs(numbers) < _LARGEST) & (numbers == np.floor(numbers))))
    if len(odd):
        problem = f"the class of element {odd[0]} is {numbers[odd[0]]:g}, which is no whole number"
        raise AssetError(problem, where=where)
    return numbers.astype(np.int64)


def points_beside(place: Path) -> Path | None:
    """The file of segmented points beside an asset, None where there is none; place: that of its labels file."""
    stem = place.name.removesuffix(".labels.json")
    candidates = (place.with_name(f"{stem}{_MARK}{suffix}") for suffix in POINTS_SUFFIXES)
    return next((path for path in candidates if path.is_file()), None)


def is_segmentation(path: Path) -> bool:
    """Whether a file is one of segmented points of some asset by its name, `table.points.ply`."""
    return path.suffix.lower() in POINTS_SUFFIXES and Path(path.stem).suffix.lower() == _MARK
