"""One convex hull for each collision element, whatever pieces its mesh has, in every format that has elements."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from meshforge.batch import Preparation, apply_preparation, decompose_asset, find_sources
from meshforge.formats import load, read, save
from meshforge.geometry import CoacdSettings, HullSettings, Polytope
from meshforge.symbolic import Asset, SymbolicMesh
from tests.unit.cli.in_process import Run
from tests.urdf_sample import boxes_obj, corner_obj

APART = (((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), ((4.0, 0.0, 0.0), (5.0, 1.0, 1.0)))


def corner_and_boxes() -> str:
    """An OBJ of three pieces: two boxes that are apart, and a corner that is no hull, 3 by 3 by 1 around the middle."""
    lines = boxes_obj(*APART).splitlines()
    moved = [
        "f " + " ".join(str(int(word) + 16) for word in line.split()[1:]) if line.startswith("f ") else line
        for line in corner_obj().splitlines()
    ]
    return "\n".join([*lines, *moved]) + "\n"


def hull_of(path: Path) -> tuple[float, set[tuple[float, ...]]]:
    """The volume of the convex hull of an OBJ by Qhull, and its corners."""
    points = np.array([line.split()[1:4] for line in path.read_text().splitlines() if line.startswith("v ")], float)
    found = ConvexHull(points)
    return found.volume, {tuple(points[k]) for k in found.vertices}


def write_robot(folder: Path) -> Path:
    """Two links of that mesh, the second turned and scaled, and a box."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "cad.obj").write_text(corner_and_boxes())
    path = folder / "cad.urdf"
    path.write_text(
        '<robot name="cad">\n  <!-- kept -->\n  <link name="base">\n'
        '    <collision><geometry><mesh filename="cad.obj"/></geometry></collision>\n'
        '    <collision><geometry><box size="1 2 3"/></geometry></collision>\n  </link>\n  <link name="lid">\n'
        '    <collision name="top"><origin xyz="0 0 2" rpy="0 0 1"/><geometry><mesh filename="cad.obj" scale="2 1 1"/>'
        '</geometry><friction mu="0.4"/></collision>\n  </link>\n'
        '  <joint name="j" type="fixed"><parent link="base"/><child link="lid"/></joint>\n</robot>\n'
    )
    return path


def hulled(asset: Asset) -> Asset:
    return apply_preparation(asset, decompose_asset(asset, Preparation(), HullSettings()).preparation)


def test_each_collision_element_is_the_convex_hull_of_its_mesh(tmp_path: Path) -> None:
    asset = read(write_robot(tmp_path))
    made = hulled(asset)
    volume, corners = hull_of(tmp_path / "cad.obj")
    assert made.non_convex == ()
    assert [(geom.name, geom.body) for geom in made.geoms] == [
        ("base/geom1", "base"), ("base/geom0", "base"), ("lid/top", "lid")
    ]  # fmt: skip
    base, lid = made.geoms[1].shape, made.geoms[2].shape
    assert isinstance(base, Polytope) and {tuple(corner) for corner in base.vertices.tolist()} == corners
    assert (base.volume, lid.volume) == pytest.approx((volume, 2 * volume))


def test_pieces_are_sources_of_their_own_for_engines_that_divide(tmp_path: Path) -> None:
    asset = read(write_robot(tmp_path))
    assert [(one.kind, one.what) for one in find_sources(asset)] == [
        ("opaque", "base/geom0#2"), ("opaque", "lid/top#2")
    ]  # fmt: skip
    assert [(one.kind, one.what) for one in find_sources(asset, asset)] == [
        ("element", "base/geom0"), ("element", "lid/top")
    ]  # fmt: skip


def test_an_element_of_which_a_piece_is_prepared_already_is_no_source(tmp_path: Path) -> None:
    asset = read(write_robot(tmp_path))
    voxels = decompose_asset(asset, Preparation(), CoacdSettings(resolution=200, mcts_iterations=20, mcts_nodes=8))
    again = decompose_asset(asset, voxels.preparation, HullSettings())
    assert again.made == () and len(voxels.made) == 2
    anew = decompose_asset(asset, voxels.preparation, HullSettings(), again=True)
    assert [entry.what for entry in anew.made] == ["base/geom0", "lid/top"]


