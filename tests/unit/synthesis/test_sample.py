"""Which results are worth a look before a program is kept."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from meshforge.geometry import Pose
from meshforge.symbolic import Asset, Body, Document, Geom, Label
from meshforge.synthesis import Answer, Demonstration, Step, synthesize
from meshforge.synthesis.asset_selection import SAMPLE_SIZE
from tests.synthesis_boxes import boxes
from tests.synthesis_cupboards import cupboards, meant, selected, shown, with_rare_doors

HANDLES = "Is(handle) => Delete\n"


def test_the_first_one_is_where_most_belief_is_in_other_readings() -> None:
    meshes = with_rare_doors()
    outcome = synthesize(shown(meshes, ["c0"], HANDLES), meshes)
    assert outcome.sample[0] in ("c1", "c16")  # those with a door, on which a second handle is
    assert len(set(outcome.sample)) == len(outcome.sample) == SAMPLE_SIZE
    assert "c0" not in outcome.sample


def test_every_believable_reading_differs_on_one_of_a_dozen_where_so_few_suffice() -> None:
    meshes = cupboards(40, every=8)
    outcome = synthesize(shown(meshes, ["c0"], HANDLES), meshes)
    assert len(outcome.sample) == SAMPLE_SIZE
    for reading in outcome.candidates:
        assert not reading.differs_on or reading.belief < 0.005 or set(reading.differs_on) & set(outcome.sample)


def test_what_is_right_on_all_that_were_looked_at_settles_the_program() -> None:
    meshes = cupboards(40, every=8)
    demos = shown(meshes, ["c0"], HANDLES)
    first = synthesize(demos, meshes)
    assert first.program
    assert not first.unambiguous
    seen = [Answer(1, name, meant("Is(handle)", meshes[name])) for name in first.sample]
    then = synthesize(demos, meshes, answers=seen)
    assert then.unambiguous
    assert then.program
    assert all(selected(then.program, 1, mesh) == meant("Is(handle)", mesh) for mesh in meshes.values())
    assert not set(then.sample) & {"c0", *first.sample}


def test_a_mesh_on_which_one_of_two_rules_is_known_may_be_looked_at() -> None:
    meshes = cupboards(2)
    both = shown(meshes, ["c0"], f"Is(drawer) => Delete\n{HANDLES}")[0]
    half = Demonstration(meshes["c1"], [Step(1, meant("Is(drawer)", meshes["c1"]), both.steps[0].action)], "c1")
    assert synthesize([both, half], meshes).sample == ("c1",)


def test_of_meshes_that_tell_as_much_the_one_with_sure_labels_comes_first() -> None:
    meshes = with_rare_doors()
    body = next(hull.name for hull in meshes["c1"].hulls if hull.label == "body")
    unsure: dict[str, Label | None] = {body: Label("drawer", 0.6, "vlm")}
    for doubted, first in (("c1", "c16"), ("c16", "c1")):
        batch = {**meshes, doubted: meshes[doubted].with_labels(unsure)}
        assert synthesize(shown(meshes, ["c0"], HANDLES), batch).sample[0] == first


def test_kinds_of_hulls_that_nobody_showed_come_before_more_of_the_same() -> None:
    plain = {f"p{k}": boxes(("a", "body", (0, 0, 0), (1, 1, 1))) for k in range(20)}
    odd = boxes(("a", "body", (0, 0, 0), (1, 1, 1)), ("b", "lid", (0, 0, 1), (1, 1, 1)))
    meshes = {**plain, "odd": odd}
    assert synthesize(shown(meshes, ["p0"], "Is(body) => Delete\n"), meshes).sample[0] == "odd"


def test_an_asset_that_is_demonstrated_under_another_name_is_no_trouble() -> None:
    meshes = with_rare_doors()
    one = shown(meshes, ["c0"], HANDLES)[0]
    bodies = tuple(Body(name, Pose.identity()) for name in {hull.body for hull in one.mesh.hulls})
    geoms = tuple(Geom(hull.name, hull.body, hull.shape) for hull in one.mesh.hulls)
    file = Asset(Path("c0.urdf"), "urdf", bodies, geoms, Document())
    others = {"once more": replace(meshes["c0"], asset=file), **{name: meshes[name] for name in meshes if name != "c0"}}
    demo = Demonstration(replace(one.mesh, asset=file), one.steps, "shown")
    assert synthesize([demo], others).sample
