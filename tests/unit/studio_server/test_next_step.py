from __future__ import annotations

from collections.abc import Sequence

import pytest

from meshforge.labels import LabelOffers
from meshforge.studio.queries.project import Lookups, choose_next_step
from meshforge.studio.wire.family import Card, Next
from meshforge.studio.wire.jobs import PropagationState
from meshforge.studio.wire.program import NearestView, OutcomeView
from meshforge.studio.wire.signoff import AssessmentView, ConfidenceView, QuestionKind, ReviewQuestionView

BARE = Card(asset="a", hulls=2, labels=(-1, -1))
BEGUN = Card(asset="a", hulls=2, labels=(0, -1))
LABELLED = Card(asset="a", hulls=2, labels=(0, 0))
SHOWN = LABELLED.model_copy(update={"demonstrated": True})
DONE = SHOWN.model_copy(update={"output": "edited"})
FOUND = OutcomeView(number=1, status="found", program="labels leg\nIs(leg) => Delete\n")


def suggest_last(assets: Sequence[str]) -> str | None:
    return assets[-1] if len(assets) > 1 else None


last = Lookups(suggest_last)


def stage(
    card: Card, *, words: tuple[str, ...] = ("leg",), program: bool = False, outcome: OutcomeView | None = None
) -> str:
    return choose_next_step([card], words, program, outcome, None, last).stage


def test_the_stages_follow_one_another() -> None:
    assert stage(Card(asset="a", hulls=0, sources=1)) == "label"
    assert stage(BARE, words=()) == "label"
    assert stage(BARE) == "label"
    assert stage(BEGUN) == "label"
    assert stage(LABELLED) == "demonstrate"
    assert stage(SHOWN, outcome=FOUND) == "learn"
    assert stage(SHOWN, program=True, outcome=FOUND) == "review"
    assert stage(DONE, program=True, outcome=FOUND) == "review"


def test_labels_that_are_there_already_are_taken_first() -> None:
    def say(card: Card, offers: LabelOffers, words: tuple[str, ...] = (), program: bool = False) -> str:
        return choose_next_step([card], words, program, None, None, Lookups(suggest_last, lambda: offers)).say

    files, names = LabelOffers(files=("a", "b")), LabelOffers(names={"a": {"h": "leg"}})
    assert say(BARE, files) == "Labels files lie beside 2 assets: take their labels."
    assert say(BARE, names, ("leg",)) == "The names of 1 hull say a label: take their labels."
    for offers in (files, names):
        assert "take" not in say(BEGUN, offers, ("leg",)) and "take" not in say(SHOWN, offers, ("leg",))
        assert "take" not in say(BARE, offers, ("leg",), program=True), "it asks for no labels: it is applied"
    assert say(BARE, LabelOffers()) == "Name what hulls can be: the labels of this family."


def test_the_step_names_the_asset_to_go_to() -> None:
    begun = BEGUN.model_copy(update={"asset": "b"})
    assert choose_next_step([BARE, begun], ("leg",), False, None, None, last).asset == "b"
    repairing = OutcomeView(number=1, status="repair", repairs=2)
    step = choose_next_step([SHOWN], ("leg",), True, repairing, None, last)
    assert (step.stage, step.say) == ("learn", "2 labels may be wrong: answer the question.")
    wrong = DONE.model_copy(update={"asset": "d", "review": "wrong"})
    assert choose_next_step([DONE, wrong], ("leg",), True, FOUND, None, last).asset == "d"
    assert choose_next_step([DONE], ("leg",), True, FOUND, None, last).asset == "a"


def test_the_asset_that_tells_most_is_shown_first_and_without_one_the_first_with_labels() -> None:
    other = LABELLED.model_copy(update={"asset": "b"})
    step = choose_next_step([LABELLED, other], ("leg",), False, None, None, last)
    assert (step.asset, step.say) == ("b", "Show the first step of the edit on one asset, best on b.")
    step = choose_next_step([LABELLED], ("leg",), False, None, None, last)
    assert (step.asset, step.say) == ("a", "Show the first step of the edit on one asset.")


