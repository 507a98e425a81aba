"""Meshes out of the objects that people hold: trimesh, MjSpec and the text of an MJCF, Usd.Stage; and back."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
import trimesh

import meshforge as mf
from tests.mesh_files import obj
from tests.unit.rendering.scenes import table

MODEL = """<mujoco model="lamp">
  <!-- a comment -->
  <worldbody>
    <body name="stand" pos="0 0 1">
      <geom name="pole" type="cylinder" size="0.05 0.5"/>
      <geom name="foot" type="box" size="0.2 0.2 0.05" pos="0 0 -0.5"/>
    </body>
  </worldbody>
</mujoco>
"""
WEDGE = obj((np.eye(4)[:, :3], np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))).decode()
WITH_MESH = (
    '<mujoco model="part"><compiler meshdir="meshes"/><asset><mesh name="wedge" file="wedge.obj"/></asset>'
    '<worldbody><body name="b"><geom name="g" type="mesh" mesh="wedge"/>'
    '<geom name="h" type="box" size="1 1 1"/></body></worldbody></mujoco>'
)


def drop(mesh: mf.SymbolicMesh, name: str) -> mf.SymbolicMesh:
    return mesh.with_hulls(hull for hull in mesh if hull.name != name)


# trimesh


def test_a_mesh_of_trimesh_becomes_hulls_and_saves(tmp_path: Path) -> None:
    one = trimesh.creation.box((1, 1, 1))
    points, faces = (
        np.concatenate([one.vertices, one.vertices + np.array([3, 0, 0])]),
        np.concatenate([one.faces, one.faces + 8]),
    )
    two = trimesh.Trimesh(points, faces)
    mesh = mf.from_trimesh({"shelf": two}, labels={"shelf#0": "left"})
    assert [(hull.name, hull.label) for hull in mesh] == [("shelf#0", "left"), ("shelf#1", None)]
    assert [hull.volume for hull in mesh] == pytest.approx([1, 1])
    mf.save(mesh, tmp_path / "shelf.urdf")
    assert len(mf.load(tmp_path / "shelf.urdf").hulls) == 2


def test_a_scene_is_read_where_its_nodes_put_it() -> None:
    scene = trimesh.Scene()
    flipped = np.diag([-2.0, 1, 1, 1])
    flipped[0, 3] = 5
    scene.add_geometry(trimesh.creation.box((1, 1, 1)), node_name="near")
    scene.add_geometry(trimesh.creation.box((1, 1, 1)), node_name="far", transform=flipped)
    scene.add_geometry(trimesh.PointCloud(np.zeros((3, 3))), node_name="points")  # type: ignore[no-untyped-call]
    mesh = mf.from_trimesh(scene)
    assert {hull.name for hull in mesh} == {"near", "far"}
    assert mesh["far"].aabb.min.tolist() == [4, -0.5, -0.5] and mesh["far"].volume == pytest.approx(2)


def test_what_is_not_convex_is_an_opaque_piece() -> None:
    mesh = mf.from_trimesh(trimesh.creation.torus(1, 0.2))
    assert mesh.hulls == () and mesh.asset and len(mesh.asset.non_convex) == 1 and mesh.asset.non_convex[0].reason


@pytest.mark.parametrize("thing", [3, "table.obj", None])
def test_what_is_no_mesh_of_trimesh_is_refused(thing: Any) -> None:
    with pytest.raises(mf.MeshForgeError, match="is no mesh of trimesh"):
        mf.from_trimesh(thing)
    with pytest.raises(mf.MeshForgeError, match="no triangle"):
        mf.from_trimesh([])


def test_hulls_become_meshes_of_trimesh_and_come_back() -> None:
    mesh = table()
    one = mesh["left"].to_trimesh()
    assert one.is_watertight and one.volume == pytest.approx(mesh["left"].volume)
    assert one.metadata == {"name": "left", "body": "body", "label": "panel"}
    one.vertices[0] = 9  # a copy: the hull does not change
    assert mesh["left"].vertices.max() < 1
    scene = mesh.to_trimesh()
    assert set(scene.geometry) == set(mesh.index)
    back = mf.from_trimesh(scene)
    assert set(back.index) == set(mesh.index)
    assert all(back[hull.name].aabb.max == pytest.approx(hull.aabb.max) for hull in mesh)
    assert back["leg1"].volume == pytest.approx(mesh["leg1"].volume, rel=0.01)  # a primitive gives its triangles


def test_a_mesh_of_trimesh_is_decomposed() -> None:
    made = mf.decompose(
        trimesh.creation.box((2, 1, 1)), mf.VhacdSettings(resolution=5000, max_convex_hulls=1), cache=False
    )
    assert len(made.hulls) == 1


# MuJoCo


def test_the_text_of_an_mjcf_is_loaded_and_saved_as_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    mesh = mf.load(MODEL, labels={"stand/pole": "pole"})
    assert list(mesh.index) == ["stand/pole", "stand/foot"] and mesh["stand/pole"].label == "pole"
    mf.save(mesh, "same.xml")
    assert Path("same.xml").read_text() == MODEL
    mf.save(drop(mesh, "stand/foot"), "out/lamp.xml")
    text = Path("out/lamp.xml").read_text()
    assert "<!-- a comment -->" in text and "foot" not in text


def test_text_finds_its_files_from_the_current_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes/wedge.obj").write_text(WEDGE)
    monkeypatch.chdir(tmp_path)
    mesh = mf.load(WITH_MESH)
    assert mesh["b/g"].volume == pytest.approx(1 / 6)
    mf.save(drop(mesh, "b/h"), "out/part.xml")
    assert (tmp_path / "out/meshes/wedge.obj").read_text() == WEDGE


def test_text_that_is_no_mjcf_is_refused() -> None:
    with pytest.raises(mf.MeshForgeError, match=r"text\.xml:1: is no MJCF: its root element is <robot>"):
        mf.load('<robot name="r"/>')
    with pytest.raises(mf.MeshForgeError, match=r"text\.xml"):
        mf.load("<mujoco>")


def test_a_spec_is_loaded_edited_and_given_back() -> None:
    spec = mujoco.MjSpec.from_string(MODEL)
    spec.body("stand").add_geom(name="bulb", type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.1, 0, 0], pos=[0, 0, 0.6])
    mesh = mf.load(spec)
    assert list(mesh.index) == ["stand/pole", "stand/foot", "stand/bulb"]
    edited = drop(mesh, "stand/foot").to_mjspec()
    assert [geom.name for geom in edited.geoms] == ["pole", "bulb"]
    assert edited.compile().ngeom == 2
    assert len(spec.geoms) == 3  # the one that was given does not change


def test_a_spec_with_files_in_memory_keeps_them() -> None:
    spec = mujoco.MjSpec.from_string(WITH_MESH, assets={"wedge.obj": WEDGE.encode()})
    mesh = mf.load(spec)
    assert mesh["b/g"].volume == pytest.approx(1 / 6)
    model = drop(mesh, "b/h").to_mjspec().compile()
    assert (model.ngeom, model.nmesh) == (1, 1)


def test_a_spec_of_a_file_finds_the_files_beside_that(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes/wedge.obj").write_text(WEDGE)
    (tmp_path / "part.xml").write_text(WITH_MESH)
    spec = mujoco.MjSpec.from_file(str(tmp_path / "part.xml"))
    monkeypatch.chdir("/")
    mesh = mf.load(spec)
    assert mesh["b/g"].volume == pytest.approx(1 / 6)
    assert mesh.to_mjspec().compile().nmesh == 1


def test_a_mesh_of_another_format_becomes_a_spec(tmp_path: Path) -> None:
    mf.save(table(), tmp_path / "table.urdf")
    for mesh in (mf.load(tmp_path / "table.urdf"), table()):
        model = mesh.to_mjspec().compile()
        assert model.ngeom == 5


def test_what_nothing_can_be_loaded_from_is_refused() -> None:
    with pytest.raises(mf.MeshForgeError, match="a Trimesh is nothing that an asset is read from"):
        mf.load(trimesh.creation.box())
    with pytest.raises(mf.MeshForgeError, match="a int is nothing"):
        mf.load(3)  # type: ignore[arg-type]


# USD


def stage_of_boxes() -> Any:
    from pxr import Usd, UsdGeom, UsdPhysics

    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/crate").GetPrim())
    for k, name in enumerate(("left", "right")):
        cube = UsdGeom.Cube.Define(stage, f"/crate/{name}")
        cube.AddTranslateOp().Set((3.0 * k, 0, 0))
        UsdPhysics.CollisionAPI.Apply(cube.GetPrim())
    return stage


def test_a_stage_in_memory_is_loaded_and_saved(tmp_path: Path) -> None:
    pytest.importorskip("pxr")
    mesh = mf.load(stage_of_boxes())
    assert [hull.aabb.size.tolist() for hull in mesh] == [[2, 2, 2], [2, 2, 2]]
    assert mesh.asset and "flattened" in mesh.asset.notes[0]
    mf.save(drop(mesh, mesh.hulls[1].name), tmp_path / "crate.usda")
    assert len(mf.load(tmp_path / "crate.usda").hulls) == 1


def test_a_stage_of_a_file_is_read_from_it_unless_it_has_changed(tmp_path: Path) -> None:
    usd = pytest.importorskip("pxr.Usd")
    path = tmp_path / "crate.usda"
    made = stage_of_boxes()  # its layers go with it
    made.GetRootLayer().Export(str(path))
    stage = usd.Stage.Open(str(path))
    mesh = mf.load(stage)
    assert mesh.asset and mesh.asset.path == path
    mf.save(drop(mesh, mesh.hulls[1].name), tmp_path / "out/crate.usda")
    assert stage.GetPrimAtPath("/crate/right") and not stage.GetRootLayer().dirty  # it is not what was edited
    before = path.read_bytes()
    stage.RemovePrim("/crate/right")
    changed = mf.load(stage)
    assert len(changed.hulls) == 1 and changed.asset and changed.asset.path != path
    assert path.read_bytes() == before


def test_what_was_put_into_folders_for_libraries_goes_when_the_process_ends(tmp_path: Path) -> None:
    code = (
        "import mujoco, meshforge as mf, sys\n"
        "mesh = mf.load(mujoco.MjSpec.from_string(sys.argv[1], assets={'wedge.obj': sys.argv[2].encode()}))\n"
        "print(mesh.asset.path, mesh.asset.path.is_file())"
    )
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    words = [sys.executable, "-c", code, WITH_MESH, WEDGE]
    done = subprocess.run(words, capture_output=True, text=True, check=True, env=environment)
    assert done.stdout.split()[1] == "True" and list(tmp_path.iterdir()) == []
