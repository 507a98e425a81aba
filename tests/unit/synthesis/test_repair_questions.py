"""Repairs of labels that a person is asked about while a program is learned."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from itertools import count

import pytest

from meshforge.language import Is
from meshforge.symbolic import Label, SymbolicMesh
from meshforge.synthesis import (
    Ambiguous,
    Answer,
    Demonstration,
    Found,
    LabelFix,
    LearningOutcome,
    NeedsRepair,
    Options,
    Repair,
    TimedOut,
    outcome_to_json,
    synthesize,
)
from meshforge.synthesis.options import Strategy
from tests.synthesis_boxes import table
from tests.synthesis_cupboards import shown

VOCABULARY = ("drawer", "handle", "leg", "misc", "panel")
BATCH = {
    f"t{legs}{drawers}{litter}": table(legs, drawers, 0.1, litter)
    for legs in (3, 4)
    for drawers in (1, 2)
    for litter in (0, 1)
}
TRUE = {"one": table(), "two": table(drawers=2)}
LEG = LabelFix("one", "leg0_low", "drawer", "leg")
WRONG = {"leg0_low": "drawer"}


def labelled(mesh: SymbolicMesh, wrong: Mapping[str, str | None]) -> SymbolicMesh:
    labels: dict[str, Label | None] = {hull.name: Label(hull.label, 0.95, "vlm") for hull in mesh.hulls if hull.label}
    labels.update({name: Label(label, 0.6, "vlm") if label else None for name, label in wrong.items()})
    return mesh.with_labels(labels)


def planted(wrong: Mapping[str, str | None], program: str = "Is(leg) => Delete") -> list[Demonstration]:
    """Both tables shown as their true labels say; the first one has wrong labels."""
    one, two = shown(TRUE, ["one", "two"], program)
    return [
        Demonstration(labelled(one.mesh, wrong), one.steps, "one"),
        Demonstration(labelled(two.mesh, {}), two.steps, "two"),
    ]


class Person:
    def __init__(self, *right: LabelFix) -> None:
        self.right, self.asked = right, list[Repair]()

    def __call__(self, repair: Repair) -> bool:
        self.asked.append(repair)
        return repair.fix in self.right

    @property
    def corrections(self) -> list[LabelFix]:
        return [repair.fix for repair in self.asked]


def learned(
    demos: list[Demonstration],
    confirm: Callable[[Repair], bool] | None = None,
    options: Options | None = None,
    answers: tuple[Answer, ...] = (),
    rejected: tuple[LabelFix, ...] = (),
) -> LearningOutcome:
    return synthesize(
        demos,
        {name: labelled(mesh, {}) for name, mesh in BATCH.items()},
        vocabulary=VOCABULARY,
        options=replace(options or Options(max_size=9), rejected=rejected),
        confirm=confirm,
        answers=answers,
    )


def test_without_a_person_repairs_are_proposed_with_what_the_program_would_be() -> None:
    outcome = learned(planted(WRONG))
    assert isinstance(outcome, NeedsRepair)
    assert [repair.fix for repair in outcome.repairs] == [LEG]
    assert outcome.proposed
    assert [rule.extractor for rule in outcome.proposed.rules] == [Is("leg")]
    assert not outcome.unambiguous
    shape = outcome_to_json(outcome)
    (repair,) = shape["repairs"]
    assert (shape["status"], shape["program"], shape["open_rule"]) == ("repair", None, None)
    assert {**repair, "belief": None, "why": None} == {
        "rule": 1, "asset": "one", "hull": "leg0_low", "from": "drawer", "to": "leg", "belief": None, "why": None,
    }  # fmt: skip
    assert 0.5 < repair["belief"] <= 1
    assert repair["why"].endswith("with it, Is(leg) selects what was shown")


def test_what_is_confirmed_is_asked_once_and_learning_goes_on_with_it() -> None:
    person = Person(LEG)
    outcome = learned(planted(WRONG), person)
    clean = learned(planted({}))
    assert isinstance(outcome, Found | Ambiguous)
    assert person.corrections == [LEG]
    assert outcome.program == clean.program
    assert outcome.repairs == ()


def test_what_is_refused_is_asked_once_and_labels_stay() -> None:
    person = Person()
    outcome = learned(planted(WRONG), person)
    assert LEG in person.corrections
    assert len(person.corrections) == len(set(person.corrections))
    assert not isinstance(outcome, NeedsRepair)
    assert outcome.program == learned(planted(WRONG), options=Options(max_size=9, repair=False)).program


def test_what_was_refused_before_is_not_asked_at_all() -> None:
    person = Person(LEG)
    learned(planted(WRONG), person, rejected=(LEG,))
    assert LEG not in person.corrections


def test_the_reverse_of_what_was_confirmed_is_never_proposed() -> None:
    person = Person(LEG, LabelFix("one", "leg0_low", "leg", "drawer"))
    learned(planted(WRONG), person)
    assert all(correction.reverse not in person.corrections for correction in person.corrections)


def test_after_a_repair_for_a_later_rule_the_first_is_learned_anew() -> None:
    program = "Is(misc) => Delete\nIs(leg) => Delete"
    person = Person(LEG)
    outcome = learned(planted(WRONG, program), person)
    assert [repair.rule for repair in person.asked] == [2]
    assert outcome.program == learned(planted({}, program)).program


def test_a_person_is_asked_only_so_often_about_a_mesh_over_all_rules_and_rounds() -> None:
    program = "Is(leg) => Delete\nIs(misc) => Delete\nIs(handle) => Delete"
    wrong = {"leg0_low": "drawer", "leg3_high": "panel", "handle0": "drawer", "residue_0": "panel"}
    right = [LabelFix("one", hull, was, TRUE["one"].hull_of(hull).label or "") for hull, was in wrong.items()]
    person = Person(*right)
    learned(planted(wrong, program), person, Options(max_size=9, eta=2))
    agreed = [correction for correction in person.corrections if correction in right]
    assert len(agreed) == 2
    more = Person(*right)
    outcome = learned(planted(wrong, program), more, Options(max_size=9, eta=4))
    assert sorted(correction for correction in more.corrections if correction in right) == sorted(right)
    assert outcome.program == learned(planted({}, program)).program


def test_repair_that_is_switched_off_asks_nothing() -> None:
    person = Person(LEG)
    learned(planted(WRONG), person, Options(max_size=9, repair=False))
    assert person.asked == []
    learned(planted(WRONG), person, Options(max_size=9, eta=0))
    assert person.asked == []


def test_an_answer_may_show_that_a_label_of_the_batch_is_wrong() -> None:
    meshes = {name: labelled(mesh, WRONG if name == "t410" else {}) for name, mesh in BATCH.items()}
    legs = {hull.name for hull in BATCH["t410"].hulls if hull.label == "leg"}
    person = Person(LabelFix("t410", "leg0_low", "drawer", "leg"))
    outcome = synthesize(
        planted({}), meshes, vocabulary=VOCABULARY, confirm=person, answers=[Answer(1, "t410", legs)],
        options=Options(max_size=9),
    )  # fmt: skip
    assert isinstance(outcome, Found | Ambiguous)
    assert person.corrections == list(person.right)
    assert [rule.extractor for rule in outcome.rules] == [Is("leg")]
    assert outcome.stale == ()


@pytest.mark.parametrize("strategy", ["default", "paper"])
def test_time_does_not_run_while_a_person_thinks(strategy: Strategy) -> None:
    ticks, thought = count(), [0.0]

    def thinking(repair: Repair) -> bool:
        thought[0] += 1e6
        return repair.fix == LEG

    outcome = synthesize(
        planted(WRONG),
        vocabulary=VOCABULARY,
        confirm=thinking,
        options=Options(strategy=strategy, max_size=9, budget=1e5, clock=lambda: next(ticks) + thought[0]),
    )
    assert thought[0] > 0
    assert not isinstance(outcome, TimedOut)
    assert sum(outcome.seconds.values()) < 1e5


def test_a_person_who_stops_while_being_asked_is_not_asked_again() -> None:
    asked: list[Repair] = []

    def confirm(repair: Repair) -> bool:
        asked.append(repair)
        return False

    program = "Union(Is(leg), Is(handle)) => Delete"
    options = Options(stop=lambda: bool(asked))
    outcome = synthesize(planted(WRONG, program), vocabulary=VOCABULARY, confirm=confirm, options=options)
    assert len(asked) == 1
    assert isinstance(outcome, TimedOut)
    assert outcome.program is None


def test_the_strategy_of_the_paper_asks_by_rule_once_and_learns_on() -> None:
    person = Person(LEG)
    outcome = learned(planted(WRONG), person, Options(strategy="paper", max_size=9))
    assert isinstance(outcome, Found)
    assert [rule.extractor for rule in outcome.rules] == [Is("leg")]
    assert len(person.corrections) == len(set(person.corrections))
    assert {repair.rule for repair in person.asked} == {1}


def test_the_strategy_of_the_paper_says_of_several_corrections_that_they_go_together() -> None:
    outcome = learned(planted({"leg0_low": "drawer", "leg1_low": "drawer"}), options=Options(strategy="paper"))
    assert isinstance(outcome, NeedsRepair)
    for repair in outcome.repairs:
        said = "with it" if len(outcome.repairs) == 1 else "with all corrections"
        assert repair.why.startswith(f"{said}, ")
