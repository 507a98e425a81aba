"""Answers to questions: taken, declined, stale, contradicting; and about hulls that earlier rules make."""

import json

import pytest

from benchmark.learning.families import family
from benchmark.learning.targets import extractors_of
from meshforge.language import Delete, Merge, show
from meshforge.synthesis import (
    Ambiguous,
    Answer,
    Demonstration,
    Found,
    LearningOutcome,
    NoProgram,
    Options,
    Step,
    outcome_to_json,
    synthesize,
)
from tests.open_rules import answer_truly, choose
from tests.synthesis_cupboards import cupboard, cupboards, meant, selected, shown, with_rare_doors

MESHES = with_rare_doors()
DEMOS = shown(MESHES, ["c0"], "Is(handle) => Delete")
BOTH, BY_DRAWER, BY_DOOR = {"pull", "knob"}, {"pull"}, {"knob"}


def learned(*answers: Answer, demos: list[Demonstration] = DEMOS) -> LearningOutcome:
    return synthesize(demos, MESHES, answers=answers, options=Options(repair=False))


def rules(outcome: LearningOutcome) -> list[str]:
    return [show(rule.extractor) for rule in outcome.rules]


@pytest.mark.parametrize("choice", [0, 1, 2])
def test_a_choice_that_is_taken_is_what_the_program_selects(choice: int) -> None:
    asked = learned()
    assert isinstance(asked, Ambiguous)
    answer = choose(asked.open_rule, choice)
    outcome = learned(answer)
    assert isinstance(outcome, Found)
    assert outcome.unambiguous
    assert selected(outcome.program, 1, MESHES[answer.asset]) == answer.select
    assert selected(outcome.program, 1, MESHES["c0"]) == {"pull"}


@pytest.mark.slow
def test_every_choice_of_every_question_about_a_family_can_be_taken() -> None:
    meshes = {f"t{k}": mesh for k, mesh in enumerate(family("table", 12, seed=5))}
    asked = 0
    for extractor in map(show, extractors_of("table")):
        names = [name for name, mesh in meshes.items() if meant(extractor, mesh)][:1]
        demos = shown(meshes, names, f"{extractor} => Delete")
        outcome = synthesize(demos, meshes, options=Options(repair=False)) if demos else None
        for choice in range(len(outcome.open_rule.selections) if outcome and outcome.open_rule else 0):
            assert outcome
            assert outcome.open_rule
            answer = choose(outcome.open_rule, choice)
            taken = synthesize(demos, meshes, answers=[answer], options=Options(repair=False))
            assert isinstance(taken, Found | Ambiguous)
            assert selected(taken.program, 1, meshes[answer.asset]) == answer.select
            assert not taken.open_rule or taken.open_rule.asset != answer.asset
            asked += 1
    assert asked > 10


def test_neither_is_taken_note_of_and_not_asked_again_on_that_asset() -> None:
    answers: list[Answer] = []
    for _ in range(len(MESHES)):
        outcome = learned(*answers)
        if not isinstance(outcome, Ambiguous):
            break
        assert outcome.open_rule.asset not in {answer.asset for answer in answers}
        answers.append(choose(outcome.open_rule, None))
    assert isinstance(outcome, Found)
    assert len({answer.asset for answer in answers}) == len(answers) > 1
    assert not outcome.unambiguous, "what was declined is still open"


def test_what_was_refused_on_an_asset_is_believed_less() -> None:
    asked = learned()
    assert isinstance(asked, Ambiguous)
    mesh, refused = MESHES[asked.open_rule.asset], asked.open_rule.selections
    offered = {show(one.extractor) for one in asked.candidates if meant(show(one.extractor), mesh) in refused}
    after = learned(choose(asked.open_rule, None))
    before = {show(reading.extractor): reading.belief for reading in asked.candidates}
    others = [reading for reading in after.candidates if show(reading.extractor) not in before.keys() & offered]
    assert sum(reading.belief for reading in others) > sum(before[show(reading.extractor)] for reading in others)


def test_an_answer_is_evidence_for_its_rule_only() -> None:
    demos = shown(MESHES, ["c0"], "Is(body) => Delete\nIs(handle) => Delete")
    assert rules(learned(Answer(2, "c1", BOTH), demos=demos)) == ["Is(body)", "Is(handle)"]
    assert rules(learned(Answer(2, "c1", BY_DRAWER), demos=demos))[0] == "Is(body)"


def test_nothing_is_an_answer_too() -> None:
    outcome = learned(Answer(1, "c1", []))
    assert isinstance(outcome, Found | Ambiguous)
    assert selected(outcome.program, 1, MESHES["c1"]) == frozenset()
    assert selected(outcome.program, 1, MESHES["c0"]) == {"pull"}


