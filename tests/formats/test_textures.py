"""One picture or base colour a mesh of a URDF (OBJ, Collada, glTF) goes along to glTF; read by trimesh."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image

from meshforge.formats import read
from tests.formats.test_beside_gltf import scene
from tests.gltf_validation import errors
from tests.loop.command import meshforge_here as meshforge

# A square of two materials: a picture on the left half, plain red on the right.
SHEET = """\
mtllib sheet.mtl
v 0 0 0
v 1 0 0
v 2 0 0
v 0 1 0
v 1 1 0
v 2 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 0.5
usemtl drawn
f 1/1 2/2 5/3 4/4
usemtl plain
f 2 3 6 5
"""
LIBRARY = "newmtl drawn\nKd 1 1 1\nmap_Kd pictures/ab.png\nnewmtl plain\nKd 1 0 0\n"
# The same square as Collada.
SHEET_DAE = """\
<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_images><image id="im"><init_from>pictures/ab.png</init_from></image></library_images>
<library_effects>
<effect id="e1"><profile_COMMON>
<newparam sid="su"><surface type="2D"><init_from>im</init_from></surface></newparam>
<newparam sid="sa"><sampler2D><source>su</source></sampler2D></newparam>
<technique sid="t"><lambert><diffuse><texture texture="sa" texcoord="UV"/></diffuse></lambert></technique>
</profile_COMMON></effect>
<effect id="e2"><profile_COMMON><technique sid="t"><lambert>
<diffuse><color>1 0 0 1</color></diffuse></lambert></technique></profile_COMMON></effect>
</library_effects>
<library_materials><material id="m1"><instance_effect url="#e1"/></material>
<material id="m2"><instance_effect url="#e2"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="18">0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0</float_array><technique_common>
<accessor source="#pa" count="6" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<source id="u"><float_array id="ua" count="8">0 0 1 0 1 1 0 0.5</float_array><technique_common>
<accessor source="#ua" count="4" stride="2"><param name="S" type="float"/><param name="T" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist material="one" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#u" offset="1" set="0"/><vcount>4</vcount><p>0 0 1 1 4 2 3 3</p></polylist>
<triangles material="two" count="2"><input semantic="VERTEX" source="#v" offset="0"/><p>1 2 5 1 5 4</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g">
<bind_material><technique_common>
<instance_material symbol="one" target="#m1"><bind_vertex_input semantic="UV" input_semantic="TEXCOORD" input_set="0"/>
</instance_material><instance_material symbol="two" target="#m2"/></technique_common></bind_material>
</instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
"""
ROBOT = """\
<robot name="r"><link name="base">
  <visual><origin xyz="0 0 1"/><geometry><mesh filename="{mesh}" scale="2 2 2"/></geometry></visual>
  <collision><geometry><box size="1 1 1"/></geometry></collision>
