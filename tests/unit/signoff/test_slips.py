"""Slips in demonstrations: asked about where a simpler rule would select all the others, and then corrected or not."""

from dataclasses import replace

import pytest

from meshforge.label_model import model_family
from meshforge.language import Attach, Delete, Geo, Is, Rule, Union
from meshforge.signoff import Assessment, ReviewQuestion, ReviewState, review_family
from meshforge.signoff.likely_mistakes import ask_about_kept_label, ask_about_nearest, find_mistakes
from meshforge.signoff.program_run import run_on_asset
from meshforge.signoff.question import NO, YES
from meshforge.symbolic import Label, SymbolicMesh
from meshforge.synthesis import Answer, Demonstration, LabelFix, Nearest, NeedsRepair, Repair, Step
from tests.unit.signoff.test_review import FRAME, accept, legs_of, review, shown, snooze, tables

FORGOTTEN = "leg2_low"


def show_without(*forgotten: str) -> tuple[dict[str, SymbolicMesh], ReviewState]:
    """Tables, of one of which all legs are deleted but for some hulls."""
    meshes = tables()
    demo = Demonstration(meshes["t0"], [Step(1, legs_of("t0").difference(forgotten), Delete())], "t0")
    return meshes, ReviewState(meshes, FRAME, demos={"t0": demo})


def ask_about_mistake(state: ReviewState) -> ReviewQuestion | None:
    """The question about a slip, whatever else is asked first."""
    for _ in range(12):
        question = review(state).question
        if question is None or question.kind == "selection":
            return question
        state = snooze(state, question)
    return None


def meant_by(question: ReviewQuestion) -> frozenset[str]:
    """What was to be selected, if it was a slip."""
    choice = question.choice(YES)
    assert choice is not None and choice.select is not None
    return frozenset(choice.select)


def probability(found: Assessment, asset: str) -> float:
    return found.assets[asset].confidence


def test_a_hull_that_was_forgotten_is_asked_about() -> None:
    _, state = show_without(FORGOTTEN)
    question = ask_about_mistake(state)
    assert question is not None
    assert (question.asset, question.rule) == ("t0", 1)
    assert f"{FORGOTTEN} is leg, like the 7 hulls that rule 1 selects" in question.text
    assert "was it left out on t0 by mistake?" in question.text
    assert [choice.id for choice in question.choices] == [NO, YES], "things stay as they are by default"
    assert meant_by(question) == legs_of("t0")


def test_a_hull_that_is_too_much_is_asked_about_in_words_of_its_own(state: ReviewState) -> None:
    nearest = Nearest(1, Is("leg"), "t0", (), (FORGOTTEN,))
    question = ask_about_nearest(state, nearest, 6.0)
    assert question is not None
    assert question.text == f"Without {FORGOTTEN} rule 1 could be Is(leg): was it selected on t0 by mistake?"
    assert meant_by(question) == legs_of("t0") - {FORGOTTEN}


def test_a_program_that_nobody_demonstrated_has_no_slips() -> None:
    meshes = tables()
    parts = Union(Is("leg"), Union(Geo(Is("drawer"), "-Z"), Attach(Is("handle"), Is("drawer"))))
    program = replace(FRAME, rules=(Rule(parts, Delete()),))
    trials = [run_on_asset(name, mesh, program, {}) for name, mesh in meshes.items()]
    seen = accept(ReviewState(meshes, FRAME), "t1", *trials[1].selected)
    assert list(find_mistakes(seen, program, trials)) == []


@pytest.mark.slow
def test_a_corrected_result_is_no_slip() -> None:
    state = answer_wrongly()
    meant = {"t1": (legs_of("t1") | {"drawer0_bottom", "handle0"},)}
    assert ask_about_mistake(replace(state, corrected=frozenset(meant), meant=meant)) is None


def test_results_that_are_all_wrong_lower_the_rest(state: ReviewState) -> None:
    wrong = {f"t{k}": (legs_of(f"t{k}"),) for k in range(1, 5)}
    after = review(replace(state, wrong=frozenset(wrong), failed=wrong))
    assert probability(after, "t5") < probability(review(state), "t5")
    assert {"t1", "t2", "t3", "t4"} <= set(after.need_review)


def test_results_of_a_program_that_is_no_more_do_not_count_against_the_one_there_is(state: ReviewState) -> None:
    wrong = {f"t{k}": (frozenset[str](),) for k in range(1, 5)}
    after = review(replace(state, wrong=frozenset(wrong), failed=wrong))
    assert probability(after, "t5") == probability(review(state), "t5")


@pytest.fixture
def state() -> ReviewState:
    return show_without()[1]


def test_a_wrong_result_costs_the_more_the_less_it_was_expected() -> None:
    meshes = tables(leg2_low="panel")
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"))
    done = {"t4": legs_of("t4"), "t5": legs_of("t5") - {"leg2_low"}}
    before = review(state)
    assert probability(before, "t5") < probability(before, "t4")
    left = {
        name: probability(review(replace(state, wrong=frozenset({name}), failed={name: (hulls,)})), "t3")
        for name, hulls in done.items()
    }
    assert left["t4"] < left["t5"] < probability(before, "t3")


