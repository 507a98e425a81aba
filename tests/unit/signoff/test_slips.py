"""Slips in demonstrations: asked about where a simpler rule would select all the others, and then corrected or not."""

from __future__ import annotations

from dataclasses import replace

import pytest

from meshforge.label_model import model_family
from meshforge.language import Attach, Delete, Geo, Is, Rule, Union
from meshforge.signoff import Assessment, ReviewQuestion, ReviewReply, ReviewState, apply_reply, review_family
from meshforge.signoff.reply import list_answers
from meshforge.signoff.slips import BY_MISTAKE, ON_PURPOSE, ask_about_kept_label, ask_about_nearest, find_slips
from meshforge.signoff.trial import try_program
from meshforge.symbolic import Label, SymbolicMesh
from meshforge.synthesis import Answer, Demonstration, LabelCorrection, Nearest, NeedsRepair, Repair, Step
from tests.unit.signoff.test_review import FRAME, legs_of, review, shown, tables

FORGOTTEN = "leg2_low"


def show_without(*forgotten: str) -> tuple[dict[str, SymbolicMesh], ReviewState]:
    """Tables, of one of which all legs are deleted but for some hulls."""
    meshes = tables()
    demo = Demonstration(meshes["t0"], [Step(1, legs_of("t0").difference(forgotten), Delete())], "t0")
    return meshes, ReviewState(meshes, FRAME, demos={"t0": demo})


def ask_about_slip(state: ReviewState) -> ReviewQuestion | None:
    """The question about a slip, whatever else is asked first."""
    for _ in range(12):
        question = review(state).question
        if question is None or question.kind == "selection":
            return question
        state = apply_reply(state, question, ReviewReply(question.id, later=True))
    return None


def probability(found: Assessment, asset: str) -> float:
    return found.assets[asset].probability


def test_a_hull_that_was_forgotten_is_asked_about() -> None:
    _, state = show_without(FORGOTTEN)
    question = ask_about_slip(state)
    assert question is not None
    assert (question.asset, question.rule) == ("t0", 1)
    assert f"With {FORGOTTEN} rule 1" in question.text
    assert "was it left out on t0 by mistake?" in question.text
    assert [choice.text for choice in question.choices] == [BY_MISTAKE, ON_PURPOSE]
    assert set(question.choices[0].select or ()) == legs_of("t0")


def test_a_hull_that_is_too_much_is_asked_about_in_words_of_its_own() -> None:
    _, state = show_without()
    nearest = Nearest(1, Is("leg"), "t0", (), (FORGOTTEN,))
    question = ask_about_nearest(state, nearest, 6.0)
    assert question is not None
    assert question.text == f"Without {FORGOTTEN} rule 1 could be Is(leg): was it selected on t0 by mistake?"
    assert set(question.choices[0].select or ()) == legs_of("t0") - {FORGOTTEN}


def test_a_slip_that_is_admitted_is_corrected() -> None:
    meshes, state = show_without(FORGOTTEN)
    question = ask_about_slip(state)
    assert question is not None
    after = apply_reply(state, question, ReviewReply(question.id, 0))
    step = after.demos["t0"].step(1)
    assert step is not None
    assert step.select == legs_of("t0")
    whole = review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0")))
    assert review(after).assets == whole.assets


@pytest.mark.slow
def test_what_was_meant_as_shown_is_not_asked_about_again() -> None:
    _, state = show_without(FORGOTTEN)
    question = ask_about_slip(state)
    assert question is not None
    after = apply_reply(state, question, ReviewReply(question.id, 1))
    assert after.demos == state.demos
    assert question.id in after.later
    assert ask_about_slip(after) is None


def test_a_simple_demonstration_has_no_slip() -> None:
    _, state = show_without()
    assert ask_about_slip(state) is None


def test_a_program_that_nobody_demonstrated_has_no_slips() -> None:
    meshes = tables()
    parts = Union(Is("leg"), Union(Geo(Is("drawer"), "-Z"), Attach(Is("handle"), Is("drawer"))))
    program = replace(FRAME, rules=(Rule(parts, Delete()),))
    trials = [try_program(name, mesh, program, {}) for name, mesh in meshes.items()]
    seen = {"t1": (frozenset(trials[1].names(1, trials[1].selections[0])),)}
    assert list(find_slips(ReviewState(meshes, FRAME, accepted=seen), program, trials)) == []


@pytest.mark.slow
def test_a_mended_result_is_no_slip() -> None:
    state = answer_wrongly()
    mended = replace(state, mended={"t1": (legs_of("t1") | {"drawer0_bottom", "handle0"},)})
    assert ask_about_slip(mended) is None


def test_results_that_are_all_wrong_hold_the_rest() -> None:
    _, state = show_without()
    before, wrong = review(state), {f"t{k}": (frozenset[str](),) for k in range(1, 5)}
    after = review(replace(state, mended=wrong, failed={name: (legs_of(name),) for name in wrong}))
    assert probability(after, "t5") < probability(before, "t5")


def test_a_mend_is_learned_from_where_the_labels_of_its_hulls_are_sure() -> None:
    meshes, state = show_without()
    done = legs_of("t5")
    mended = replace(state, mended={"t5": (done - {FORGOTTEN},)}, failed={"t5": (done,)})
    said = [hull.annotation for mesh in meshes.values() for hull in mesh.hulls]
    posterior = model_family(list(meshes.values())).infer(said)
    assert [one.asset for one in list_answers(mended, posterior)] == ["t5"]


