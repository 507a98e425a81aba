"""Points with a class each, as segmentations (Find3D) and datasets (PartNet) have them in files beside an asset."""

import warnings
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from meshforge.common import AssetError, pluralize
from meshforge.geometry import Aabb, Floats, Ints

POINTS_SUFFIXES = (".ply", ".npz", ".npy")
"""The suffixes of segmented points; the last, which other segmentations write, is found so that it is refused."""
POINTS_MARK = ".points"
"""What their names end with before the suffix: `table.points.npz`."""

_POINTS = ("points", "xyz", "coord", "coords", "pts", "vertices")
_LABELS = ("label", "labels", "scalar_label", "part_id", "segment", "seg", "semantic", "class", "pred")
_LARGEST = 2**31
_MOST = 1 << 29  # bytes of arrays that an archive unpacks to: ten million points with classes
_REMEDY = (
    "Points with a class each are read, from a .ply whose points have a property `label`, or so: "
    'np.savez("NAME.points.npz", points=xyz, labels=classes, names=["drawer", "handle"])'
)


@dataclass(frozen=True, eq=False, slots=True)
class Segmentation:
    """points: (n, 3) in the frame of the tool; classes: (n,) whole numbers, below zero for none; names: those of
    classes 0, 1, ..., none where the file has none."""

    points: Floats
    classes: Ints
    names: tuple[str, ...] = ()

    def class_names(self, given: Sequence[str] = ()) -> Mapping[int, str]:
        """Return the names of classes by number: those given, of 0, 1, ..., else the file's; an empty one is none."""
        return {k: name for k, name in enumerate(given or self.names) if name}


def points_beside(place: Path) -> Path | None:
    """Return the file of segmented points beside an asset, None where there is none; place: that of its labels file."""
    stem = place.name.removesuffix(".labels.json")
    candidates = (place.with_name(f"{stem}{POINTS_MARK}{suffix}") for suffix in POINTS_SUFFIXES)
    return next((path for path in candidates if path.is_file()), None)


def is_segmentation(path: Path) -> bool:
    """Return whether a file is one of segmented points of some asset by its name, `table.points.ply`."""
    return path.suffix.lower() in POINTS_SUFFIXES and Path(path.stem).suffix.lower() == POINTS_MARK


def read_segmentation(path: Path) -> Segmentation:
    """Return the points in a `.ply` or `.npz` file, with the class of each.

    Raises AssetError naming the file: unreadable, of another kind, with faces, without classes, not finite.
    """
    where = str(path)
    match path.suffix.lower():
        case ".ply":
            from meshforge.formats.mesh_reader import read_content  # lazy: hardly any asset has points beside it
            from meshforge.formats.meshfile.ply import parse_ply  # lazy: as above

            text = parse_ply(read_content(path), where)
            arrays = {"points": text.vertices} | ({"faces": text.faces} if len(text.faces) else {})
            vertex = next(e for e in text.elements if e.name == "vertex")
            arrays |= {p.name.lower(): np.asarray(vertex.values[p.name]) for p in vertex.properties if not p.count}
        case ".npz":
            arrays = _read_archive(path)
        case suffix:
            problem = f"{suffix or 'a file without suffix'} is no kind of segmented points"
            raise AssetError(problem, where=where, remedy=_REMEDY)
    if len(np.atleast_1d(arrays.get("faces", ()))):
        remedy = f"Spread points over the faces, with the class of the face for each. {_REMEDY}"
        raise AssetError("it has faces, and only points with a class each are read", where=where, remedy=remedy)
    points = _to_points(_require(arrays, _POINTS, where), where)
    classes = _to_whole_numbers(_require(arrays, _LABELS, where), where)
    if len(classes) != len(points):
        problem = f"it has {pluralize(len(points), 'point')}, but {pluralize(len(classes), 'class', 'classes')}"
        raise AssetError(problem, where=where, remedy="Each point needs one.")
    if not len(points):
        raise AssetError("there is nothing in this file that has a class", where=where)
    names = np.ravel(arrays.get("names", ()))
    texts = (str(n, "utf-8", "replace") if isinstance(n, bytes) else str(n) for n in names.tolist())
    return Segmentation(points, classes, tuple(texts))


def _read_archive(path: Path) -> dict[str, npt.NDArray[Any]]:
    """The arrays of an archive; pickled objects, which may run anything, are not read."""
    try:
        with zipfile.ZipFile(path) as listed:
            size = sum(entry.file_size for entry in listed.infolist())
        if size <= _MOST:
            with warnings.catch_warnings(action="ignore"), np.load(path, allow_pickle=False) as archive:
                return {key.lower(): archive[key] for key in archive.files}
    except OSError as error:
        raise AssetError(f"cannot be read: {error.strerror or error}", where=str(path)) from error
    except Exception as error:  # NumPy and what it stands on raise a dozen kinds for damaged files
        problem = "these arrays cannot be read: the file is damaged, of another kind, or holds Python objects"
        raise AssetError(problem, where=str(path), remedy=_REMEDY) from error
    problem = f"its arrays would take {size >> 20:,} MiB, more than the {_MOST >> 20} MiB that are read"
    raise AssetError(problem, where=str(path), remedy="Thin the points out.")