def test_a_corrected_result_speaks_for_the_program_that_does_what_was_meant(state: ReviewState) -> None:
    right = replace(state, corrected=frozenset({"t1"}), meant={"t1": (legs_of("t1"),)}, failed={"t1": (frozenset(),)})
    assert probability(review(right), "t5") > probability(review(state), "t5")


def test_before_the_end_one_result_is_looked_at_of_a_rule_that_answers_shaped() -> None:
    meshes, state = show_without()
    answered = replace(state, answers=(Answer(1, "t3", legs_of("t3")),))
    question = review(answered, bar=0.0).question
    assert question is not None
    assert question.kind == "result"
    assert question.asset not in ("t0", "t3")
    assert question.text.startswith("One last look")
    assert review(snooze(answered, question), bar=0.0).question is None, "who puts it off is asked for no other"
    seen = accept(answered, "t2", legs_of("t2"))
    assert review(seen, bar=0.0).question is None
    assert review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0")), bar=0.0).question is None


def test_before_the_end_a_result_is_looked_at_where_an_answer_was_about_a_label_that_nobody_showed() -> None:
    _, state = show_without()
    answered = accept(replace(state, answers=(Answer(1, "t1", legs_of("t1")),)), "t2", legs_of("t2"))
    question = review(answered, bar=0.0).question
    assert question is not None
    assert question.asset == "t1"
    assert question.text.startswith("One last look")


def answer_wrongly() -> ReviewState:
    """A person shows that all legs are deleted, then says of another table that two hulls more are."""
    _, state = show_without()
    return replace(state, answers=(Answer(1, "t1", legs_of("t1") | {"drawer0_bottom", "handle0"}),))


def test_an_answer_that_alone_makes_a_rule_complicated_is_asked_about() -> None:
    question = ask_about_mistake(answer_wrongly())
    assert question is not None
    assert (question.asset, question.rule) == ("t1", 1)
    assert "rule 1 would just be Is(leg): were they selected on t1 by mistake?" in question.text


@pytest.mark.slow
def test_an_answer_that_was_meant_so_is_kept() -> None:
    state = answer_wrongly()
    question = ask_about_mistake(state)
    assert question is not None
    assert meant_by(question) == legs_of("t1")
    assert ask_about_mistake(snooze(state, question)) is None


def keep_label(state: ReviewState, hull: str) -> tuple[ReviewState, NeedsRepair]:
    """A person keeps a label that learning would change, since they said that the hull is selected too."""
    mesh = state.meshes["t1"]
    kept = mesh.with_labels({hull: Label(mesh.hull_of(hull).label or "", source="repair")})
    after = replace(state, meshes={**state.meshes, "t1": kept})
    repair = Repair(LabelFix("t1", hull, kept.hull_of(hull).label, "panel"), 1, 0.6, "it looks like one")
    outcome = NeedsRepair(rules=(), candidates=(), tried=(), seconds={}, repairs=(repair,))
    family = model_family(list(after.meshes.values()))
    question = review_family(after, outcome, family).question
    assert question is not None and question.kind == "repair"
    return snooze(after, question), outcome


def test_where_a_label_is_kept_that_nothing_fits_the_selection_is_asked_about(state: ReviewState) -> None:
    said = Answer(1, "t1", legs_of("t1") | {"handle0"})
    state, outcome = keep_label(replace(state, answers=(said,)), "handle0")
    question = review_family(state, outcome, model_family(list(state.meshes.values()))).question
    assert question is not None
    assert question.text == "handle0 is handle, and rule 1 selects it: was it selected on t1 by mistake?"
    assert meant_by(question) == legs_of("t1")
    on_purpose = snooze(state, question)
    last = review_family(on_purpose, outcome, model_family(list(state.meshes.values()))).question
    assert last is not None and (last.kind, last.asset) == ("demonstrate", "t1"), "what was said of it may be otherwise"


def test_a_hull_that_was_left_out_though_its_label_is_kept_is_asked_about(state: ReviewState) -> None:
    state, outcome = keep_label(replace(state, answers=(Answer(1, "t1", legs_of("t1") - {FORGOTTEN}),)), FORGOTTEN)
    question = ask_about_kept_label(state, outcome.repairs[0], 6.0)
    assert question is not None
    assert question.text == f"{FORGOTTEN} is leg, and rule 1 leaves it out: was it left out on t1 by mistake?"


def test_nothing_is_asked_of_a_label_that_nobody_gave_or_where_nothing_was_said(state: ReviewState) -> None:
    repair = Repair(LabelFix("t1", "handle0", "handle", "leg"), 1, 0.6, "it looks like one")
    answered = replace(state, answers=(Answer(1, "t1", legs_of("t1") | {"handle0"}),))
    assert ask_about_kept_label(answered, repair, 6.0) is None
    silent, outcome = keep_label(state, "handle0")
    assert ask_about_kept_label(silent, outcome.repairs[0], 6.0) is None
    gone = replace(silent, meshes={"t0": state.meshes["t0"]})
    assert ask_about_kept_label(gone, outcome.repairs[0], 6.0) is None
