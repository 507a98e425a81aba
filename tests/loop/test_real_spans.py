"""A real mug, decomposed so coarsely that a hull fills its handle: rebuilt by what the hulls of another mug are called,
from the command line, until a rod passes through the handle in MuJoCo."""

from __future__ import annotations

import shutil
from pathlib import Path

import mujoco
import numpy as np
import pytest

from meshforge.formats import read_triangles
from meshforge.geometry import CoacdSettings, Floats, Polytope, convex_hull, decompose, rotation_about
from meshforge.project import Project
from tests.corpus_path import corpus
from tests.loop.command import Done, meshforge_here
from tests.unit.project.stools import write_stool

LABELS = {"handle": (10, 12), "base": (5, 6, 8, 9)}
"""Of the author's hulls of the mug, contact0.stl and so on; all others are of the wall."""
COARSE = CoacdSettings(threshold=0.3, preprocess_mode="off", resolution=500, mcts_iterations=20, mcts_nodes=10)
ROD = 0.004
"""[m] The radius of the rod."""


def mug_hulls(folder: Path) -> list[Floats]:
    return [read_triangles(folder / f"contact{k}.stl")[0].vertices for k in range(14)]


def find_hole(points: Floats) -> Floats:
    """The point in the plane of the handle, between it and the wall, that is farthest from the surface."""
    x, z = np.meshgrid(np.linspace(0.030, 0.052, 45), np.linspace(-0.03, 0.035, 66), indexing="ij")
    grid = np.column_stack([x.ravel(), np.zeros(x.size), z.ravel()])
    gaps = np.linalg.norm(grid[:, None] - points[None], axis=2).min(axis=1)
    found: Floats = grid[int(gaps.argmax())]
    return found


def count_contacts(path: Path, at: Floats, across: Floats) -> int:
    """How many contacts a rod has with the mug in MuJoCo."""
    spec = mujoco.MjSpec.from_file(str(path))
    body = spec.worldbody.add_body(name="rod")
    body.add_freejoint()
    ends = [*(at - 0.03 * across), *(at + 0.03 * across)]
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_CAPSULE, size=[ROD, 0, 0], fromto=ends)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return int(data.ncon)


def meshforge(*words: str) -> Done:
    """The command line in the folder where the test is."""
    return meshforge_here(*words, cwd=Path.cwd())


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MESHFORGE_CACHE", str(tmp_path / "cache"))
    source = corpus("cups_mugs", "object_sim", "coffeemug")
    (seen,) = read_triangles(source / "coffeemug.stl")
    whole = Polytope(seen.vertices, seen.faces)
    write_stool(tmp_path / "assets", "mug", [whole], [convex_hull(points) for points in mug_hulls(source)])
    turned = (seen.vertices * [1.0, 1.1, 1.3]) @ rotation_about(np.array([0.0, 0.0, 1.0]), 0.7).T
    hulls = decompose(turned, seen.faces, COARSE)
    assert len(hulls) < 10
    write_stool(tmp_path / "assets", "other", [Polytope(turned, seen.faces)], hulls)
    return tmp_path


@pytest.mark.long
def test_a_coarse_mug_can_be_grasped_by_its_handle_after_the_rebuild(folder: Path) -> None:
    (seen,) = read_triangles(corpus("cups_mugs", "object_sim", "coffeemug") / "coffeemug.stl")
    turn = rotation_about(np.array([0.0, 0.0, 1.0]), 0.7)
    at = turn @ (find_hole(seen.vertices) * [1.0, 1.1, 1.3])
    across = turn @ np.array([0.0, 1.0, 0.0])
    meshforge("new", "mugs", "assets/mug.urdf", "assets/other.urdf", "--vocabulary", "base,wall,handle")
    project = Project.open(folder / "mugs")
    names = [hull.name for hull in project.mesh("mug.urdf").hulls]
    labels = {k: label for label, own in LABELS.items() for k in own}
    project.set_labels("mug.urdf", {name: labels.get(k, "wall") for k, name in enumerate(names)})
    assert count_contacts(folder / "assets/other.urdf", at, across) > 0, "a hull fills the handle"

    told = meshforge("prepare", "mugs", "other.urdf", "--rebuild-spanning", "--min-confidence", "0.5")
    assert "handle" in told.out
    meshforge("label", "mugs", "--with", "propagate")
    (folder / "mugs/program.mf").write_text("labels base, wall, handle\n\nIs(base) => Merge\n")
    meshforge("apply", "mugs")
    status = meshforge("status", "mugs", "--json").json
    assert [asset["output"] for asset in status["assets"]] == ["edited", "edited"]
    made = folder / "mugs/edited/other.urdf"
    assert count_contacts(made, at, across) == 0, "a rod passes through the handle"
    grip = at + turn @ np.array([0.02, 0.0, 0.0])
    assert count_contacts(made, grip, across) > 0, "and there is a handle to hold"
    shutil.rmtree(folder / "cache", ignore_errors=True)
