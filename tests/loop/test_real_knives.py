"""Knives of two makers, one of them a single hull: rebuilt by what the hulls of the other are called, from the command
line, until two fingers close on its handle alone in MuJoCo."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from meshforge.formats import load, read_triangles
from meshforge.geometry import CoacdSettings, Polytope, convex_hull, decompose
from meshforge.project import Project
from tests.corpus_path import corpus
from tests.loop.command import Done, meshforge_here
from tests.loop.fingers import place_fingers
from tests.surface_cover import sample_lost
from tests.unit.project.stools import write_stool

PARTS = ("blade", "handle")
HANDLES = {"chef": (-0.111, -0.035), "cook": (-0.042, 0.0296)}
"""From where to where [m] along y the handles reach: of the first by the maker's own mesh of the handle, of the second
up to the edge at which the blade begins."""
NEAR_BLADE = 0.7
"""Of the handle's length is behind the fingers: not at its heel, around which a convex hull is wide by itself."""
WIDER = 1.25
"""Than what is seen between the fingers a convex hull of the handle may be, for the sake of the heel."""
GAME_UNIT = 0.2
"""[m] The second is 1.15 units of a game long."""
PROGRAM = "labels blade, handle\n\nIs(handle) => Merge\n"


def decompose_at(whole: Polytope, threshold: float) -> list[Polytope]:
    settings = CoacdSettings(
        threshold=threshold, preprocess_mode="off", resolution=500, mcts_iterations=20, mcts_nodes=10
    )
    return list(decompose(whole.vertices, whole.faces, settings))


def read_knives() -> tuple[dict[str, Polytope], dict[str, list[Polytope]]]:
    """Two knives, and the hulls of each, blade and handle."""
    maker = corpus("knives_cutlery", "object_sim", "knife")
    (chef,) = read_triangles(maker / "knife.stl")
    (cook,) = read_triangles(corpus("knives_cutlery", "KayKit-Restaurant-Bits-1.0", "knife.gltf"))
    wholes = {"chef": Polytope(chef.vertices, chef.faces), "cook": Polytope(cook.vertices * GAME_UNIT, cook.faces)}
    own = [convex_hull(read_triangles(maker / f"contact{k}.stl")[0].vertices) for k in (0, 1)]
    return wholes, {"chef": own, "cook": decompose_at(wholes["cook"], 0.1)}


def meshforge(*words: str) -> Done:
    """The command line in the folder where the test is."""
    return meshforge_here(*words, cwd=Path.cwd())


@pytest.mark.parametrize(("known", "coarse"), [("chef", "cook"), ("cook", "chef")])
def test_fingers_close_on_the_handle_of_a_coarse_knife_after_the_rebuild(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, known: str, coarse: str
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MESHFORGE_CACHE", str(tmp_path / "cache"))
    wholes, hulls = read_knives()
    whole, before = wholes[coarse], decompose_at(wholes[coarse], 0.3)
    assert len(before) == 1, "one hull spans handle and blade"
    write_stool(tmp_path / "assets", known, [wholes[known]], hulls[known])
    source = write_stool(tmp_path / "assets", coarse, [whole], before)
    meshforge("new", "knives", "assets/chef.urdf", "assets/cook.urdf", "--vocabulary", "blade,handle")
    project = Project.open(tmp_path / "knives")
    names = [hull.name for hull in project.mesh(f"{known}.urdf").hulls]
    project.set_labels(f"{known}.urdf", dict(zip(names, PARTS, strict=True)))
    fingers, width = place_fingers(whole.vertices, whole.faces, float(np.quantile(HANDLES[coarse], NEAR_BLADE)))
    assert fingers.count_contacts(source) > 0, "the hull fills what is beside the handle"

    told = meshforge("prepare", "knives", f"{coarse}.urdf", "--rebuild-spanning", "--min-confidence", "0.5")
    assert "handle" in told.out
    meshforge("label", "knives", "--with", "propagate")
    (tmp_path / "knives/program.mf").write_text(PROGRAM)
    meshforge("apply", "knives")

    made = tmp_path / "knives/edited" / f"{coarse}.urdf"
    assert fingers.count_contacts(made) == 0, "the fingers go around the handle"
    touched, apart = fingers.close(made)
    labels = {hull.name.removeprefix("base/"): hull.label for hull in load(made).hulls}
    for finger, own in touched.items():
        assert {labels[name] for name in own} == {"handle"}, finger
    assert 0.95 * width < apart < WIDER * width, "they hold what is seen"
    after = [hull.shape for hull in Project.open(tmp_path / "knives").mesh(f"{coarse}.urdf").hulls]
    assert not len(sample_lost(whole.vertices, whole.faces, before, after)), "and no gap is left"
