"""The whole loop on real glTF chairs: five texts and two GLBs, 5 to 9 hulls each, two demonstrations."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
import trimesh

from meshforge.formats import load
from tests.corpus_path import corpus
from tests.gltf_validation import errors
from tests.loop.command import meshforge_here as meshforge
from tests.loop.labels import write_labels
from tests.loop.readme import parse_commands
from tests.urdf_engines import mujoco_model

Parts = dict[str, tuple[int, ...]]
SLATS: Parts = {"leg": (1, 2, 3, 4), "back": (5, 6, 7, 8)}
BOARD: Parts = {"leg": (1, 2, 3, 4), "back": (5, 6, 7)}
ROUND: Parts = {"leg": (0, 2, 3, 4), "back": (5, 6, 7)}
CHAIRS: dict[str, Parts] = {
    "furniture/chair_A.gltf": SLATS,
    "furniture/chair_A_wood.gltf": SLATS,
    "furniture/chair_B.gltf": BOARD,
    "furniture/chair_B_wood.gltf": BOARD,
    "furniture/chair_stool.gltf": {"leg": (1, 2, 3, 4)},
    "restaurant/chair_A.glb": ROUND,
    "restaurant/chair_B.glb": ROUND,
}
COMMANDS = """
meshforge new chairs 'assets/**/*.gl*' --vocabulary seat,leg,back
meshforge label chairs --with file
meshforge demonstrate chairs furniture/chair_A.gltf 'chair_A#[1234] => Each(Replace(box))' 'chair_A#[5678] => Merge'
meshforge demonstrate chairs restaurant/chair_B.glb 'chair_B#[0234] => Each(Replace(box))' 'chair_B#[567] => Merge'
meshforge synthesize chairs
meshforge apply chairs
"""
PROGRAM = """\
labels seat, leg, back

Is(leg)  => Each(Replace(box))
Is(back) => Merge
"""


@pytest.fixture(scope="module")
def chairs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the assets, and a project that has learned from two of them and was applied to all."""
    folder = tmp_path_factory.mktemp("chairs")
    for name, parts in CHAIRS.items():
        family, _, file = name.partition("/")
        source = corpus("chairs", f"KayKit-{family.capitalize()}-Bits-1.0", file).with_suffix(".gltf")
        target = folder / "assets" / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if target.suffix == ".glb":
            meshforge("convert", source, target, cwd=folder)
        else:
            for beside in (source, source.with_suffix(".bin"), *source.parent.glob("*.png")):
                shutil.copyfile(beside, target.parent / beside.name)
        write_labels(target, parts, rest="seat")
    for words in parse_commands(COMMANDS):
        meshforge(*words, cwd=folder)
    return folder


def both(chairs: Path, name: str) -> tuple[Path, Path]:
    return chairs / "assets" / name, chairs / "chairs" / "edited" / name


def test_two_chairs_teach_the_program(chairs: Path) -> None:
    assert (chairs / "chairs" / "program.mf").read_text() == PROGRAM


@pytest.mark.parametrize("name", list(CHAIRS))
def test_every_chair_comes_back_with_four_boxes_one_back_and_its_seat(chairs: Path, name: str) -> None:
    before, after = (load(path) for path in both(chairs, name))
    back = int("back" in CHAIRS[name])
    labels = [str(hull.label) for hull in after.hulls]
    assert sorted(labels) == ["back"] * back + ["leg"] * 4 + ["seat"]
    seat = next(hull for hull in after.hulls if hull.label == "seat")
    was = before.hull_of(seat.name).shape
    np.testing.assert_array_equal([seat.shape.aabb.min, seat.shape.aabb.max], [was.aabb.min, was.aabb.max])
    assert seat.shape.volume == pytest.approx(was.volume, rel=1e-6)
    assert sum(len(hull.vertices) == 8 for hull in after.hulls) == 4


@pytest.mark.parametrize("name", list(CHAIRS))
def test_the_edited_file_is_valid_and_the_chair_looks_as_it_did(chairs: Path, name: str) -> None:
    source, out = both(chairs, name)
    assert errors([out])[0] <= errors([source])[0]
    before, after = (trimesh.load_scene(path, process=False) for path in (source, out))
    (node,) = after.graph.nodes_geometry
    whole, now = (scene.geometry[scene.graph[node][1]] for scene in (before, after))
    assert now.visual.material.name == whole.visual.material.name
    np.testing.assert_array_equal(now.visual.uv, whole.visual.uv)
    np.testing.assert_array_equal(now.vertices, whole.vertices)
    np.testing.assert_array_equal(now.faces, whole.faces)


@pytest.mark.parametrize("name", ["furniture/chair_A.gltf", "restaurant/chair_B.glb"])
def test_mujoco_loads_the_edited_chair_as_an_mjcf_made_of_it(chairs: Path, name: str, tmp_path: Path) -> None:
    _, out = both(chairs, name)
    meshforge("convert", out, tmp_path / "chair.xml", cwd=tmp_path)  # MuJoCo reads no glTF itself
    model = mujoco_model(tmp_path / "chair.xml")
    assert model.ngeom - 1 == len(load(out).hulls) == 6  # and the chair, to be seen
    assert sorted(model.geom_contype.tolist()) == [0] + [1] * 6
    meshforge("convert", out, tmp_path / "chair.obj", cwd=tmp_path)
    volume = sum(hull.volume for hull in load(out).hulls)
    assert trimesh.load_scene(tmp_path / "chair.obj").volume == pytest.approx(volume, rel=1e-5)


def test_bytes_that_the_edit_does_not_touch_are_as_they_were(chairs: Path) -> None:
    source, out = both(chairs, "furniture/chair_B.gltf")
    for beside in (source.with_suffix(".bin"), source.parent / "furniturebits_texture.png"):
        assert (out.parent / beside.name).read_bytes() == beside.read_bytes()
    text = source.read_text()
    for first, last in (("materials", "meshes"), ("textures", "accessors"), ("samplers", "buffers")):
        assert text[text.index(f'"{first}"') : text.index(f'"{last}"')] in out.read_text()
