"""Points or faces with a class each, as some other tool left them: where such files lie beside an asset, and what their
classes are called.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
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
POINTS_MARK = ".points"
"""What their names end with before the suffix: `table.points.npz`."""


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
    candidates = (place.with_name(f"{stem}{POINTS_MARK}{suffix}") for suffix in POINTS_SUFFIXES)
    return next((path for path in candidates if path.is_file()), None)


def is_segmentation(path: Path) -> bool:
    """Whether a file is one of segmented points of some asset by its name, `table.points.ply`."""
    return path.suffix.lower() in POINTS_SUFFIXES and Path(path.stem).suffix.lower() == POINTS_MARK


_NUMBERED = re.compile(r"(-?\d+)\s*[\s:,=]\s*(\S.*)")
_COMMENT = re.compile(r"comment\s+(?:label|class|part|segment)\s+(-?\d+)\s*[\s:,=]\s*(\S.*)", re.I)
_LIST = re.compile(r"comment\s+(?:labels|classes|parts|segments|names)\s*[:=]?\s*(\S.*)", re.I)

SEMANTICS_FILE = "semantics.txt"
"""The name of such a file."""
_REMEDY = "Each line has a link, the kind of its joint and what it is: link_0 hinge rotation_door."


def read_class_names(path: Path) -> dict[int, str]:
    """The names of classes in a text file, by their number: a name a line, or `3 drawer`, with the number before it.

    Raises AssetError: it cannot be read, or says a number twice, or some lines have one and some have none.
    """
    lines = [line.strip() for line in _read_lines(path, "the names of classes")]
    numbered = [(k, found) for k, line in enumerate(lines) if (found := _NUMBERED.fullmatch(line))]
    count = sum(map(bool, lines))
    if numbered and len(numbered) < count:
        problem = f"{pluralize(len(numbered), 'line')} of {count} begin with a number"
        raise AssetError(problem, where=str(path), remedy="Number all classes, or none.")
    if not numbered:
        return {k: line for k, line in enumerate(lines) if line}
    names: dict[int, str] = {}
    for k, found in numbered:
        number = int(found[1])
        if number in names:
            raise AssetError(f"class {number} is named twice", where=f"{path}:{k + 1}", remedy="Keep one of them.")
        names[number] = found[2]
    return names


def class_files(path: Path) -> tuple[Path, Path]:
    """Where the names of the classes in a file may lie beside it, the first that is there counts."""
    return path.with_name(f"{path.stem.removesuffix(POINTS_MARK)}.classes.txt"), path.with_name("classes.txt")


def find_class_names(found: Segmentation, path: Path, given: Sequence[str] = ()) -> Mapping[int, str]:
    """The names of classes by their number: those given, of 0, 1, ..., else those in the file, else those beside it.

    Raises AssetError for a file of names that cannot be read.
    """
    beside = (read_class_names(file) for file in class_files(path) if file.is_file())
    return dict(enumerate(given)) or found.names or next(beside, {})


def _read_lines(path: Path, what: str) -> list[str]:
    try:
        return path.read_text(encoding="utf-8-sig").splitlines()
    except OSError as error:
        raise AssetError(f"{what} cannot be read ({error.strerror})", where=str(path)) from error
    except UnicodeDecodeError as error:
        raise AssetError(f"{what} are not UTF-8 text", where=str(path)) from error


def parse_comments(lines: Iterable[str]) -> dict[int, str]:
    """The names of classes in header lines: `comment label 3 drawer`, or `comment classes drawer, handle`."""
    names: dict[int, str] = {}
    for line in lines:
        if found := _COMMENT.fullmatch(line.strip()):
            names[int(found[1])] = found[2].strip()
        elif found := _LIST.fullmatch(line.strip()):
            names |= number_names([name.strip() for name in found[1].split(",")])
    return names


def number_names(names: Sequence[str]) -> dict[int, str]:
    """Names by their place; an empty one is none."""
    return {k: name for k, name in enumerate(names) if name}


@dataclass(frozen=True, slots=True)
class LinkSemantics:
    """What a link is; joint: the kind of the joint that carries it, as the file says it (`hinge`, `slider`, ...)."""

    link: str
    joint: str
    name: str


def read_semantics(path: Path) -> tuple[LinkSemantics, ...]:
    """The links that a file lists, in its order.

    Raises AssetError with the line: it cannot be read, a line of other than three words, a link listed twice.
    """
    found: dict[str, LinkSemantics] = {}
    for number, line in enumerate(_read_lines(path, "the semantics"), start=1):
        words = line.split()
        if not words:
            continue
        if len(words) != 3:
            problem = f"this line has {len(words)} words, not three: {line.strip()[:60]!r}"
            raise AssetError(problem, where=f"{path}:{number}", remedy=_REMEDY)
        if words[0] in found:
            problem = f"the link {words[0]!r} is listed twice"
            raise AssetError(problem, where=f"{path}:{number}", remedy="Keep one line.")
        found[words[0]] = LinkSemantics(*words)
    if not found:
        raise AssetError("it lists no link", where=str(path), remedy=_REMEDY)
    return tuple(found.values())
