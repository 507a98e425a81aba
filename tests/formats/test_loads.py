"""Files of every format, edited or not, as the readers at hand load them; `script/loads` asks more of them for more."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np
import pytest

from tests.loads.assets import Made, made
from tests.loads.comparing import differences
from tests.loads.readers import DIRECTIONS, READERS, Reader, Seen
from tests.loads.readers.base import Place, box, capsule, cylinder, ellipsoid, hull

ASSETS = ("cart", "crowd", "cup", "doors", "legs", "opaque", "primitives")
SUFFIXES = (".urdf", ".xml", ".sdf", ".glb", ".usda", ".obj", ".stl", ".ply", "")
HERE = ("mujoco", "pybullet", "usd", "trimesh", "yourdfpy", "drake")
EXACT = Reader("any", "any", "any", {".x": "shape", ".y": "file"}, lambda _: iter(()))


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> list[Made]:
    return [one for one in made(tmp_path_factory.mktemp("loads"), ASSETS, SUFFIXES) if isinstance(one, Made)]


def found(reader: Reader, path: Path) -> list[Seen]:
    return [seen for file in (sorted(path.iterdir()) if path.is_dir() else [path]) for seen in reader.shapes(file)]


@pytest.mark.slow
@pytest.mark.parametrize("name", HERE)
def test_a_reader_finds_the_shapes_of_each_file_where_meshforge_has_them(name: str, files: list[Made]) -> None:
    reader = READERS[name]
    if importlib.util.find_spec(reader.module.partition(".")[0]) is None:
        pytest.skip(f"{reader.title} is not installed (pip install {reader.package})")
    own = [one for one in files if reader.grain(one.suffix) and not one.has_hidden_hulls]
    assert len(own) > len(ASSETS)
    for one in own:
        if (one.suffix, one.asset) in reader.limits:
            continue
        assert differences(one.shapes, found(reader, one.path), reader, one.suffix) == [], one.path


def test_every_edit_changes_what_is_there(files: list[Made]) -> None:
    whole, edited = ({(one.asset, one.suffix): one.shapes for one in files if one.edited == k} for k in (False, True))
    assert whole.keys() == edited.keys()
    assert all(differences(shapes, edited[key], EXACT, ".x") for key, shapes in whole.items())


WEDGE = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 0.5]])
UP = np.array([0.0, 0, 1])
NOWHERE = Place(np.eye(3), np.zeros(3))


def test_shapes_that_are_moved_turned_scaled_mirrored_or_missing_are_told() -> None:
    ours = [hull(WEDGE, NOWHERE), box((1, 2, 3), Place(np.eye(3), np.array([5.0, 0, 0])))]
    middle = (WEDGE.min(axis=0) + WEDGE.max(axis=0)) / 2
    for wrong in (
        WEDGE + 1e-3 * UP,
        WEDGE[:, [1, 2, 0]],
        WEDGE * 1.001,
        (WEDGE - middle) * [-1, 1, 1] + middle,  # within the same box
    ):
        (told,) = differences(ours, [ours[1], hull(wrong, NOWHERE)], EXACT, ".x")
        assert "too far along" in told
    assert differences(ours, ours[::-1], EXACT, ".x") == []
    assert differences(ours, ours[:1], EXACT, ".x") == ["1 shapes instead of 2"]
    assert differences(ours[:1], ours, EXACT, ".x") == ["2 shapes instead of 1"]
    assert differences([], [], EXACT, ".x") == []


def test_a_reader_that_makes_one_shape_of_a_file_is_held_against_all_of_it() -> None:
    ours = [hull(WEDGE, NOWHERE), box((1, 2, 3), Place(np.eye(3), np.array([5.0, 0, 0])))]
    whole = Seen("mesh", tuple(np.maximum(ours[0].reach, ours[1].reach).tolist()))
    assert differences(ours, [whole], EXACT, ".y") == []
    assert differences(ours, ours[:1], EXACT, ".y") != []


def test_native_shapes_reach_as_far_as_their_corners() -> None:
    turned = Place.of_quaternion((1, 2, 3), (0.1, 0.2, 0.3, 0.9))
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-2, 2) for z in (-3, 3)])
    assert np.allclose(box((1, 2, 3), turned).reach, hull(corners, turned).reach)
    ways = DIRECTIONS @ turned.rotation
    ball = ways * 0.5
    assert np.allclose(ellipsoid(0.5, turned).reach, hull(ball, turned).reach)
    ends = np.concatenate([ball + 2 * UP, ball - 2 * UP])
    assert np.allclose(capsule(0.5, 2, turned).reach, hull(ends, turned).reach)
    rims = ways * [1, 1, 0] / np.linalg.norm(ways * [1, 1, 0], axis=1)[:, None] * 0.5
    ends = np.concatenate([rims + 2 * UP, rims - 2 * UP])
    assert np.allclose(cylinder(0.5, 2, turned).reach, hull(ends, turned).reach)