def test_before_the_end_one_result_is_looked_at_of_a_rule_that_answers_shaped() -> None:
    meshes, state = show_without()
    answered = replace(state, answers=(Answer(1, "t3", legs_of("t3")),))
    question = review(answered, bar=0.0).question
    assert question is not None
    assert question.kind == "result"
    assert question.asset not in ("t0", "t3")
    assert question.text.startswith("One last look")
    seen = replace(answered, accepted={"t2": (legs_of("t2"),)})
    assert review(seen, bar=0.0).question is None
    assert review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0")), bar=0.0).question is None


def test_before_the_end_a_result_is_looked_at_where_an_answer_was_about_a_label_that_nobody_showed() -> None:
    _, state = show_without()
    answered = replace(state, answers=(Answer(1, "t1", legs_of("t1")),), accepted={"t2": (legs_of("t2"),)})
    question = review(answered, bar=0.0).question
    assert question is not None
    assert question.asset == "t1"
    assert question.text.startswith("One last look")


def test_who_puts_one_last_look_off_is_asked_for_no_other() -> None:
    _, state = show_without()
    answered = replace(state, answers=(Answer(1, "t3", legs_of("t3")),))
    question = review(answered, bar=0.0).question
    assert question is not None
    assert review(apply_reply(answered, question, ReviewReply(question.id, later=True)), bar=0.0).question is None


def answer_wrongly() -> ReviewState:
    """A person shows that all legs are deleted, then says of another table that two hulls more are."""
    _, state = show_without()
    return replace(state, answers=(Answer(1, "t1", legs_of("t1") | {"drawer0_bottom", "handle0"}),))


def test_an_answer_that_alone_makes_a_rule_complicated_is_asked_about() -> None:
    question = ask_about_slip(answer_wrongly())
    assert question is not None
    assert (question.asset, question.rule) == ("t1", 1)
    assert "rule 1 would just be Is(leg): were they selected on t1 by mistake?" in question.text


def test_an_answer_that_was_a_slip_is_replaced() -> None:
    state = answer_wrongly()
    question = ask_about_slip(state)
    assert question is not None
    after = apply_reply(state, question, ReviewReply(question.id, 0))
    assert after.answers == (Answer(1, "t1", legs_of("t1")),)
    assert after.demos == state.demos


@pytest.mark.slow
def test_an_answer_that_was_meant_so_is_kept() -> None:
    state = answer_wrongly()
    question = ask_about_slip(state)
    assert question is not None
    after = apply_reply(state, question, ReviewReply(question.id, 1))
    assert after.answers == state.answers
    assert ask_about_slip(after) is None


def keep_label(state: ReviewState, hull: str) -> tuple[ReviewState, NeedsRepair]:
    """A person keeps a label that learning would change, since they said that the hull is selected too."""
    mesh = state.meshes["t1"]
    kept = mesh.with_labels({hull: Label(mesh.hull_of(hull).label or "", source="repair")})
    after = replace(state, meshes={**state.meshes, "t1": kept})
    repair = Repair(LabelCorrection("t1", hull, kept.hull_of(hull).label, "panel"), 1, 0.6, "it looks like one")
    outcome = NeedsRepair(rules=(), readings=(), tried=(), seconds={}, repairs=(repair,))
    family = model_family(list(after.meshes.values()))
    question = review_family(after, outcome, family).question
    assert question is not None and question.kind == "repair"
    return apply_reply(after, question, ReviewReply(question.id, 1)), outcome


def test_where_a_label_is_kept_that_nothing_fits_the_selection_is_asked_about() -> None:
    _, state = show_without()
    said = Answer(1, "t1", legs_of("t1") | {"handle0"})
    state, outcome = keep_label(replace(state, answers=(said,)), "handle0")
    question = review_family(state, outcome, model_family(list(state.meshes.values()))).question
    assert question is not None
    assert question.text == "handle0 is handle, and rule 1 selects it: was it selected on t1 by mistake?"
    after = apply_reply(state, question, ReviewReply(question.id, 0))
    assert after.answers == (Answer(1, "t1", legs_of("t1")),)
    on_purpose = apply_reply(state, question, ReviewReply(question.id, 1))
    assert on_purpose.answers == (said,)
    assert review_family(on_purpose, outcome, model_family(list(state.meshes.values()))).question is None


def test_a_hull_that_was_left_out_though_its_label_is_kept_is_asked_about() -> None:
    _, state = show_without()
    state, outcome = keep_label(replace(state, answers=(Answer(1, "t1", legs_of("t1") - {FORGOTTEN}),)), FORGOTTEN)
    question = ask_about_kept_label(state, outcome.repairs[0], 6.0)
    assert question is not None
    assert question.text == f"{FORGOTTEN} is leg, and rule 1 leaves it out: was it left out on t1 by mistake?"


def test_nothing_is_asked_of_a_label_that_nobody_gave_or_where_nothing_was_said() -> None:
    _, state = show_without()
    repair = Repair(LabelCorrection("t1", "handle0", "handle", "leg"), 1, 0.6, "it looks like one")
    answered = replace(state, answers=(Answer(1, "t1", legs_of("t1") | {"handle0"}),))
    assert ask_about_kept_label(answered, repair, 6.0) is None
    silent, outcome = keep_label(state, "handle0")
    assert ask_about_kept_label(silent, outcome.repairs[0], 6.0) is None
    gone = replace(silent, meshes={"t0": state.meshes["t0"]})
    assert ask_about_kept_label(gone, outcome.repairs[0], 6.0) is None
