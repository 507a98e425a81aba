"""What is seen stays: USD stages in which nothing is marked as collision, edited through the command line and read by
USD's own library."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import trimesh

from meshforge.formats import read, save
from meshforge.symbolic import Asset
from tests.gltf_files import KHR, tree_of
from tests.loop.command import meshforge_here as meshforge
from tests.usd_stages import complaints, mesh, physics_shapes, specs, stage, written

PROGRAM = "Is(leg) => Each(Replace(capsule, native))\nIs(top) => Scale(Z, 2)\n"
LABELS = '{"hulls": {"Table/leg": "leg", "top": "top", "drop": "leg"}}'


def ring() -> str:
    """The attributes of a Mesh that is a torus, which is no hull."""
    torus = trimesh.creation.torus(3, 1, major_sections=12, minor_sections=8)
    points = ", ".join(str(tuple(map(float, point))) for point in torus.vertices.round(6) + 0.0)
    corners = ", ".join(str(int(k)) for k in torus.faces.ravel())
    counts = ", ".join(["3"] * len(torus.faces))
    return (
        f"point3f[] points = [{points}]\nint[] faceVertexCounts = [{counts}]\nint[] faceVertexIndices = [{corners}]\n"
    )


def scene() -> str:
    """A table of a moved group and a sphere, a ring above, and a drop that falls; in centimetres."""
    tall = 'float3 xformOp:scale = (1, 2, 5)\nuniform token[] xformOpOrder = ["xformOp:scale"]'
    drop = "double3 xformOp:translate.timeSamples = { 0: (9, 0, 9), 1: (9, 0, 0) }\n"
    drop += 'uniform token[] xformOpOrder = ["xformOp:translate"]'
    group = f'def Xform "Table"\n{{\n# a leg of oak\n{mesh("leg", more=tall)}\n}}\n'
    ball = 'def Sphere "top"\n{\ndouble radius = 2  # of glass\ncolor3f[] primvars:displayColor = [(1, 0, 0)]\n}\n'
    parts = f"{group}{ball}{mesh('ring', points=ring())}{mesh('drop', more=drop)}"
    return stage(f'def Xform "World"\n{{\n{parts}\n}}\n', metres=0.01)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    written(tmp_path, scene(), "in/scene.usda")
    (tmp_path / "in" / "scene.labels.json").write_text(LABELS)
    (tmp_path / "p.mf").write_text(PROGRAM)
    return tmp_path


def assert_seen_alike(source: Path, out: Path) -> None:
    """Every spec of the source is in the root layer of the output, with the same fields."""
    before, after = specs(source), specs(out)
    assert {path: after.get(path) for path in before} == before


def marks(path: Path) -> dict[str, tuple[str | None, str]]:
    """The approximation and the purpose of each collider, by its path."""
    from pxr import Usd, UsdGeom, UsdPhysics

    found: dict[str, tuple[str | None, str]] = {}
    opened = Usd.Stage.Open(str(path))
    for prim in opened.Traverse():
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            mesh_api = UsdPhysics.MeshCollisionAPI(prim) if prim.HasAPI(UsdPhysics.MeshCollisionAPI) else None
            how = mesh_api.GetApproximationAttr().Get() if mesh_api else None
            found[str(prim.GetPath())] = (how, UsdGeom.Imageable(prim).ComputePurpose())
    return found


def shapes(asset: Asset) -> dict[str, Any]:
    return {geom.name: geom.shape for geom in asset.geoms}


@pytest.mark.parametrize("suffix", [".usda", ".usdc", ".usdz"])
def test_an_edit_leaves_what_is_seen_and_marks_its_hulls_beside_it(folder: Path, suffix: str) -> None:
    source = folder / "in" / "scene.usda"
    if suffix != ".usda":
        source = save(read(source), folder / "in" / f"scene{suffix}").path
    told = meshforge("apply", "p.mf", f"in/scene{suffix}", "--out", "out", cwd=folder).out
    assert "what is seen stays, and the hulls are beside it as colliders of UsdPhysics" in told
    out = folder / "out" / source.name
    if suffix != ".usdz":
        assert_seen_alike(source, out)
    assert marks(out) == {
        "/World/collision/leg": (None, "guide"),
        "/World/collision/top": ("convexHull", "guide"),
        "/World/collision/ring": ("none", "guide"),
        "/World/collision/drop": (None, "guide"),
    }
    after = read(out)
    assert sorted(shapes(after)) == ["Table/leg", "drop", "top"]
    assert [piece.name for piece in after.non_convex] == ["ring"] and len(after.visuals) == 4
    assert shapes(after)["Table/leg"].kind == "capsule"
    assert "an animation moves /World/drop: hulls stay where that is at the first moment" in told
    assert len(physics_shapes(out)) == 4 and complaints(out) == complaints(source)


def test_a_second_run_reads_the_marked_hulls_and_does_not_double_them(folder: Path) -> None:
    meshforge("apply", "p.mf", "in/scene.usda", "--out", "out", cwd=folder)
    first = folder / "out" / "scene.usda"
    meshforge("convert", "out/scene.usda", "copy.usda", "--collision", "beside", "--names", "usd", cwd=folder)
    assert (folder / "copy.usda").read_bytes() == first.read_bytes()
    told = meshforge("apply", "p.mf", "out/scene.usda", "--out", "again", cwd=folder).out
    assert "beside" not in told
    again = folder / "again" / "scene.usda"
    assert len(marks(again)) == len(marks(first)) == 4
    assert_seen_alike(folder / "in" / "scene.usda", again)


def test_what_comes_from_a_shared_instance_stays_shared(tmp_path: Path) -> None:
    part = stage(f'def Xform "Part"\n{{\n{mesh("block")}\n}}\n', default="Part")
    written(tmp_path, part, "part.usda")
    two = "".join(
        f'def "p{k}" (\n instanceable = true\n prepend references = @./part.usda@\n)\n{{\n'
        f"double3 xformOp:translate = ({4 * k}, 0, 0)\n"
        'uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
        for k in range(2)
    )
    source = written(tmp_path, stage(f'def Xform "World"\n{{\n{two}\n}}\n'), "in.usda")
    meshforge("convert", "in.usda", "out/in.usda", "--names", "usd", cwd=tmp_path)
    out = tmp_path / "out" / "in.usda"
    assert_seen_alike(source, out)
    assert sorted(shapes(read(out))) == ["p0/block", "p1/block"]
    assert (tmp_path / "out" / "part.usda").read_text() == part


def test_replace_marks_every_prim_that_is_a_hull(folder: Path) -> None:
    (folder / "p.mf").write_text("Is(top) => Replace(box)\n")
    meshforge("apply", "p.mf", "in/scene.usda", "--out", "out", "--collision", "replace", cwd=folder)
    assert marks(folder / "out" / "scene.usda") == {
        "/World/Table/leg": ("convexHull", "default"),
        "/World/ring": ("none", "default"),
        "/World/drop": ("convexHull", "default"),
        "/World/top_2": (None, "default"),
    }
    after = read(folder / "out" / "scene.usda")
    assert sorted(shapes(after)) == ["Table/leg", "drop", "top_2"] and len(after.non_convex) == 1


def test_a_stage_becomes_a_glb_that_shows_it_and_has_its_hulls_beside(folder: Path) -> None:
    meshforge("convert", "in/scene.usda", "scene.glb", cwd=folder)
    shown = trimesh.load_scene(folder / "scene.glb", process=False)
    assert len(shown.graph.nodes_geometry) == 4
    tree = tree_of((folder / "scene.glb").read_bytes())
    assert sum(KHR in node.get("extensions", {}) for node in tree["nodes"]) == 4
    assert [m["pbrMetallicRoughness"]["baseColorFactor"] for m in tree["materials"]] == [[1, 0, 0, 1]]
    meshforge("convert", "scene.glb", "back.usda", cwd=folder)
    assert {how for how, _ in marks(folder / "back.usda").values()} == {None, "convexHull", "none"}
