"""Reading segmented points and meshes, names of classes, and PartNet's semantics; each wrong input has one message."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import is_asset
from meshforge.formats.segmentation.base import (
    LinkSemantics,
    Segmentation,
    is_segmentation,
    points_beside,
    read_class_names,
    read_semantics,
)
from meshforge.formats.segmentation.reader import attach_own_mesh, read_segmentation
from tests.mesh_files import obj, stl_binary
from tests.soups import box

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
FACES = np.array([[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3], [0, 1, 2]])
HEAD = "ply\nformat ascii 1.0\n{}element vertex 4\nproperty float x\nproperty float y\nproperty float z\n{}"
ROWS = "0 0 0{}\n1 0 0{}\n0 1 0{}\n0 0 1{}\n"


def ply(
    *, comments: str = "", vertex: str = "", labels: tuple[str, ...] = ("",) * 4, rest: str = "end_header\n"
) -> str:
    """A PLY of four points; rest: all after the properties of vertices, up to their rows."""
    return HEAD.format(comments, vertex) + rest + ROWS.format(*labels)


def put(folder: Path, text: str, name: str = "a.points.ply") -> Path:
    path = folder / name
    path.write_text(text)
    return path


def arrays(folder: Path, **given: object) -> Path:
    path = folder / "a.points.npz"
    np.savez(path, **given)  # type: ignore[arg-type]
    return path


def array(folder: Path, given: object) -> Path:
    path = folder / "a.points.npy"
    np.save(path, given)  # type: ignore[arg-type]
    return path


def classes(found: Segmentation) -> list[int]:
    return [int(k) for k in found.classes]


@pytest.mark.parametrize(
    "name", ["label", "labels", "scalar_Label", "part_id", "segmentID", "semantic", "pred", "class_id"]
)
def test_a_ply_has_the_class_of_each_vertex_in_a_property_of_such_a_name(tmp_path: Path, name: str) -> None:
    text = ply(vertex=f"property uchar red\nproperty int {name}\n", labels=(" 9 0", " 9 1", " 9 1", " 9 -1"))
    found = read_segmentation(put(tmp_path, text))
    assert classes(found) == [0, 1, 1, -1]
    assert found.vertices is not None and np.array_equal(found.vertices, POINTS)
    assert not len(found.faces) and not found.of_faces and not found.names


def test_classes_of_faces_count_before_those_of_vertices_and_polygons_hand_on_theirs(tmp_path: Path) -> None:
    rest = "element face 2\nproperty list uchar int vertex_indices\nproperty float label\nend_header\n"
    text = ply(vertex="property int label\n", labels=(" 5",) * 4, rest=rest) + "4 0 1 2 3 7\n3 0 1 2 8\n"
    found = read_segmentation(put(tmp_path, text))
    assert classes(found) == [7, 7, 8] and found.of_faces and len(found.faces) == 3


def test_a_ply_with_as_many_faces_as_vertices_knows_whose_classes_are(tmp_path: Path) -> None:
    rest = "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    rows = "".join(f"3 {a} {b} {c}\n" for a, b, c in FACES[:4])
    found = read_segmentation(put(tmp_path, ply(vertex="property int seg\n", labels=(" 5",) * 4, rest=rest) + rows))
    assert not found.of_faces and len(found.faces) == 4


@pytest.mark.parametrize(
    ("comments", "names"),
    [
        ("comment label 0 drawer\ncomment label 3: door handle\n", {0: "drawer", 3: "door handle"}),
        ("comment classes drawer, handle,, leg\n", {0: "drawer", 1: "handle", 3: "leg"}),
        ("comment made by hand\n", {}),
    ],
)
def test_names_of_classes_stand_in_comments(tmp_path: Path, comments: str, names: dict[int, str]) -> None:
    text = ply(comments=comments, vertex="property int label\n", labels=(" 0",) * 4)
    assert read_segmentation(put(tmp_path, text)).names == names


def test_arrays_have_points_or_a_mesh(tmp_path: Path) -> None:
    found = read_segmentation(arrays(tmp_path, points=POINTS, labels=[0, 1, 1, 2], names=["a", "b", "c"]))
    assert classes(found) == [0, 1, 1, 2] and found.names == {0: "a", 1: "b", 2: "c"}
    found = read_segmentation(arrays(tmp_path, Vertices=POINTS, faces=FACES, part_labels=np.arange(5.0)[:, None]))
    assert classes(found) == [0, 1, 2, 3, 4] and found.of_faces
    found = read_segmentation(arrays(tmp_path, xyz=POINTS, triangles=FACES, seg=np.arange(4), classes=np.array([b"x"])))
    assert classes(found) == [0, 1, 2, 3] and not found.of_faces and found.names == {0: "x"}


def test_one_array_has_points_with_their_class_or_classes_alone(tmp_path: Path) -> None:
    found = read_segmentation(array(tmp_path, np.column_stack([POINTS, [1, 2, 3, -1]])))
    assert classes(found) == [1, 2, 3, -1] and found.vertices is not None
    kind = [("x", "f4"), ("y", "f4"), ("z", "f4"), ("label", "i4")]
    found = read_segmentation(array(tmp_path, np.array([(0, 1, 2, 5)], dtype=kind)))
    assert classes(found) == [5] and found.vertices is not None and found.vertices.tolist() == [[0, 1, 2]]
    found = read_segmentation(array(tmp_path, np.array([3, 4])))
    assert classes(found) == [3, 4] and found.vertices is None


def lying(folder: Path, name: str) -> Path:
    """Points of which the header counts far more than there are, alone or in an archive."""
    rows = io.BytesIO()
    header = {"descr": "<f8", "fortran_order": False, "shape": (2_000_000_000, 4)}
    np.lib.format.write_array_header_1_0(rows, header)
    rows.write(bytes(320))
    path = folder / name
    if path.suffix == ".npy":
        path.write_bytes(rows.getvalue())
    else:
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("points.npy", rows.getvalue())
    return path


def bomb(folder: Path) -> Path:
    """An archive whose directory says that an array in it takes four gigabytes."""
    path = arrays(folder, points=POINTS, labels=[0] * 4)
    data = bytearray(path.read_bytes())
    size = data.index(b"PK\1\2") + 24
    data[size : size + 4] = (0xFFFFFFFE).to_bytes(4, "little")
    path.write_bytes(data)
    return path


Make = Callable[[Path], Path]
RECIPE = 'Write it so: np.savez("NAME.points.npz", points=xyz, labels=classes, names=["drawer", "handle"])'
UNREADABLE = f"these arrays cannot be read: the file is damaged, of another kind, or holds Python objects\n  {RECIPE}"


def torn(folder: Path, old: bytes, new: bytes) -> Path:
    """An array in whose header something is another text."""
    path = array(folder, np.array([3, 4]))
    path.write_bytes(path.read_bytes().replace(old, new))
    return path


REFUSED: dict[str, tuple[Make, str]] = {
    "a header that does not end": (lambda d: torn(d, b"(2,)", b"(2,("), UNREADABLE),
    "a length that is no whole number": (lambda d: torn(d, b"(2,)", b"'2'"), UNREADABLE),
    "colours alone": (
        lambda d: put(d, ply(vertex="property uchar red\n", labels=(" 1",) * 4)),
        "no property of this file is a class by its name: it has red\n"
        "  Export the class of each point or face as a number, called `label`; colours are not read.",
    ),
    "coordinates alone": (
        lambda d: put(d, ply()),
        "no property of this file is a class by its name: it has none but coordinates\n"
        "  Export the class of each point or face as a number, called `label`; colours are not read.",
    ),
    "no row": (
        lambda d: put(d, HEAD.format("", "property int label\nend_header\n").replace("vertex 4", "vertex 0")),
        "there is nothing in this file that has a class",
    ),
    "a class that is NaN": (
        lambda d: put(d, ply(vertex="property float label\n", labels=(" 1", " nan", " 1", " 1"))),
        "the class of element 1 is nan, which is no whole number",
    ),
    "half a class": (
        lambda d: arrays(d, points=POINTS, labels=[0, 1, 1.5, 2]),
        "the class of element 2 is 1.5, which is no whole number",
    ),
    "a point that is infinite": (
        lambda d: arrays(d, points=np.where(POINTS == 1, np.inf, POINTS), labels=[0] * 4),
        "a coordinate is not a finite number\n  Fix or export it again.",
    ),
    "wrong lengths": (
        lambda d: arrays(d, points=POINTS, labels=[0, 1]),
        "it has 4 points, but 2 classes\n  Each point needs one, or each face.",
    ),
    "wrong lengths of a mesh": (
        lambda d: arrays(d, vertices=POINTS, faces=FACES, labels=[0, 1]),
        "it has 4 points and 5 faces, but 2 classes\n  Each point needs one, or each face.",
    ),
    "as many faces as vertices": (
        lambda d: arrays(d, vertices=POINTS, faces=FACES[:4], labels=[0] * 4),
        "it has 4 vertices and as many faces, so that it is open whose the classes are\n"
        "  Leave the faces out if the classes are of vertices.",
    ),
    "a face beyond": (
        lambda d: arrays(d, vertices=POINTS, faces=FACES + 1, labels=[0] * 5),
        "a face names a vertex that is not there",
    ),
    "no points": (
        lambda d: arrays(d, labels=[0], other=[1]),
        f"it has no array points (or vertices), but labels, other\n  {RECIPE}",
    ),
    "no labels": (lambda d: arrays(d, points=POINTS), f"it has no array labels, but points\n  {RECIPE}"),
    "chances": (
        lambda d: arrays(d, points=POINTS, labels=np.ones((4, 3))),
        "its classes are 4 x 3 values of type float64, not one whole number each",
    ),
    "flat points": (
        lambda d: arrays(d, points=POINTS[:, :2], labels=[0] * 4),
        "its points are 4 x 2 values of type float64, not three numbers each",
    ),
    "faces of floats": (
        lambda d: arrays(d, points=POINTS, faces=FACES / 2, labels=[0] * 4),
        "its faces are 5 x 3 values of type float64, not three numbers of vertices each",
    ),
    "nothing": (
        lambda d: arrays(d, points=np.zeros((0, 3)), labels=np.zeros(0, int)),
        "there is nothing in this file that has a class",
    ),
    "objects": (lambda d: array(d, np.array([{}, {}])), UNREADABLE),
    "no array": (lambda d: put(d, "hello", "a.points.npy"), UNREADABLE),
    "no archive": (lambda d: put(d, "PK\3\4hello", "a.points.npz"), UNREADABLE),
    "two thousand million points": (lambda d: lying(d, "a.points.npy"), UNREADABLE),
    "as many in an archive": (lambda d: lying(d, "a.points.npz"), UNREADABLE),
    "an archive that unpacks to gigabytes": (
        bomb,
        "its arrays would take 4,096 MiB, more than the 512 MiB that are read\n  Thin the points out.",
    ),
    "a picture": (
        lambda d: array(d, np.zeros((4, 5, 3))),
        f"it has 4 x 5 x 3 numbers, where a class each is expected, or x, y, z and a class each\n  {RECIPE}",
    ),
    "other fields": (
        lambda d: array(d, np.array([(0, 1)], dtype=[("x", "f4"), ("label", "i4")])),
        f"it needs the fields x, y, z and label, it has x, label\n  {RECIPE}",
    ),
    "another kind": (
        lambda d: put(d, "x", "a.pcd"),
        ".pcd is no kind of segmented points\n  It is one of .ply, .npz, .npy.",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_a_wrong_file_has_one_message(tmp_path: Path, case: str) -> None:
    make, message = REFUSED[case]
    path = make(tmp_path)
    with pytest.raises(AssetError) as told:
        read_segmentation(path)
    assert told.value.message == f"{path}: {message}"


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    for name in ("a.ply", "a.npz"):
        with pytest.raises(AssetError, match="cannot be read: No such file"):
            read_segmentation(tmp_path / name)


# Classes of the asset's own mesh


def test_classes_without_points_are_of_the_mesh_of_the_asset(tmp_path: Path) -> None:
    vertices, faces = box()
    (tmp_path / "a.obj").write_bytes(obj((vertices, faces)))
    (tmp_path / "a.stl").write_bytes(stl_binary((vertices, faces)))
    for name in ("a.obj", "a.stl"):
        own = attach_own_mesh(Segmentation(np.arange(len(faces))), tmp_path / name, "x.npy")
        assert own.of_faces and own.vertices is not None
        assert np.array_equal(own.vertices[own.faces], vertices[faces].astype(np.float32))
        assert classes(own) == list(range(len(faces)))
    own = attach_own_mesh(Segmentation(np.arange(len(vertices))), tmp_path / "a.obj", "x.npy")
    assert not own.of_faces and classes(own) == list(range(len(vertices)))


def test_polygons_hand_their_class_to_their_triangles(tmp_path: Path) -> None:
    text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\nf 1 2 5\n"
    own = attach_own_mesh(Segmentation(np.array([4, 9])), put(tmp_path, text, "a.obj"), "x.npy")
    assert classes(own) == [4, 4, 9]


@pytest.mark.parametrize(
    ("name", "count", "message"),
    [
        ("a.obj", 3, "it has 3 classes, a.obj has 12 faces and 8 vertices"),
        ("a.urdf", 12, "it has classes without points, and a.urdf is no mesh file to which they could belong"),
    ],
)
def test_classes_of_another_mesh_are_refused_with_a_recipe(tmp_path: Path, name: str, count: int, message: str) -> None:
    (tmp_path / name).write_bytes(obj(box()))
    with pytest.raises(AssetError) as told:
        attach_own_mesh(Segmentation(np.zeros(count, dtype=np.int64)), tmp_path / name, "x.npy")
    assert told.value.problem == message and "np.savez(" in (told.value.remedy or "")


# Names of classes


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("drawer\ndoor handle\n\nleg", {0: "drawer", 1: "door handle", 3: "leg"}),
        ("0 drawer\n7: leg\n\n", {0: "drawer", 7: "leg"}),
        ("3,drawer\n", {3: "drawer"}),
        ("", {}),
    ],
)
def test_names_of_classes_in_a_file(tmp_path: Path, text: str, names: dict[int, str]) -> None:
    assert read_class_names(put(tmp_path, text, "classes.txt")) == names


def test_names_of_classes_that_make_no_sense(tmp_path: Path) -> None:
    with pytest.raises(AssetError, match="1 line of 2 begin with a number"):
        read_class_names(put(tmp_path, "0 drawer\nleg\n", "classes.txt"))
    with pytest.raises(AssetError, match=r"classes\.txt:2: class 0 is named twice"):
        read_class_names(put(tmp_path, "0 drawer\n0 leg\n", "classes.txt"))
    (tmp_path / "classes.txt").write_bytes(b"\xff\xfe\xff")
    with pytest.raises(AssetError, match="are not UTF-8 text"):
        read_class_names(tmp_path / "classes.txt")


# PartNet


def test_semantics_tell_what_links_are(tmp_path: Path) -> None:
    text = "link_0 hinge rotation_door\n\n  link_1   heavy furniture_body \n"
    expected = (LinkSemantics("link_0", "hinge", "rotation_door"), LinkSemantics("link_1", "heavy", "furniture_body"))
    assert read_semantics(put(tmp_path, text, "semantics.txt")) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("link_0 hinge\n", r"semantics.txt:1: this line has 2 words, not three: 'link_0 hinge'"),
        ("a b c\na b d\n", r"semantics.txt:2: the link 'a' is listed twice"),
        ("\n", r"semantics.txt: it lists no link"),
    ],
)
def test_semantics_that_make_no_sense(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(AssetError, match=message):
        read_semantics(put(tmp_path, text, "semantics.txt"))


# Places


def test_segmented_points_beside_an_asset_are_no_asset(tmp_path: Path) -> None:
    path = put(tmp_path, ply(vertex="property int label\n", labels=(" 1",) * 4), "table.points.ply")
    assert is_segmentation(path) and not is_asset(path)
    assert not is_segmentation(tmp_path / "points.ply")
    assert points_beside(tmp_path / "table.labels.json") == path
    assert points_beside(tmp_path / "chair.labels.json") is None
