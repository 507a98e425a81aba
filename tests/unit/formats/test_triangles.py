"""Reading triangles of mesh files of every kind."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import RawSurface, read_triangles, split_into_pieces
from meshforge.geometry import Floats
from tests.gltf_files import SceneFile
from tests.mesh_files import KINDS, dae, wrl
from tests.soups import Soup, box, together

Write = Callable[[Soup], bytes]
PAIR = together(box(), box((3, 0, 0)))


def surfaces(path: Path, data: bytes) -> list[RawSurface]:
    path.write_bytes(data)
    return read_triangles(path)


def bounds(found: list[RawSurface]) -> list[list[float]]:
    points = np.concatenate([s.vertices[np.unique(s.faces)] for s in found])
    return [points.min(axis=0).round(6).tolist(), points.max(axis=0).round(6).tolist()]


def corners(found: list[RawSurface]) -> Floats:
    return np.concatenate([s.vertices[s.faces] for s in found])


@pytest.mark.parametrize(("suffix", "write"), KINDS.values(), ids=KINDS.keys())
def test_every_kind_of_file_gives_the_same_triangles(tmp_path: Path, suffix: str, write: Write) -> None:
    found = surfaces(tmp_path / f"a{suffix}", write(PAIR))
    assert np.array_equal(corners(found), PAIR[0][PAIR[1]])
    assert [round(p.shape.volume, 6) for p in split_into_pieces(found, name="a") if p.shape] == [1, 1]


def test_a_file_of_no_known_kind_is_refused(tmp_path: Path) -> None:
    with pytest.raises(AssetError, match=r"\.step is no mesh file that MeshForge reads"):
        surfaces(tmp_path / "a.step", b"ISO-10303-21;")


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(AssetError, match=r"gone\.stl: cannot be read: No such file"):
        read_triangles(tmp_path / "gone.stl")


def test_transforms_of_collada_nodes_are_applied_units_and_axes_are_not(tmp_path: Path) -> None:
    node = "<translate>5 0 0</translate><scale>1 1 -2</scale>"
    found = surfaces(tmp_path / "a.dae", dae(box(), unit=0.01, node=node))
    assert bounds(found) == [[5, 0, -2], [6, 1, 0]]
    assert [(s.name, s.unit) for s in found] == [("part", 0.01)]


def test_a_collada_geometry_may_stand_in_several_nodes(tmp_path: Path) -> None:
    twice = dae(box()).replace(
        b"</node>", b'<node><translate>3 0 0</translate><instance_geometry url="#g"/></node></node>'
    )
    assert bounds(surfaces(tmp_path / "a.dae", twice)) == [[0, 0, 0], [4, 1, 1]]


@pytest.mark.parametrize(("mode", "faces"), [(5, [[0, 1, 2], [3, 2, 1]]), (6, [[0, 1, 2], [0, 2, 3]])])
def test_strips_and_fans_of_gltf_are_cut_into_triangles(tmp_path: Path, mode: int, faces: list[list[int]]) -> None:
    quad = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.0]]), np.array([[0, 1, 2, 3]])
    scene = SceneFile()
    scene.node("quad", mesh=scene.mesh(scene.primitive(quad, mode=mode)))
    assert surfaces(tmp_path / "a.gltf", scene.gltf())[0].faces.tolist() == faces


@pytest.mark.parametrize("place", [b"translation 5 0 0", b"rotation 0 0 1 3.14", b"scale 2, 1 1", b"scale 1 1"])
def test_shapes_of_vrml_that_are_placed_are_refused(tmp_path: Path, place: bytes) -> None:
    start, end = b"#VRML V2.0 utf8\nDEF leg Transform { translation 0 0 0.0 rotation 0 0 1 0, scale 1 1 1 ", b" }"
    inner = wrl(box()).partition(b"Group {")[2].rpartition(b"}")[0]
    assert [s.name for s in surfaces(tmp_path / "a.wrl", start + inner + end)] == ["leg"]
    with pytest.raises(AssetError, match=f"a shape has a {place.split()[0].decode()}, which is not read"):
        surfaces(tmp_path / "a.wrl", start + place + inner + end)
