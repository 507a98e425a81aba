"""Meshes that a file calls convex and that are not: read as the hulls that engines make of them, and told so."""

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from meshforge.formats import read
from meshforge.geometry import Floats, Ints
from tests.soups import Soup, angle, box, together
from tests.unit.cli.in_process import Run

L_FILLS = "71%"  # 5 of 7: the hull of the L adds half of its inner square
WORDS = "fills {} of its hull"


def write_obj(path: Path, soup: Soup, group: str = "part") -> Path:
    lines = [f"g {group}", *(f"v {x} {y} {z}" for x, y, z in soup[0]), *(f"f {a} {b} {c}" for a, b, c in soup[1] + 1)]
    path.write_text("\n".join(lines) + "\n")
    return path


def write_nodes(path: Path, meshes: Mapping[str, Soup], parents: Sequence[str] = ()) -> Path:
    """A scene of meshes by the names of their nodes; parents: nodes that hold each a box."""
    scene: Any = trimesh.Scene()
    for own, (vertices, faces) in meshes.items():
        scene.add_geometry(trimesh.Trimesh(vertices, faces, process=False), node_name=own, geom_name=own)
    for parent in parents:
        scene.graph.update(parent, matrix=np.eye(4))
        scene.add_geometry(trimesh.Trimesh(*box(), process=False), node_name=f"in {parent}", parent_node_name=parent)
    scene.export(path)
    return path


def unreal(folder: Path, soup: Soup) -> Path:
    return write_nodes(folder / "part.glb", {"Part": box(), "UCX_Part_00": soup})


def godot(folder: Path, soup: Soup) -> Path:
    return write_nodes(folder / "part.glb", {"Part": box(), "Part2-convcolonly": soup})


def sdf(folder: Path, soup: Soup) -> Path:
    write_obj(folder / "part.obj", soup)
    mesh = '<mesh optimization="convex_hull"><uri>part.obj</uri></mesh>'
    inside = f'<link name="base"><collision name="c"><geometry>{mesh}</geometry></collision></link>'
    (folder / "part.sdf").write_text(f'<sdf version="1.11"><model name="m">{inside}</model></sdf>')
    return folder / "part.sdf"


def mjcf(folder: Path, soup: Soup) -> Path:
    write_obj(folder / "part.obj", soup)
    assets = '<asset><mesh name="part" file="part.obj"/></asset>'
    text = f'<mujoco>{assets}<worldbody><geom type="mesh" mesh="part"/></worldbody></mujoco>'
    (folder / "part.xml").write_text(text)
    return folder / "part.xml"


def usd(folder: Path, soup: Soup) -> Path:
    vertices, faces = soup
    (folder / "part.usda").write_text(
        f"""#usda 1.0
(metersPerUnit = 1)
def Mesh "Part" (prepend apiSchemas = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"]) {{
    uniform token physics:approximation = "convexHull"
    int[] faceVertexCounts = {[3] * len(faces)}
    int[] faceVertexIndices = {faces.ravel().tolist()}
    point3f[] points = {[tuple(v) for v in vertices.tolist()]}
}}
"""
    )
    return folder / "part.usda"


Writer = Callable[[Path, Soup], Path]
every_mark = pytest.mark.parametrize("write", [unreal, godot, sdf, mjcf, usd])


def notes_of(path: Path) -> list[str]:
    return [note for note in read(path).notes if note.startswith("not convex")]


@every_mark
def test_a_mesh_that_is_marked_convex_and_is_not_says_how_full_it_is(write: Writer, tmp_path: Path) -> None:
    path = write(tmp_path, angle())
    asset = read(path)
    assert (len(asset.geoms), len(asset.non_convex)) == (1, 0)
    assert asset.geoms[0].shape.volume == pytest.approx(7)
    assert asset.geoms[0].fill == pytest.approx(5 / 7, abs=1e-5)
    (note,) = notes_of(path)
    assert WORDS.format(L_FILLS) in note


@every_mark
def test_a_mesh_that_is_marked_convex_and_is_has_no_note(write: Writer, tmp_path: Path) -> None:
    vertices, faces = box()
    rough: Floats = vertices + np.where(vertices == 1, 0.01, 0.0) * vertices[:, ::-1]  # a box that is a little bent
    two: Soup = together(box(), box((1, 0, 0)))  # which make one box
    for soup in ((vertices, faces), (rough, faces), two):
        assert notes_of(write(tmp_path, soup)) == []


@every_mark
def test_a_mesh_marked_convex_that_is_open_says_that_its_share_is_not_known(write: Writer, tmp_path: Path) -> None:
    vertices, faces = angle()
    gaps: Ints = np.delete(faces, [0, 9], axis=0)
    (note,) = notes_of(write(tmp_path, (vertices, gaps)))
    assert WORDS.format("an unknown share") in note


def test_every_command_says_it(run: Run, tmp_path: Path) -> None:
    path = str(unreal(tmp_path, angle()))
    for command in ("info", "check"):
        assert WORDS.format(L_FILLS) in run(command, path).out
        told = json.loads(run(command, path, "--json").out)["notes"]
        assert any(WORDS.format(L_FILLS) in note for note in told)