</link></robot>
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a URDF of a textured OBJ, one of a textured GLB, and that GLB."""
    (tmp_path / "pictures").mkdir()
    Image.fromarray(np.arange(48, dtype=np.uint8).reshape(4, 4, 3)).save(tmp_path / "pictures" / "ab.png")
    (tmp_path / "sheet.obj").write_text(SHEET)
    (tmp_path / "sheet.mtl").write_text(LIBRARY)
    (tmp_path / "obj.urdf").write_text(ROBOT.format(mesh="sheet.obj"))
    (tmp_path / "sheet.dae").write_text(SHEET_DAE)
    (tmp_path / "dae.urdf").write_text(ROBOT.format(mesh="sheet.dae"))
    scene().export(tmp_path / "scene.glb")  # type: ignore[no-untyped-call]
    (tmp_path / "glb.urdf").write_text(ROBOT.format(mesh="scene.glb"))
    return tmp_path


def gltf_pictures(path: Path) -> Iterator[tuple[Any, Any]]:
    """The textured meshes that trimesh finds, in the root frame, with their pictures."""
    opened = trimesh.load_scene(path, process=False)
    for node in opened.graph.nodes_geometry:
        place, name = opened.graph[node]
        mesh = opened.geometry[name].copy()
        if mesh.visual.kind == "texture" and mesh.visual.material.baseColorTexture is not None:
            mesh.apply_transform(place)
            yield mesh, mesh.visual.material.baseColorTexture


def sheet_places(points: Any, coordinates: Any) -> dict[tuple[float, ...], tuple[float, ...]]:
    """The texture coordinates by the points that have them."""
    rows = zip(np.round(points, 5).tolist(), np.round(coordinates, 5).tolist(), strict=True)
    return {tuple(point): tuple(place) for point, place in rows}


SHEET_PLACES = {(0.0, 0.0, 1.0): (0.0, 0.0), (2.0, 0.0, 1.0): (1.0, 0.0), (2.0, 2.0, 1.0): (1.0, 1.0)}
SHEET_PLACES[0.0, 2.0, 1.0] = (0.0, 0.5)


@pytest.mark.parametrize("kind", ["obj", "dae"])
def test_the_mesh_of_a_urdf_has_its_picture_in_a_glb(folder: Path, kind: str) -> None:
    told = meshforge("convert", f"{kind}.urdf", "out/a.glb", cwd=folder).err
    assert f"(sheet.{kind}) is shown with one picture or base colour a mesh" in told
    ((mesh, picture),) = gltf_pictures(folder / "out" / "a.glb")
    upright = np.column_stack([mesh.vertices[:, 0], -mesh.vertices[:, 2], mesh.vertices[:, 1]])  # glTF has Y up
    assert sheet_places(upright, mesh.visual.uv) == SHEET_PLACES  # trimesh counts v upwards
    assert np.array_equal(np.array(picture.convert("RGB")).ravel(), np.arange(48))
    colors = [m.visual.material.baseColorFactor for m in trimesh.load_scene(folder / "out" / "a.glb").geometry.values()]
    assert [255, 0, 0, 255] in [list(color) for color in colors if color is not None]
    assert not errors([folder / "out" / "a.glb"])[0]


@pytest.mark.parametrize("name", ["obj.urdf", "scene.glb"])
def test_a_stage_has_no_pictures_and_the_report_says_so(folder: Path, name: str) -> None:
    told = meshforge("convert", name, "out/a.usda", cwd=folder).err
    assert "(sheet.obj) is shown without these" in told or "(material, texture, TEXCOORD_0)" in told
    assert not read(folder / "out" / "a.usda").files


def test_a_textured_glb_in_a_urdf_goes_to_gltf_for_an_engine(folder: Path) -> None:
    meshforge("convert", "glb.urdf", "out/a.gltf", "--names", "unreal", cwd=folder)
    ((mesh, picture),) = [(m, p) for m, p in gltf_pictures(folder / "out" / "a.gltf") if p is not None]
    ((ring, was),) = gltf_pictures(folder / "scene.glb")
    assert picture.tobytes() == was.tobytes() and len(mesh.visual.uv) == len(ring.visual.uv)
    assert not errors([folder / "out" / "a.gltf"])[0]


def test_a_colour_of_the_description_goes_before_what_its_mesh_has(folder: Path) -> None:
    text = (folder / "obj.urdf").read_text()
    shown = '<material name="m"><color rgba="0 0 1 1"/></material></visual>'
    (folder / "blue.urdf").write_text(text.replace("</visual>", shown))
    told = meshforge("convert", "blue.urdf", "out/a.glb", cwd=folder).err
    assert "(sheet.obj) is shown with one" in told and not list(gltf_pictures(folder / "out" / "a.glb"))


@pytest.mark.parametrize(
    ("old", "new"), [("vt 1 1", "vt 1 x"), ("5/3", "5/9"), ("sheet.mtl", "none.mtl"), ("usemtl drawn", "usemtl other")]
)
def test_texture_coordinates_that_are_damaged_leave_the_shape(folder: Path, old: str, new: str) -> None:
    (folder / "sheet.obj").write_text(SHEET.replace(old, new))
    done = meshforge("convert", "obj.urdf", "out/a.glb", cwd=folder)
    assert done.code == 0 and not list(gltf_pictures(folder / "out" / "a.glb"))
    assert sum(len(surface.faces) for surface in read(folder / "out" / "a.glb").visuals) == 4


def test_a_missing_picture_leaves_the_colour(folder: Path) -> None:
    (folder / "pictures" / "ab.png").unlink()
    meshforge("convert", "obj.urdf", "out/a.glb", cwd=folder)
    assert len(read(folder / "out" / "a.glb").visuals) == 2
    assert not list(gltf_pictures(folder / "out" / "a.glb"))
