"""The seconds by which the tool orders its questions are those by which the benchmark counts a person's time."""

import pytest

from benchmark.study import keystrokes
from benchmark.study.lookalikes import LookAlikes
from meshforge.label_model import similar
from meshforge.language import Delete
from meshforge.signoff import question as prices
from meshforge.synthesis import Demonstration, Step
from tests.synthesis_boxes import table


def test_prices_of_questions_are_those_of_the_keystroke_model() -> None:
    assert pytest.approx(keystrokes.ANSWER) == prices.CANDIDATE
    assert pytest.approx(keystrokes.CONFIRMATION) == prices.YES_OR_NO
    assert (keystrokes.KEY, keystrokes.GROUP_HULL) == (similar.KEY, similar.LOOK)
    assert prices.price_group(7, 2) == pytest.approx(keystrokes.price_group(7, 2))


def test_a_demonstration_costs_what_it_took_before() -> None:
    shown = Demonstration(table(), [Step(1, {"top_0", "top_1"}, Delete()), Step(2, {"shelf"}, Delete())], "t")
    want = keystrokes.DEMONSTRATION + 2 * keystrokes.RULE + 3 * keystrokes.HULL
    assert prices.price_demonstration([shown]) == pytest.approx(want)


@pytest.mark.parametrize(
    ("alike", "looks", "clicks", "keys"),
    [
        ("abc", 2, 1, 1),  # the key finds the other two
        ("abcx", 3, 2, 1),  # and one that is not meant, which is clicked
        ("ax", 1, 4, 2),  # only one that is not: left, and the next hulls are selected one by one
        ("a", 0, 3, 2),  # nothing: likewise
    ],
)
def test_selecting_by_look_alikes_costs_clicks_keys_and_looks(alike: str, looks: int, clicks: int, keys: int) -> None:
    seconds = keystrokes.price_selection("abc", lambda hull: frozenset(alike if hull == "a" else hull))
    want = looks * keystrokes.GROUP_HULL + clicks * keystrokes.CLICK + keys * keystrokes.KEY
    assert seconds == pytest.approx(want)


def test_look_alikes_are_those_of_one_press_of_the_key() -> None:
    alike = LookAlikes(table())
    assert alike.find("leg0_low") == {"leg0_low", "leg1_low", "leg2_low", "leg3_low"}
    assert alike.find("made~1") == {"made~1"}
