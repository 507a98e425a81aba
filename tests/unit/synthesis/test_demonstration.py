"""Steps and demonstrations, and what contradicts itself in them."""

import pytest

from meshforge.common import DemonstrationError
from meshforge.language import Action, Delete, Each, Merge, Replace
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, Found, Step, synthesize
from tests.synthesis_boxes import boxes


def pair(gap: float) -> SymbolicMesh:
    """Two legs, so far apart [m], and a panel."""
    return boxes(
        ("one", "leg", (0, 0, 0), (1, 1, 1)),
        ("two", "leg", (1 + gap, 0, 0), (1, 1, 1)),
        ("top", "panel", (0, 0, 3), (3, 1, 1)),
    )


def message_of(*demos: Demonstration) -> str:
    with pytest.raises(DemonstrationError) as caught:
        synthesize(demos)
    return str(caught.value)


def shown(mesh: SymbolicMesh, action: Action, name: str, label: str | None = None) -> Demonstration:
    return Demonstration(mesh, [Step(1, {"one", "two"}, action, label)], name)


def test_a_step_is_shown_or_nothing_or_open() -> None:
    steps = [Step(1, ["a"], Delete()), Step(2, [], Delete()), Step(3, None, Delete())]
    assert [(step.shown, step.open) for step in steps] == [(True, False), (False, False), (False, True)]


def test_a_selection_given_as_text_is_refused() -> None:
    with pytest.raises(DemonstrationError, match="a set of hull names, not the text 'leg'"):
        Step(1, "leg", Delete())


def test_steps_that_are_not_numbered_in_order_are_refused() -> None:
    with pytest.raises(DemonstrationError, match=r"t1: the steps are numbered 1, 3\n  Number them 1 to 2"):
        Demonstration(pair(1), [Step(1, {"one"}, Delete()), Step(3, {"two"}, Delete())], "t1")


def test_no_steps_at_all_are_refused() -> None:
    assert "no demonstrated step" in message_of(Demonstration(pair(1), []))
    assert "no demonstrated step" in message_of()


def test_a_rule_that_is_shown_nowhere_is_refused() -> None:
    steps = [Step(1, {"one", "two"}, Delete()), Step(2, [], Delete())]
    other = [Step(1, {"one", "two"}, Delete()), Step(2, None, Delete())]
    assert "rule 2 selects no hull in any demonstration" in message_of(
        Demonstration(pair(1), steps), Demonstration(pair(1), other)
    )


def test_actions_that_differ_are_refused_with_both_demonstrations_named() -> None:
    text = message_of(shown(pair(1), Delete(), "t1"), shown(pair(1), Replace("box"), "t2"))
    assert "rule 1 does Delete in t1, but Replace(box) in t2" in text


def test_actions_count_only_where_the_step_is_shown() -> None:
    silent = Demonstration(boxes(("top", "panel", (0, 0, 0), (1, 1, 1))), [Step(1, [], Delete())])
    outcome = synthesize([shown(pair(1), Each(Merge()), "t1"), silent])
    assert isinstance(outcome, Found)
    assert outcome.program.rules[0].action == Each(Merge())


def test_merge_agrees_with_each_merge_where_it_is_done_on_one_component() -> None:
    for demos in (
        [shown(pair(1), Each(Merge()), "t1"), shown(pair(0), Merge(), "t2")],
        [shown(pair(0), Merge(), "t2"), shown(pair(1), Each(Merge()), "t1")],
    ):
        outcome = synthesize(demos)
        assert isinstance(outcome, Found)
        assert outcome.program.rules[0].action == Each(Merge())


def test_merge_of_two_parts_contradicts_each_merge() -> None:
    text = message_of(shown(pair(1), Each(Merge()), "t1"), shown(pair(1), Merge(), "t2"))
    assert "rule 1 does Merge in t2 on 2 parts that do not touch, but Each(Merge) in t1" in text


def test_an_unknown_hull_is_refused_with_the_nearest_name() -> None:
    text = message_of(Demonstration(pair(1), [Step(1, {"tow"}, Delete())], "t1"))
    assert text == "t1, rule 1: there is no hull 'tow'\n  Did you mean 'two'?"


def test_a_hull_that_an_earlier_rule_removed_is_refused_as_such() -> None:
    steps = [Step(1, {"one", "two"}, Delete()), Step(2, {"one"}, Delete())]
    assert "the hull 'one' is gone: an earlier rule" in message_of(Demonstration(pair(1), steps, "t1"))


def test_a_label_outside_the_given_vocabulary_is_refused_with_the_nearest() -> None:
    with pytest.raises(DemonstrationError, match="the label 'panel' is not in the vocabulary") as caught:
        synthesize([shown(pair(1), Delete(), "t1")], vocabulary=["leg", "panels"])
    assert "t1, hull 'top'" in str(caught.value)
    assert "Did you mean 'panels'?" in str(caught.value)
    with pytest.raises(DemonstrationError, match="the label 'bar' is not in the vocabulary"):
        synthesize([shown(pair(1), Merge(), "t1", label="bar")], vocabulary=["leg", "panel"])