def test_the_results_that_tell_most_are_looked_at_first_as_far_as_nobody_reviewed_them() -> None:
    cards = {asset: DONE.model_copy(update={"asset": asset}) for asset in "abcd"}
    outcome = FOUND.model_copy(update={"sample": ("d", "gone", "b", "c")})

    def step_with(*accepted: str) -> Next:
        seen = [c.model_copy(update={"review": "accepted"}) if c.asset in accepted else c for c in cards.values()]
        return choose_next_step(seen, ("leg",), True, outcome, None, last)

    step = step_with()
    assert (step.stage, step.asset) == ("review", "d")
    assert step.say == "Look at 3 results that show best whether the program is right, first d."
    step = step_with("d")
    assert (step.asset, step.say) == ("b", "Look at 2 results that show best whether the program is right, first b.")
    step = step_with("d", "b")
    assert (step.asset, step.say) == ("c", "Look at 1 result that shows best whether the program is right: c.")
    step = step_with("d", "b", "c")
    assert (step.asset, step.say) == ("a", "Look through the results: 1 asset to judge.")
    assert "export" in step_with(*cards).say


def test_a_wrong_result_comes_before_those_that_tell_most() -> None:
    wrong = DONE.model_copy(update={"asset": "b", "review": "wrong"})
    telling = FOUND.model_copy(update={"sample": ("a", "b")})
    assert choose_next_step([DONE, wrong], ("leg",), True, telling, None, last).asset == "b"


def test_at_the_end_there_is_only_the_export() -> None:
    accepted = DONE.model_copy(update={"review": "accepted"})
    assert "export" in choose_next_step([accepted], ("leg",), True, FOUND, None, last).say


def test_a_run_without_a_program_leads_to_what_came_nearest_and_does_not_repeat_its_reasons() -> None:
    near = NearestView(rule=2, extractor="Is(leg)", asset="b", extra=(), missing=("h",))
    failed = OutcomeView(number=1, status="none", why="no extractor of up to 9 symbols", nearest=near)
    step = choose_next_step([SHOWN], ("leg",), False, failed, None, last)
    assert (step.stage, step.asset) == ("learn", "b")
    assert step.say == "No selection fits rule 2 yet: see what comes nearest."
    for status in ("none", "timeout", "error"):
        over = OutcomeView(number=1, status=status, why="a long reason", error="a long\n  message")
        assert "long" not in choose_next_step([SHOWN], ("leg",), False, over, None, last).say


WHOLE = Card(asset="w", hulls=2, labels=(0, 0), given=2)
DOUBTFUL = Card(asset="d", hulls=5, labels=(0,) * 5, unsure=(1, 2, 3))


def labelling(*cards: Card, carried: PropagationState | None = None, program: bool = False) -> Next:
    return choose_next_step(cards, ("leg",), program, None, None, last, carried)


def test_labels_of_a_labelled_asset_are_carried_over_to_those_that_have_none() -> None:
    step = labelling(BARE, WHOLE)
    assert (step.stage, step.say) == ("label", "a has no label: propagate labels.")
    assert labelling(BARE, BARE.model_copy(update={"asset": "b"}), WHOLE).say.startswith("2 assets have no label")
    assert "propagate" not in labelling(BARE, BEGUN.model_copy(update={"asset": "b"})).say, "none is whole"
    assert "propagate" not in labelling(BARE, WHOLE.model_copy(update={"given": 1})).say, "a machine labelled it"


def test_hulls_without_a_label_are_labelled_before_anything_is_demonstrated() -> None:
    most = Card(asset="c1", hulls=100, labels=(0,) * 30 + (-1,) * 70)
    rest = Card(asset="c2", hulls=36, labels=(0,) * 11 + (-1,) * 25)
    step = labelling(most, rest)
    assert (step.stage, step.asset) == ("label", "c2")
    assert step.say == "95 of 136 hulls have no label: label those of c2."
    assert labelling(most, rest, WHOLE).say == "95 of 138 hulls have no label: propagate labels."
    again = labelling(most, rest, WHOLE, carried=PropagationState(unused=0))
    assert again.asset == "c2", "propagation left them"
    assert labelling(most, rest.model_copy(update={"demonstrated": True})).stage != "label", "who went on is let go on"
    assert labelling(BEGUN).say == "1 of 2 hulls has no label: label those of a."


