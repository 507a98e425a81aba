"""The meshes that a program is learned for: their names, and which of them stay away."""

import json
from pathlib import Path
from typing import Any

import pytest

import meshforge as mf
from meshforge.language import Delete, Is, LandmarkPair, Orient, Program
from meshforge.symbolic import Label, SymbolicMesh
from meshforge.synthesis import (
    Ambiguous,
    Answer,
    Demonstration,
    Found,
    LearningOutcome,
    Options,
    Step,
    outcome_to_json,
    synthesize,
)
from meshforge.synthesis.task import name_family
from tests.synthesis_boxes import boxes
from tests.synthesis_cupboards import cupboard, cupboards, shown, with_rare_doors

HANDLES = "Is(handle) => Delete"
MESHES = cupboards()
RARE = with_rare_doors()
"""The same, but for more of them; what a door leaves open is asked about here."""
DEMOS = shown(MESHES, ["c0"], HANDLES)
EMPTY = SymbolicMesh(())


def shape(outcome: LearningOutcome) -> dict[str, Any]:
    """The outcome as JSON, without times."""
    return {**json.loads(json.dumps(outcome_to_json(outcome))), "seconds": None}


def at(size: float) -> SymbolicMesh:
    return boxes(
        ("case", "body", (0, 0, 0), (4 * size, 4 * size, 4 * size)),
        ("drawer", "drawer", (0, -size, 0), (4 * size, size, 2 * size)),
        ("pull", "handle", (size, -2 * size, 0), (size, size, 0.5 * size)),
    )


def test_meshes_of_files_are_called_by_their_paths(tmp_path: Path) -> None:
    paths = [tmp_path / f"{name}.obj" for name in ("b", "a")]
    for path in paths:
        path.write_text("o x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
    meshes = [mf.load(path) for path in paths]
    demo = Demonstration(meshes[1], [Step(1, [], Delete())])
    assert list(name_family(meshes, DEMOS)) == [str(paths[1]), str(paths[0])]
    assert list(name_family((mf.load(path) for path in paths), [demo])) == [str(paths[0])]


def test_demonstrated_meshes_are_left_out_by_name_and_by_identity() -> None:
    assert "c0" not in name_family({**MESHES, "c0": cupboard()}, DEMOS)
    assert "again" not in name_family({**MESHES, "again": MESHES["c0"]}, DEMOS)
    unnamed = Demonstration(MESHES["c0"], DEMOS[0].steps)
    assert sorted(name_family(MESHES, [unnamed])) == [f"c{k}" for k in range(1, 8)]


@pytest.mark.parametrize("batch", [(), [], {}, iter(())])
def test_without_a_batch_one_reading_is_enough_and_nothing_is_settled(batch: Any) -> None:
    outcome = synthesize(DEMOS, batch)
    assert isinstance(outcome, Found)
    assert not outcome.unambiguous
    assert len(outcome.candidates) == 1


def test_the_order_of_a_mapping_does_not_matter() -> None:
    forth, back = (synthesize(DEMOS, dict(rows)) for rows in (RARE.items(), list(RARE.items())[::-1]))
    assert isinstance(forth, Ambiguous)
    assert shape(forth) == shape(back)
    assert forth.open_rule == back.open_rule


def test_meshes_that_cannot_be_oriented_leave_the_batch() -> None:
    up = Orient((LandmarkPair("+Z", Is("foot"), Is("body")),))
    meshes = {name: mesh for name, mesh in MESHES.items() if name != "c2"}
    outcome = synthesize(shown(MESHES, ["c2"], HANDLES), meshes, orient=up)
    footless = {"c0", "c3", "c6"}
    assert {name for reading in outcome.candidates for name in reading.differs_on} <= meshes.keys() - footless
    only = synthesize(shown(MESHES, ["c2"], HANDLES), {name: MESHES[name] for name in footless}, orient=up)
    assert isinstance(only, Found)
    assert not only.unambiguous, "no mesh was left to look at"


def test_meshes_that_a_rule_cannot_edit_leave_the_batch_after_it() -> None:
    meshes = {**MESHES, "huge": at(1e60)}
    demos = shown(MESHES, ["c0"], f"Is(drawer) => Scale(all, 1e60)\n{HANDLES}")
    answer = Answer(2, "huge", {"pull"})
    outcome = synthesize(demos, meshes, answers=[answer], options=Options(repair=False))
    assert isinstance(outcome, Found | Ambiguous)
    assert not any("huge" in reading.differs_on for reading in outcome.candidates if reading.rule == 2)
    assert outcome.stale == (answer,)


def test_a_mesh_without_hulls_is_no_obstacle_and_never_asked_about() -> None:
    with_empty, without = (synthesize(DEMOS, {**RARE, **more}) for more in ({"empty": EMPTY}, {}))
    assert isinstance(with_empty, Ambiguous)
    assert [rule.extractor for rule in with_empty.rules] == [rule.extractor for rule in without.rules]
    assert not any("empty" in reading.differs_on for reading in with_empty.candidates)
    only = synthesize(DEMOS, {"empty": EMPTY})
    assert isinstance(only, Found)


def test_labels_of_the_batch_are_part_of_the_vocabulary_unless_it_is_given() -> None:
    odd = cupboard().with_labels({"case": Label("carcass")})
    assert "carcass" in synthesize_program(synthesize(DEMOS, {"odd": odd})).labels
    given = ("body", "drawer", "handle")
    assert synthesize_program(synthesize(DEMOS, {"odd": odd}, vocabulary=given)).labels == given


def synthesize_program(outcome: LearningOutcome) -> Program:
    assert outcome.program
    return outcome.program


def test_settled_means_that_no_believable_reading_differs() -> None:
    for program in (HANDLES, "Is(drawer) => Delete", "Is(body) => Delete", "All => Delete"):
        for names in (["c0"], ["c1"], ["c1", "c2"], ["c4", "c5", "c7"]):
            outcome = synthesize(shown(MESHES, names, program), MESHES)
            differing = [reading for reading in outcome.candidates if reading.differs_on and reading.belief >= 0.005]
            assert outcome.unambiguous is not bool(differing)


@pytest.mark.parametrize("effort", [0, 5])
def test_nothing_is_settled_where_readings_were_left_out(effort: int) -> None:
    outcome = synthesize(shown(MESHES, ["c0", "c1", "c4"], HANDLES), MESHES, options=Options(effort=effort))
    whole = synthesize(shown(MESHES, ["c0", "c1", "c4"], HANDLES), MESHES)
    assert not outcome.unambiguous
    assert whole.unambiguous


def test_the_strategy_of_the_paper_takes_a_batch_and_settles_nothing() -> None:
    options = Options(strategy="paper", repair=False)
    outcome = synthesize(DEMOS, MESHES, options=options)
    assert isinstance(outcome, Found)
    assert (outcome.unambiguous, outcome.open_rule) == (False, None)
    assert [rule.extractor for rule in outcome.rules] == [Is("handle")]
