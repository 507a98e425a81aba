"""What is at stake between readings, and which question settles most of it."""

import pytest

from meshforge.synthesis.candidates.rank import MAX_CHOICES, QUESTION_PRICE, SAMPLE_SEEN, UNSEEN_COST, QuestionValue


def askable(*assets: int) -> dict[int, float]:
    """Assets that can be asked about, all labels sure."""
    return dict.fromkeys(assets, 1.0)


@pytest.mark.parametrize(
    ("selections", "beliefs"),
    [([["a", "b"], ["a", "b"]], [0.6, 0.4]), ([["a", "b"]], [1.0]), ([[], []], [0.5, 0.5])],
    ids=["that agree everywhere", "one alone", "without assets"],
)
def test_readings_that_leave_nothing_open_raise_no_question(selections: list[list[str]], beliefs: list[float]) -> None:
    doubt = QuestionValue(selections, beliefs)
    assert doubt.best_question(askable(*range(len(selections[0])))) is None


def test_what_differs_everywhere_is_seen_and_costs_a_demonstration() -> None:
    for belief, worth in ((QUESTION_PRICE * 0.99, False), (QUESTION_PRICE * 1.01, True)):
        best = QuestionValue([["a"] * 5, ["b"] * 5], [1 - belief, belief]).best_question(askable(*range(5)))
        assert best is not None
        assert best.spared == pytest.approx(belief)
        assert best.is_worth_asking is worth


def test_what_differs_on_few_assets_is_likely_not_seen_and_costs_more() -> None:
    best = QuestionValue([["a"] * 50, ["a"] * 49 + ["b"]], [0.9, 0.1]).best_question(askable(*range(50)))
    assert best is not None
    assert best.asset == 49
    assert best.spared == pytest.approx(0.1 * (1 + UNSEEN_COST * 0.98**SAMPLE_SEEN))


def test_the_best_question_tells_most_apart_and_of_equals_is_about_the_first_asset() -> None:
    selections = [["a", "a", "a", "a"], ["a", "b", "b", "b"], ["a", "a", "c", "c"]]
    doubt = QuestionValue(selections, [0.5, 0.3, 0.2])
    best = doubt.best_question(askable(*range(4)))
    assert best is not None
    assert best.asset == 2
    assert doubt.best_question(askable(3, 1)) == doubt.best_question(askable(1, 3))
    assert doubt.best_question(askable(0)) is None


def test_an_answer_where_labels_are_doubtful_is_worth_less() -> None:
    doubt = QuestionValue([["a", "a", "a"], ["a", "b", "b"]], [0.7, 0.3])
    for trust, asset in (({1: 1.0, 2: 1.0}, 1), ({1: 0.5, 2: 0.6}, 2), ({0: 1.0, 1: 0.1, 2: 0.0}, 1)):
        best = doubt.best_question(trust)
        assert best is not None
        assert best.asset == asset
        assert best.spared == pytest.approx(0.3 * (1 + UNSEEN_COST * (1 / 3) ** SAMPLE_SEEN)), (
            "what it spares is as much"
        )


def test_choices_are_told_apart_the_most_believed_first_and_each_stands_for_its_most_believed_reading() -> None:
    best = QuestionValue([["a"], ["b"], ["a"], ["b"], ["c"]], [0.1, 0.15, 0.25, 0.3, 0.2]).best_question(askable(0))
    assert best is not None
    assert best.choices == (3, 0, 4), "the program's own reading stands for its choice, whatever is believed"


def test_a_person_compares_three_pictures_at_most() -> None:
    best = QuestionValue([[k] for k in range(7)], [0.4, *[0.1] * 6]).best_question(askable(0))
    assert best is not None
    assert best.choices == (0, 1, 2)
    assert len(best.choices) == MAX_CHOICES
