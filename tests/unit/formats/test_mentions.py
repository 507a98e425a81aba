"""What files call their collision geometry besides its own names, and that nothing else depends on it."""

import pickle
from pathlib import Path

import pytest

from meshforge.batch import Preparation, apply_preparation, cut_hull
from meshforge.formats import read, save
from meshforge.symbolic import Geom, Mentions, SymbolicMesh
from tests.gltf_files import SceneFile
from tests.soups import box
from tests.unit.batch.families import obj

URDF = """<robot name="r"><link name="base">
<visual name="handle-7"><geometry><mesh filename="parts/original-1.obj"/></geometry><material name="brass"/></visual>
<visual name="front"><geometry><box size="1 2 3"/></geometry></visual>
<collision><geometry><mesh filename="parts/original-1.obj"/></geometry></collision>
<collision name="own"><geometry><box size="1 2 3"/></geometry></collision>
<collision><origin xyz="1 0 0"/><geometry><box size="1 2 3"/></geometry></collision>
</link><link name="arm">
<visual name="lid"><geometry><mesh filename="parts/original-1.obj"/></geometry><material name="steel"/></visual>
<collision><geometry><sphere radius="1"/></geometry></collision>
</link><joint name="j" type="fixed"><parent link="base"/><child link="arm"/></joint></robot>"""
MJCF = """<mujoco><default><default class="panel"><geom density="7"/></default></default>
<asset><mesh name="knob" file="parts/original-1.obj"/><material name="oak"/></asset>
<worldbody><geom name="floor" size="1"/>
<body name="b" childclass="panel"><geom type="mesh" mesh="knob" material="oak"/><geom size="1" material="oak"/>
<geom name="front" type="mesh" mesh="knob" contype="0" conaffinity="0"/></body>
<body name="c"><geom size="2"/><geom name="lid" type="mesh" mesh="knob" contype="0" conaffinity="0"/></body>
</worldbody></mujoco>"""
CUBE = obj({"cube": ((0, 0, 0), (1, 1, 1))})
TWO = obj({"rail": ((0, 0, 0), (1, 1, 1)), "wheel": ((3, 0, 0), (4, 1, 1))})


def of(path: Path) -> dict[str, Mentions]:
    return {geom.name: geom.mentions for geom in read(path).geoms}


def put(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def test_a_urdf_calls_collision_by_its_mesh_and_by_what_its_link_shows(tmp_path: Path) -> None:
    put(tmp_path, "parts/original-1.obj", CUBE)
    assert of(put(tmp_path, "r.urdf", URDF)) == {
        "base/geom0": (("group", "cube"), ("visual", "handle-7"), ("mesh", "original-1"), ("material", "brass")),
        "base/own": (("visual", "front"),),
        "base/geom2": (),
        "arm/geom0": (("shown", "lid"), ("shown", "original-1"), ("material", "steel")),
    }


def test_a_urdf_calls_the_pieces_of_a_mesh_by_their_groups(tmp_path: Path) -> None:
    put(tmp_path, "parts/original-1.obj", TWO)
    found = of(put(tmp_path, "r.urdf", URDF))
    assert [found[f"base/geom0#{k}"][0] for k in (0, 1)] == [("group", "rail"), ("group", "wheel")]


def test_an_mjcf_calls_geoms_by_mesh_class_and_material(tmp_path: Path) -> None:
    put(tmp_path, "parts/original-1.obj", CUBE)
    assert of(put(tmp_path, "m.xml", MJCF)) == {
        "world/floor": (),
        "b/geom0": (("visual", "front"), ("mesh", "knob"), ("class", "panel"), ("material", "oak")),
        "b/geom1": (("class", "panel"), ("shown", "front"), ("shown", "knob"), ("material", "oak")),
        "c/geom0": (("shown", "lid"), ("shown", "knob")),
    }


def test_a_gltf_file_calls_pieces_by_node_mesh_parent_and_the_materials_of_each(tmp_path: Path) -> None:
    file = SceneFile()
    file.tree["materials"] = [{"name": "wood"}, {"name": "brass"}, {"name": "unused"}]
    soups = [box(), box((5, 0, 0))]
    mesh = file.mesh(*(file.primitive(soup, material=k) for k, soup in enumerate(soups)), name="furniture")
    file.node("Drawer", children=[file.node("Cube", mesh=mesh)])
    path = tmp_path / "a.glb"
    path.write_bytes(file.glb())
    common = (("node", "Cube"), ("mesh", "furniture"), ("node", "Drawer"))
    assert of(path) == {"Cube#0": (*common, ("material", "wood")), "Cube#1": (*common, ("material", "brass"))}


def test_a_gltf_file_with_materials_that_are_not_there_is_read_all_the_same(tmp_path: Path) -> None:
    file = SceneFile()
    file.node("Cube", mesh=file.mesh(file.primitive(box(), material=7)))
    path = tmp_path / "a.glb"
    path.write_bytes(file.glb())
    assert of(path) == {"Cube": ()}


def test_an_obj_calls_pieces_by_their_materials_and_by_groups_in_objects(tmp_path: Path) -> None:
    text = CUBE.replace("f ", "usemtl brass handle\nf ", 1)
    assert of(put(tmp_path, "a.obj", text)) == {"cube": (("material", "brass handle"),)}
    grouped = CUBE.replace("o cube", "o thing\ng knob")
    assert of(put(tmp_path, "b.obj", grouped)) == {"thing": (("group", "knob"),)}
    assert of(put(tmp_path, "c.obj", TWO)) == {"rail": (), "wheel": ()}


def test_a_folder_keeps_the_names_that_files_have_inside(tmp_path: Path) -> None:
    put(tmp_path, "parts/one.obj", CUBE)
    put(tmp_path, "parts/two.obj", TWO)
    found = of(tmp_path / "parts")
    assert found == {"one": (("group", "cube"),), "two/rail": (), "two/wheel": ()}


def test_hulls_that_a_hull_was_split_into_are_called_as_it_was(tmp_path: Path) -> None:
    put(tmp_path, "parts/original-1.obj", CUBE)
    asset = read(put(tmp_path, "r.urdf", URDF))
    cut = cut_hull(asset, Preparation(), "base/own", (0, 0, 0), (1, 0, 0))
    made = {geom.name: geom.mentions for geom in apply_preparation(asset, cut).geoms}
    assert made["base/own#0"] == made["base/own#1"] == (("visual", "front"),)


@pytest.mark.parametrize("text", [URDF, MJCF])
def test_mentions_go_along_when_an_asset_is_sent_and_change_nothing_that_is_written(tmp_path: Path, text: str) -> None:
    put(tmp_path, "parts/original-1.obj", CUBE)
    path = put(tmp_path, "r.urdf" if text == URDF else "m.xml", text)
    asset = read(path)
    there = pickle.loads(pickle.dumps(asset))
    assert [geom.mentions for geom in there.geoms] == [geom.mentions for geom in asset.geoms]
    bare = asset.with_geoms(Geom(g.name, g.body, g.shape, g.parent, g.contact) for g in asset.geoms)
    for kind, one in (("told", asset), ("bare", bare)):
        save(SymbolicMesh.of(one), tmp_path / kind / path.name)
    assert (tmp_path / "told" / path.name).read_bytes() == (tmp_path / "bare" / path.name).read_bytes()
