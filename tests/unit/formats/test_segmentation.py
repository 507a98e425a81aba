"""Reading segmented points; each wrong input has one message."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import is_asset
from meshforge.formats.segmentation import is_segmentation, points_beside, read_segmentation

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
FACES = np.array([[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]])
HEAD = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n{}"
ROWS = "0 0 0{}\n1 0 0{}\n0 1 0{}\n0 0 1{}\n"


def ply(*, vertex: str = "", labels: tuple[str, ...] = ("",) * 4, rest: str = "end_header\n") -> str:
    """A PLY of four points; rest: all after the properties of vertices, up to their rows."""
    return HEAD.format(vertex) + rest + ROWS.format(*labels)


def put(folder: Path, text: str, name: str = "a.points.ply") -> Path:
    path = folder / name
    path.write_text(text)
    return path


def arrays(folder: Path, **given: object) -> Path:
    path = folder / "a.points.npz"
    np.savez(path, **given)  # type: ignore[arg-type]
    return path


def array(folder: Path, given: object) -> Path:
    """One array alone, under the name of an archive."""
    path = folder / "a.points.npz"
    with path.open("wb") as stream:
        np.save(stream, given)  # type: ignore[arg-type]
    return path


@pytest.mark.parametrize("name", ["label", "labels", "scalar_Label", "part_id", "segment", "semantic", "pred", "class"])
def test_a_ply_has_the_class_of_each_point_in_a_property_of_such_a_name(tmp_path: Path, name: str) -> None:
    text = ply(vertex=f"property uchar red\nproperty int {name}\n", labels=(" 9 0", " 9 1", " 9 1", " 9 -1"))
    found = read_segmentation(put(tmp_path, text))
    assert found.classes.tolist() == [0, 1, 1, -1] and not found.names
    assert np.array_equal(found.points, POINTS)


def test_a_ply_of_points_may_count_no_faces(tmp_path: Path) -> None:
    rest = "element face 0\nproperty list uchar int vertex_indices\nend_header\n"
    found = read_segmentation(put(tmp_path, ply(vertex="property float label\n", labels=(" 5",) * 4, rest=rest)))
    assert found.classes.tolist() == [5, 5, 5, 5]


def test_arrays_have_points_labels_and_names(tmp_path: Path) -> None:
    found = read_segmentation(arrays(tmp_path, points=POINTS, labels=[0, 1, 1, 2], names=["a", "", "c"]))
    assert found.classes.tolist() == [0, 1, 1, 2] and np.array_equal(found.points, POINTS)
    assert found.class_names() == {0: "a", 2: "c"}
    assert found.class_names(["x", "y"]) == {0: "x", 1: "y"}
    found = read_segmentation(arrays(tmp_path, Coord=POINTS.astype("f4"), pred=np.arange(4.0)[:, None], names=[b"x"]))
    assert found.classes.tolist() == [0, 1, 2, 3] and found.class_names() == {0: "x"}


def bomb(folder: Path) -> Path:
    """An archive whose directory says that an array in it takes four gigabytes."""
    path = arrays(folder, points=POINTS, labels=[0] * 4)
    data = bytearray(path.read_bytes())
    size = data.index(b"PK\1\2") + 24
    data[size : size + 4] = (0xFFFFFFFE).to_bytes(4, "little")
    path.write_bytes(data)
    return path


Make = Callable[[Path], Path]
UNREADABLE = "these arrays cannot be read: the file is damaged, of another kind, or holds Python objects"
OF_FACES = "it has faces, and only points with a class each are read"
LABEL, TRIANGLES = "property int label\n", "element face 1\nproperty list uchar int vertex_indices\nend_header\n"

REFUSED: dict[str, tuple[Make, str]] = {
    "colours alone": (
        lambda d: put(d, ply(vertex="property uchar red\n", labels=(" 1",) * 4)),
        "it has no labels, but points, red, x, y, z",
    ),
    "a class that is NaN": (
        lambda d: put(d, ply(vertex="property float label\n", labels=(" 1", " nan", " 1", " 1"))),
        "the class of element 1 is nan, which is no whole number",
    ),
    "a point that is infinite": (
        lambda d: arrays(d, points=np.where(POINTS == 1, np.inf, POINTS), labels=[0] * 4),
        "a coordinate is not a finite number",
    ),
    "wrong lengths": (lambda d: arrays(d, points=POINTS, labels=[0, 1]), "it has 4 points, but 2 classes"),
    "a mesh with a class a face": (lambda d: arrays(d, vertices=POINTS, faces=FACES, labels=[0] * 4), OF_FACES),
    "a mesh in a PLY": (
        lambda d: put(d, ply(vertex=LABEL, labels=(" 5",) * 4, rest=TRIANGLES) + "3 0 1 2\n"),
        OF_FACES,
    ),
    "no labels": (lambda d: arrays(d, points=POINTS), "it has no labels, but points"),
    "chances": (lambda d: arrays(d, points=POINTS, labels=np.ones((4, 3))), "its classes are 4 x 3 values of type"),
    "objects": (lambda d: arrays(d, points=POINTS, labels=np.array([{}] * 4)), UNREADABLE),
    "one array": (lambda d: array(d, np.zeros((4, 4))), UNREADABLE),
    "no archive": (lambda d: put(d, "PK\3\4hello", "a.points.npz"), UNREADABLE),
    "an archive that unpacks to gigabytes": (bomb, "its arrays would take 4,096 MiB, more than the 512 MiB"),
    "an array of NumPy": (lambda d: put(d, "x", "a.points.npy"), ".npy is no kind of segmented points"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_a_wrong_file_has_one_message(tmp_path: Path, case: str) -> None:
    make, problem = REFUSED[case]
    path = make(tmp_path)
    with pytest.raises(AssetError) as told:
        read_segmentation(path)
    assert told.value.where == str(path) and told.value.problem.startswith(problem)
    assert case not in ("no labels", "an array of NumPy") or "np.savez" in str(told.value.remedy)


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    for name in ("a.ply", "a.npz"):
        with pytest.raises(AssetError, match="cannot be read: No such file"):
            read_segmentation(tmp_path / name)


# Places


def test_segmented_points_beside_an_asset_are_no_asset(tmp_path: Path) -> None:
    path = put(tmp_path, ply(vertex="property int label\n", labels=(" 1",) * 4), "table.points.ply")
    assert is_segmentation(path) and not is_asset(path)
    assert not is_segmentation(tmp_path / "points.ply")
    assert points_beside(tmp_path / "table.labels.json") == path
    assert points_beside(tmp_path / "chair.labels.json") is None