def test_unsure_labels_are_looked_through_unless_something_else_is_less_work() -> None:
    step = labelling(WHOLE, DOUBTFUL)
    assert (step.stage, step.asset, step.say) == ("label", "d", "3 labels are unsure: press N.")
    best = PropagationState(unused=0, next="d")
    assert labelling(WHOLE, DOUBTFUL, carried=best).say == step.say, "to label it is more work"
    nearly = DOUBTFUL.model_copy(update={"asset": "n", "given": 4, "unsure": ()})
    step = labelling(WHOLE, DOUBTFUL, nearly, carried=PropagationState(unused=0, next="n"))
    assert (step.asset, step.say) == ("n", "3 labels are unsure: label n next.")


def test_what_was_said_is_used_when_it_outweighs_what_is_unsure() -> None:
    step = labelling(WHOLE, DOUBTFUL, carried=PropagationState(unused=3))
    assert step.say == "Propagate labels again: 3 labels of yours not used yet."
    assert "press N" in labelling(WHOLE, DOUBTFUL, carried=PropagationState(unused=2)).say


def test_who_has_begun_to_demonstrate_is_not_told_to_label() -> None:
    assert labelling(BARE, WHOLE, DOUBTFUL, program=True).stage == "review"
    shown = WHOLE.model_copy(update={"demonstrated": True})
    assert labelling(BARE, shown, DOUBTFUL, carried=PropagationState(unused=9)).stage != "label"


def signed_off(probabilities: Sequence[float], *, asked: QuestionKind | None = None, unseen: int = 0) -> AssessmentView:
    rows = [
        ConfidenceView(asset=name, probability=p, state="signed" if p >= 0.95 else "held")
        for name, p in zip("abcd", probabilities, strict=False)
    ]
    held = sum(row.state == "held" for row in rows)
    question = ReviewQuestionView(id="q", kind=asked, text="?", seconds=1.0, gain=1.0, asset="b") if asked else None
    return AssessmentView(
        number=1, bar=0.95, signed_off=len(rows) - held, held=held, unseen=unseen, assets=tuple(rows), question=question
    )


@pytest.mark.parametrize(
    ("assessment", "step"),
    [
        (signed_off([0.99, 0.4], asked="group"), ("learn", "1 of 2 held: answer the question.", "b")),
        (signed_off([0.1, 0.4], asked="result"), ("review", "2 of 2 held: look at one result.", "b")),
        (signed_off([0.6, 0.4, 0.99]), ("review", "2 of 3 held: look at them, first b.", "b")),
        (signed_off([0.99, 0.98], asked="group"), ("review", "2 results signed off: export.", None)),
        (signed_off([0.99], unseen=3), ("review", "Look through the results: 1 asset to judge.", "a")),
    ],
)
def test_nothing_is_exported_before_all_is_signed_off(
    assessment: AssessmentView, step: tuple[str, str, str | None]
) -> None:
    found = choose_next_step([DONE], ("leg",), True, FOUND, None, last, None, assessment)
    assert (found.stage, found.say, found.asset) == step


def test_what_is_asked_comes_before_results_are_written_and_what_is_wrong_before_the_end() -> None:
    held, done = signed_off([0.1, 0.99], asked="reading"), signed_off([0.99, 0.99])
    assert choose_next_step([SHOWN], ("leg",), True, FOUND, None, last, None, held).say.startswith("1 of 2 held")
    assert choose_next_step([SHOWN], ("leg",), True, FOUND, None, last, None, done).say.startswith("Apply the program")
    wrong = DONE.model_copy(update={"asset": "d", "review": "wrong"})
    assert choose_next_step([DONE, wrong], ("leg",), True, FOUND, None, last, None, done).asset == "d"