@pytest.mark.parametrize("suffix", [".obj", ".glb", ".usda", ".sdf", ".stl", ".ply"])
def test_a_mesh_of_any_format_becomes_one_hull(tmp_path: Path, suffix: str) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "cad.obj").write_text(corner_and_boxes())
    asset = read(_write_whole(tmp_path / "in" / "cad.obj", suffix))
    made = hulled(asset)
    volume, _ = hull_of(tmp_path / "in" / "cad.obj")
    assert made.non_convex == () and [geom.shape.volume for geom in made.geoms] == pytest.approx([volume])
    saved = save(SymbolicMesh.of(made), tmp_path / "out" / f"cad{suffix}")
    again = load(saved.path)
    assert [hull.volume for hull in again.hulls] == pytest.approx([volume], rel=1e-5)


def _write_whole(obj: Path, suffix: str) -> Path:
    """The mesh of an OBJ as the one collision mesh of a file."""
    import trimesh

    path = obj.with_suffix(suffix)
    mesh = trimesh.load_mesh(obj, process=False)
    if suffix == ".sdf":
        path.write_text(
            '<sdf version="1.8"><model name="m"><link name="l"><collision name="c"><geometry><mesh><uri>cad.obj</uri>'
            "</mesh></geometry></collision></link></model></sdf>"
        )
    elif suffix == ".usda":
        from pxr import Usd, UsdGeom, UsdPhysics

        stage = Usd.Stage.CreateNew(str(path))
        UsdGeom.SetStageMetersPerUnit(stage, 1.0)
        made = UsdGeom.Mesh.Define(stage, "/cad")
        made.CreatePointsAttr(mesh.vertices.tolist())
        made.CreateFaceVertexCountsAttr([3] * len(mesh.faces))
        made.CreateFaceVertexIndicesAttr(mesh.faces.ravel().tolist())
        UsdPhysics.CollisionAPI.Apply(made.GetPrim())
        UsdPhysics.MeshCollisionAPI.Apply(made.GetPrim()).CreateApproximationAttr("none")
        stage.Save()
    elif suffix != ".obj":
        mesh.export(path)
    return path


def test_the_command_line_makes_a_hull_of_each_mesh_and_undoes_it(run: Run, tmp_path: Path) -> None:
    write_robot(tmp_path / "in")
    told = run("new", "p", "in/cad.urdf", "--decompose", "hull", "--workers", "1")
    assert told.code == 0 and "2 pieces into 2 hulls" in told.out
    names = [hull["name"] for hull in run("info", "cad.urdf", "--project", "p", "--json").json["hulls"]]
    assert names == ["base/geom1", "base/geom0", "lid/top"]
    assert run("prepare", "p", "--decompose", "hull", "--workers", "1").out == "cad.urdf: nothing new\n"
    assert run("prepare", "p", "cad.urdf", "--undo").code == 0
    assert len(run("info", "cad.urdf", "--project", "p", "--json").json["non_convex"]) == 2


def test_one_hull_of_a_mesh_file_is_written_and_nothing_is_divided_by_it(run: Run, tmp_path: Path) -> None:
    write_robot(tmp_path)
    assert run("decompose", "cad.obj", "-o", "one.obj", "--decompose", "hull").code == 0
    (hull,) = load("one.obj").hulls
    assert hull.volume == pytest.approx(hull_of(tmp_path / "cad.obj")[0])
    assert run("new", "p", "cad.urdf").code == 0
    refused = run("prepare", "p", "--rebuild-spanning", "--decompose", "hull")
    assert refused.code == 2 and "--decompose hull divides nothing" in refused.err
    wrong = run("decompose", "cad.obj", "-o", "two.obj", "--decompose", "hull", "--set", "a=1")
    assert "max_hull_vertices=0" in wrong.err