def _require(arrays: Mapping[str, npt.NDArray[Any]], names: Sequence[str], where: str) -> npt.NDArray[Any]:
    found = next((arrays[name] for name in names if name in arrays), None)
    if found is None:
        lacks = "points" if names is _POINTS else "labels"
        raise AssetError(f"it has no {lacks}, but {', '.join(sorted(arrays))}", where=where, remedy=_REMEDY)
    return found


def _to_points(array: npt.NDArray[Any], where: str) -> Floats:
    if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in "iuf":
        problem = f"its points are {_describe_shape(array)}, not three numbers each"
        raise AssetError(problem, where=where, remedy=_REMEDY)
    points: Floats = array.astype(np.float64)
    if not np.isfinite(points).all():
        raise AssetError("a coordinate is not a finite number", where=where, remedy="Fix or export it again.")
    return points


def _to_whole_numbers(array: npt.NDArray[Any], where: str) -> Ints:
    """Classes (n,) as whole numbers; one column of a table counts."""
    if array.size != max(array.shape, default=0) or array.dtype.kind not in "iufb":
        problem = f"its classes are {_describe_shape(array)}, not one whole number each"
        raise AssetError(problem, where=where, remedy=_REMEDY)
    numbers = array.reshape(-1).astype(np.float64)
    invalid = np.flatnonzero(~((np.abs(numbers) < _LARGEST) & (numbers == np.floor(numbers))))
    if len(invalid):
        problem = f"the class of element {invalid[0]} is {numbers[invalid[0]]:g}, which is no whole number"
        raise AssetError(problem, where=where)
    return numbers.astype(np.int64)


def _describe_shape(array: npt.NDArray[Any]) -> str:
    return f"{' x '.join(map(str, array.shape)) or 'no'} values of type {array.dtype}"


Up = Literal["y", "z"]
AlignMode = Literal["check", "box", "off"]
"""How points come into the frame of an asset: as they are if they fit, turned upright, scaled evenly and moved so that
the boxes fit, or as they are in any case."""
_TO_Z = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])  # points as rows, Y up, to those with Z up
_SLACK = 0.05  # of the diagonal of an asset: how far its box and that of its points may be apart at any side


def align_points(points: Floats, boxes: Sequence[Aabb], align: AlignMode, where: str, up: Up | None = None) -> Floats:
    """Return points (n, 3) in the frame of an asset; boxes: of its hulls, and of what it shows; where: their file; up:
    the axis of the asset that points up: where that is Y, points that do not fit have Z up, else Y.

    Raises AssetError where the box of the points fits none of them, with what would make it fit.
    """
    if align == "off" or _box_distance(points, boxes) <= _SLACK:
        return points
    fitted = [found for turn in (np.eye(3), _TO_Z.T if up == "y" else _TO_Z) for found in _fit(points @ turn, boxes)]
    best = min(fitted, key=lambda found: _box_distance(found, boxes), default=points)
    fits = _box_distance(best, boxes) <= _SLACK
    if fits and align == "box":
        return best
    own, other = _describe_box(Aabb.of_points(points)), _describe_box(boxes[0])
    problem = f"its points do not lie where the asset does: they are in a box {own}, the hulls in a box {other}"
    remedy = "They would fit with --align box." if fits else "Export them in the frame of the asset, in metres."
    raise AssetError(problem, where=where, remedy=remedy)


def _fit(points: Floats, boxes: Sequence[Aabb]) -> list[Floats]:
    """Points scaled and moved to the diagonal and the middle of each box."""
    own = Aabb.of_points(points)
    if not own.diagonal > 0:
        return []
    return [(points - own.center) * (box.diagonal / own.diagonal) + box.center for box in boxes]


def _box_distance(points: Floats, boxes: Sequence[Aabb]) -> float:
    """How far the box of points is from the nearest of some, as a share of its diagonal."""
    own = Aabb.of_points(points)
    return min(
        float(max(np.abs(own.min - box.min).max(), np.abs(own.max - box.max).max())) / box.diagonal for box in boxes
    )


def _describe_box(box: Aabb) -> str:
    size, middle = (" ".join(f"{x:.3g}" for x in values) for values in (box.size, box.center))
    return f"of {size} m around {middle}"