def test_of_several_answers_to_one_question_the_last_counts() -> None:
    assert rules(learned(Answer(1, "c1", BY_DOOR), Answer(1, "c1", BOTH))) == rules(learned(Answer(1, "c1", BOTH)))
    taken_back = learned(Answer(1, "c1", BOTH), Answer(1, "c1", None))
    assert rules(taken_back) == rules(learned(Answer(1, "c1", None)))
    assert taken_back.open_rule == learned(Answer(1, "c1", None)).open_rule


def test_a_demonstration_stands_against_an_answer_about_the_same_mesh() -> None:
    assert rules(learned(Answer(1, "c0", {"drawer"}))) == rules(learned())


def test_an_answer_fills_the_open_step_of_a_demonstrated_mesh() -> None:
    open_ = Demonstration(MESHES["c1"], [Step(1, None, Delete())], "c1")
    for wanted in (BOTH, BY_DRAWER):
        outcome = learned(Answer(1, "c1", wanted), demos=[*DEMOS, open_])
        assert isinstance(outcome, Found | Ambiguous)
        assert outcome.stale == ()
        assert selected(outcome.program, 1, MESHES["c1"]) == wanted


def test_a_question_may_be_about_the_open_step_of_a_demonstrated_mesh() -> None:
    open_ = Demonstration(MESHES["c1"], [Step(1, None, Delete())], "c1")
    outcome = synthesize([*DEMOS, open_], options=Options(repair=False))
    assert isinstance(outcome, Ambiguous)
    assert outcome.open_rule.asset == "c1"


def test_an_answer_may_name_what_an_earlier_rule_makes() -> None:
    steps = [Step(1, {"drawer", "pull"}, Merge(), "unit"), Step(2, {"drawer~1"}, Delete())]
    demo = Demonstration(MESHES["c0"], steps, "c0")
    batch = {"c2": MESHES["c2"], "c4": MESHES["c4"]}
    outcome = synthesize([demo], batch, answers=[Answer(2, "c2", {"drawer~1"})], options=Options(repair=False))
    assert isinstance(outcome, Found | Ambiguous)
    assert outcome.stale == ()
    assert selected(outcome.program, 2, MESHES["c2"]) == {"drawer~1"}


@pytest.mark.parametrize(
    "answer",
    [
        Answer(1, "gone", {"pull"}),
        Answer(1, "gone", None),
        Answer(1, "c1", {"pull", "gone"}),
        Answer(1, "c1", {"drawer~1"}),
        Answer(2, "c1", {"pull"}),
        Answer(0, "c1", {"pull"}),
    ],
)
def test_an_answer_about_what_is_not_there_is_stale_and_counts_for_nothing(answer: Answer) -> None:
    outcome, without = learned(answer), learned()
    assert outcome.stale == (answer,)
    assert rules(outcome) == rules(without)
    assert outcome.open_rule == without.open_rule


def test_stale_answers_are_told_once_even_where_labels_are_repaired_and_a_rule_is_learned_again() -> None:
    meshes = {**cupboards(12), "shown": cupboard(True, 2)}
    wrong = meshes["shown"].with_labels({"knob": None})
    demo = Demonstration(wrong, [Step(1, {"pull", "knob"}, Delete())], "shown")
    stale = Answer(1, "c1", {"gone"})
    outcome = synthesize([demo], meshes, answers=[stale, stale])
    assert outcome.status == "repair"
    assert outcome.stale == (stale,)


def test_an_answer_that_no_extractor_agrees_with_leaves_no_program_and_says_what_can_be_taken_back() -> None:
    alike = {"c0": MESHES["c0"], "x": cupboard()}
    outcome = synthesize(DEMOS, alike, answers=[Answer(1, "x", {"drawer"})], options=Options(repair=False))
    assert isinstance(outcome, NoProgram)
    assert "an answer was given for x: it can be taken back" in outcome.advice
    json.dumps(outcome_to_json(outcome))


def test_answers_to_every_question_end_in_a_program_that_agrees_with_all_of_them() -> None:
    answers: list[Answer] = []
    outcome = learned()
    while isinstance(outcome, Ambiguous):
        truth = meant("Attach(Is(handle), Is(drawer))", MESHES[outcome.open_rule.asset])
        answers.append(answer_truly(outcome.open_rule, truth))
        assert len(answers) <= len(MESHES)
        outcome = learned(*answers)
    assert isinstance(outcome, Found)
    for answer in answers:
        assert answer.select is None or selected(outcome.program, 1, MESHES[answer.asset]) == answer.select
