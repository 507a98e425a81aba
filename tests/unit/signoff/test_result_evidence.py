"""What results and labels say of a family: labels by results, readings by results called wrong, look-alikes as one."""

from dataclasses import replace
from math import exp, log

import pytest

from meshforge.label_model import model_family
from meshforge.language import Delete
from meshforge.signoff import ReviewState
from meshforge.signoff.assessment import AssetEvidence, read_calibration
from meshforge.signoff.family import FamilyRun, alternative_shares
from meshforge.signoff.likely_mistakes import ask_about_mistake, offer_label
from meshforge.signoff.review import review_family
from meshforge.synthesis import Ambiguous, Demonstration, Found, LabelFix, NeedsRepair, Repair, Step
from tests.unit.signoff.test_review import FRAME, LABELS, accept, learn, legs_of, shown, tables

WRONG_LEG = "leg2_low"


def try_state(state: ReviewState) -> FamilyRun:
    """The program that is learned, on the family."""
    outcome = learn(state)
    assert isinstance(outcome, Found | Ambiguous)
    said = [hull.annotation for mesh in state.meshes.values() for hull in mesh.hulls]
    posterior = model_family(list(state.meshes.values())).infer(said, LABELS)
    return FamilyRun.of(state, outcome.program, outcome.candidates, posterior, {})


def chance(trial: FamilyRun, asset: str, hull: str, label: str) -> float:
    place = trial.places[asset]
    row = trial.state.meshes[asset].index[hull]
    return float(trial.posterior.chances_of(place)[row][trial.posterior.seen.labels.index(label)])


def test_a_corrected_result_makes_the_label_probable_with_which_it_would_have_been_right() -> None:
    meshes = tables(leg2_low="panel")
    before = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"))
    told = replace(before, meant={"t5": (legs_of("t5"),)}, corrected=frozenset({"t5"}))
    outcome = learn(before)
    assert isinstance(outcome, Found | Ambiguous)
    family = model_family(list(meshes.values()))
    said = [hull.annotation for mesh in meshes.values() for hull in mesh.hulls]
    chances = [
        chance(FamilyRun.of(state, outcome.program, outcome.candidates, family.infer(said), {}), "t5", WRONG_LEG, "leg")
        for state in (before, told)
    ]
    assert chances[1] > chances[0]


def test_a_result_that_was_found_right_speaks_for_the_labels_there() -> None:
    meshes = tables(leg2_low="panel")
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"))
    as_labelled = accept(state, "t5", legs_of("t5") - {WRONG_LEG})
    before, after = try_state(state), try_state(as_labelled)
    assert chance(after, "t5", WRONG_LEG, "leg") < chance(before, "t5", WRONG_LEG, "leg")


def test_a_reading_that_does_what_was_called_wrong_is_less_believed() -> None:
    meshes = tables()
    demo = {"t0": Demonstration(meshes["t0"], [Step(1, legs_of("t0"), Delete())], "t0")}
    state = ReviewState(meshes, FRAME, demos=demo)
    outcome = learn(state)
    assert isinstance(outcome, Found | Ambiguous)
    rule = try_state(state).candidates[0]
    if len(rule.extractors) == 1:
        pytest.skip("one reading alone has all the belief")
    failed = replace(state, wrong=frozenset({"t1"}), failed={"t1": (legs_of("t1"),)})
    doubted = try_state(failed).candidates[0]
    assert doubted.beliefs[0] <= rule.beliefs[0]
    assert doubted.beliefs.sum() == pytest.approx(1.0)


def test_look_alikes_of_an_asset_count_once() -> None:
    meshes = tables(leg1_low="panel", leg2_low="panel")
    trial = try_state(ReviewState(meshes, FRAME, demos=shown(meshes, "t0")))
    place = trial.places["t5"]
    shares = alternative_shares(trial.runs[place].alternatives)
    assert {"leg1_low", WRONG_LEG} <= shares.keys()
    product = exp(sum(log(1 - share) for share in shares.values()))
    assert product < trial.labels_right(place) <= 1 - max(shares.values())
    assert trial.labels_right(place, shares.keys()) == 1.0


def test_credit_is_linear_in_the_doubt_that_goes() -> None:
    one = AssetEvidence(0.8, 0.5, program=0.9)
    whole = one.credit(candidates=1 / 0.8, labels=2.0, program=1 / 0.9)
    assert whole == pytest.approx(1 - one.probability)
    parts = one.credit(candidates=1 / 0.8) + one.credit(labels=2.0) + one.credit(program=1 / 0.9)
    assert parts == pytest.approx(whole), "however many doubts there are, the sum of their credits is the whole"
    assert one.credit() == 0.0
    assert AssetEvidence(1.0, 1.0).credit() == 0.0


def test_labels_of_the_vocabulary_that_nobody_gave_have_a_small_probability() -> None:
    meshes = tables()
    said = [hull.annotation if hull.label != "handle" else None for mesh in meshes.values() for hull in mesh.hulls]
    family = model_family(list(meshes.values()))
    without, with_all = family.infer(said), family.infer(said, LABELS)
    assert "handle" not in without.seen.labels
    column = with_all.seen.labels.index("handle")
    bare = [k for k, one in enumerate(said) if one is None]
    others = [k for k, one in enumerate(said) if one is not None]
    assert with_all.chances[bare, column].mean() > with_all.chances[others, column].mean() > 0


def test_a_slip_may_be_a_wrong_label() -> None:
    meshes = tables()
    demo = Demonstration(meshes["t0"], [Step(1, legs_of("t0") - {WRONG_LEG}, Delete())], "t0")
    state = ReviewState(meshes, FRAME, demos={"t0": demo})
    trial = try_state(state)
    question = ask_about_mistake(state, trial.mistakes[0])
    offered = offer_label(state, trial.posterior, question)
    assert offered.id == question.id
    assert offered.choices[:2] == question.choices
    labels = [choice.label for choice in offered.choices[2:]]
    assert len(labels) <= 1 and "leg" not in labels


def test_where_all_repairs_were_refused_the_edit_is_asked_for_again() -> None:
    meshes = tables()
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"))
    repair = Repair(LabelFix("t0", WRONG_LEG, "leg", "panel"), 1, 0.9, "why")
    outcome = NeedsRepair(rules=(), candidates=(), tried=(), seconds={}, repairs=(repair,))
    family = model_family(list(meshes.values()))
    first = review_family(state, outcome, family)
    assert first.question is not None and first.question.kind == "repair"
    refused = replace(state, snoozed=frozenset({one.id for one in first.questions}))
    second = review_family(refused, outcome, family).question
    assert second is not None and (second.kind, second.asset) == ("demonstrate", "t0")


def test_the_threshold_rests_on_families() -> None:
    known = read_calibration()
    assert 0.5 < known.threshold < 1
    assert known.families >= 25, "else no threshold is low enough"
    assert known.risk == 0.01
