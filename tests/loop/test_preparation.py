"""The whole loop on real assets that are prepared first: knobs that are open shells, a stool only to be seen, lamps."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from meshforge.batch import IN_PROCESS
from meshforge.formats import load
from meshforge.geometry import Floats, is_convex
from meshforge.geometry.decomposition.engines import VhacdSettings
from meshforge.language import Each, Merge, Replace
from meshforge.project import Project
from meshforge.synthesis import Step
from tests.corpus_path import corpus
from tests.loop.command import meshforge_here as meshforge
from tests.loop.readme import commands
from tests.urdf_engines import bullet, mujoco_model

PAGE = Path(__file__).resolve().parents[2] / "docs" / "preparation.md"
CABINETS = ("sektion_cabinet.urdf", "sektion_cabinet_2.urdf")
COARSE = VhacdSettings(resolution=5000, max_convex_hulls=4)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with two cabinets and a project, all commands of the page on preparing typed in order."""
    folder = tmp_path_factory.mktemp("cabinets")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("MESHFORGE_CACHE", str(folder / "cache"))
        shutil.copytree(corpus("doors_cabinets", "IsaacGymEnvs", "sektion_cabinet_model"), folder / "assets")
        for words in commands("cabinets", PAGE):
            if words[0] == "label":
                _label(folder)
            done = meshforge(*words, cwd=folder)
            (folder / f"{words[0]}.txt").write_text(done.out)
            if words[0] == "apply":
                shutil.copytree(folder / "cabinets", folder / "applied")
    return folder


def _label(folder: Path) -> None:
    """Labels files beside the assets, by the names that the prepared hulls have."""
    for name in CABINETS:
        names = Project.open(folder / "cabinets").mesh(name).index
        kinds = {hull: "knob" if "nob" in hull else "body" for hull in names}
        path = (folder / "assets/urdf" / name).with_suffix(".labels.json")
        path.write_text(json.dumps({"hulls": kinds}))


def test_the_commands_of_the_page_teach_what_becomes_of_knobs(folder: Path) -> None:
    assert (folder / "applied/program.mf").read_text() == "labels knob, body\n\nIs(knob) => Each(Replace(box))\n"


@pytest.mark.parametrize("name", CABINETS)
def test_the_edited_cabinet_has_a_box_for_each_knob_and_all_else_as_it_was(folder: Path, name: str) -> None:
    before, after = load(folder / "assets/urdf" / name), load(folder / "applied/edited/urdf" / name)
    assert before.asset and len(before.asset.non_convex) == 2
    assert after.asset and after.asset.non_convex == ()
    made = [hull for hull in after.hulls if hull.label == "knob"]
    assert len(made) == 2 and {hull.shape.kind for hull in made} == {"box"}
    for hull in made:
        piece = next(p for p in before.asset.non_convex if hull.name.startswith(p.name))
        assert piece.surface is not None
        corners = np.array([hull.aabb.min, hull.aabb.max])
        np.testing.assert_allclose(corners, _bounds(piece.surface.vertices), atol=2e-3)
    assert len(after.hulls) == len(before.hulls) + 2


@pytest.mark.parametrize("name", CABINETS)
def test_engines_load_the_edited_cabinets(folder: Path, name: str) -> None:
    path = folder / "applied/edited/urdf" / name
    hulls = load(path).hulls
    assert len(bullet(path)["shapes"]) == 9
    plain = path.with_name(f"plain_{name}")
    plain.write_text(path.read_text().replace("package://", ""))  # MuJoCo knows no packages
    model = mujoco_model(plain)
    boxes = sum(hull.shape.kind == "box" for hull in hulls)
    assert sum(int(kind) == 6 for kind in model.geom_type) == boxes


def test_the_cut_and_the_undo_of_the_page_leave_nothing_behind(folder: Path) -> None:
    assert "sektion/sektion_collision#0: 2 hulls" in (folder / "cut.txt").read_text()
    assert not (folder / "cabinets/prepared" / CABINETS[0]).exists()
    steps = Project.open(folder / "cabinets").preparation(CABINETS[1]).steps
    assert [step.settings["method"] for step in steps] == ["coacd", "vhacd"]


def test_the_example_in_python_runs(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    monkeypatch.setenv("MESHFORGE_CACHE", str(folder / "cache"))
    (code,) = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)
    exec(compile(code, str(PAGE), "exec"), {})
    assert len(Project.open("cabinets").preparation(CABINETS[0]).steps) == 1


def test_a_stool_that_is_only_there_to_be_seen_gets_hulls_and_is_edited(tmp_path: Path) -> None:
    shutil.copytree(corpus("chairs", "KayKit-Restaurant-Bits-1.0"), tmp_path / "assets")
    project = Project.create(tmp_path / "p", [tmp_path / "assets/chair_stool.gltf"], vocabulary=["seat", "leg"])
    (done,) = project.decompose(settings=COARSE, execution=IN_PROCESS)
    assert not done.problems and len(done.hulls) > 1
    mesh = project.mesh("chair_stool.gltf")
    top = max(mesh.hulls, key=lambda hull: hull.shape.centroid[1]).name
    project.set_labels("chair_stool.gltf", {h.name: "seat" if h.name == top else "leg" for h in mesh.hulls})
    project.demonstrate("chair_stool.gltf", [Step(1, {top}, Replace("box"))])
    project.synthesize()
    (outcome,) = project.apply(execution=IN_PROCESS)
    assert outcome.status == "edited"
    after = load(project.folder / "edited/chair_stool.gltf")
    assert {hull.label for hull in after.hulls} == {"seat", "leg"} and len(after.hulls) == len(mesh.hulls)


def test_bodies_of_an_mjcf_that_only_show_something_get_hulls_and_keep_their_mass(tmp_path: Path) -> None:
    import mujoco

    shutil.copytree(corpus("lamps", "furniture_sim"), tmp_path / "furniture_sim")
    source = tmp_path / "furniture_sim/lightButtons.xml"
    project = Project.create(tmp_path / "p", [source], vocabulary=["button", "frame"])
    before = project.mesh("lightButtons.xml")
    (done,) = project.decompose(settings=COARSE, execution=IN_PROCESS)
    bodies = [entry.what for entry in done.made]
    assert len(bodies) == 3
    labels = {hull.name: "frame" for hull in before.hulls} | dict.fromkeys(done.hulls, "button")
    project.set_labels("lightButtons.xml", labels)
    project.demonstrate("lightButtons.xml", [Step(1, set(done.hulls), Each(Merge()))])
    project.synthesize()
    (outcome,) = project.apply(execution=IN_PROCESS)
    assert outcome.status == "edited"
    edited = project.folder / "edited" / "lightButtons.xml"
    path = edited if edited.is_file() else next((project.folder / "edited").rglob("lightButtons.xml"))
    old, new = (mujoco.MjModel.from_xml_path(str(p)) for p in (source, path))
    made = [hull for hull in load(path).hulls if hull.label == "button"]
    assert {hull.body for hull in made} == set(bodies)
    assert new.ngeom == old.ngeom + len(made)
    np.testing.assert_allclose(new.body_mass, old.body_mass)
    assert all(is_convex(hull.vertices, hull.faces, 1e-6) for hull in made)


def _bounds(points: Floats) -> Floats:
    return np.array([points.min(axis=0), points.max(axis=0)])
