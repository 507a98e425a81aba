"""Like steps put together."""

from __future__ import annotations

from meshforge.language import Action, Delete, Each, Merge, Replace, to_canonical_frame
from meshforge.synthesis import Demonstration, Found, Step, merge_steps, synthesize
from tests.synthesis_boxes import table

TABLE = table()


def leg(k: int) -> set[str]:
    return {f"leg{k}_low", f"leg{k}_high"}


def steps(*done: tuple[set[str] | None, Action]) -> list[Step]:
    return [Step(number, select, action) for number, (select, action) in enumerate(done, 1)]


def test_four_legs_merged_one_by_one_are_one_each_step() -> None:
    one_by_one = steps(*((leg(k), Merge()) for k in range(4)))
    every = leg(0) | leg(1) | leg(2) | leg(3)
    assert merge_steps(one_by_one, TABLE) == (Step(1, every, Each(Merge())),)


def test_steps_put_together_do_what_they_did_one_by_one() -> None:
    one_by_one = steps(*((leg(k), Merge()) for k in range(4)))
    names = []
    for shown in (one_by_one, merge_steps(one_by_one, TABLE)):
        outcome = synthesize([Demonstration(TABLE, shown)])
        assert isinstance(outcome, Found)
        names.append({hull.name for hull in outcome.program.run(TABLE).mesh.hulls})
    assert names[0] == names[1]


def test_deletes_in_a_row_are_one_whether_they_touch_or_not() -> None:
    shown = steps(({"top_0"}, Delete()), ({"top_1"}, Delete()), ({"residue_0"}, Delete()))
    assert merge_steps(shown, TABLE) == (Step(1, {"top_0", "top_1", "residue_0"}, Delete()),)


def test_like_steps_on_parts_that_touch_stay_apart() -> None:
    shown = steps(({"top_0"}, Replace("box")), ({"top_1"}, Replace("box")))
    assert merge_steps(shown, TABLE) == tuple(shown)


def test_a_step_on_several_parts_at_once_is_no_each() -> None:
    shown = steps((leg(0) | leg(1), Merge()), (leg(2), Merge()))
    assert merge_steps(shown, TABLE) == tuple(shown)


def test_an_each_step_takes_a_like_one_in() -> None:
    shown = steps((leg(0) | leg(1), Each(Merge())), (leg(2), Merge()), (leg(3), Each(Merge())))
    assert merge_steps(shown, TABLE) == (Step(1, leg(0) | leg(1) | leg(2) | leg(3), Each(Merge())),)


def test_other_actions_and_labels_nothing_and_open_steps_stay_and_are_numbered_anew() -> None:
    shown = [
        *steps((leg(0), Merge()), (leg(1), Merge()), (leg(2), Replace("box"))),
        Step(4, leg(3), Replace("box"), "panel"),
        Step(5, set(), Delete()),
        Step(6, None, Delete()),
        Step(7, {"knob"}, Delete()),
    ]
    assert [(step.rule, step.select) for step in merge_steps(shown, TABLE)] == [
        (1, leg(0) | leg(1)),
        (2, leg(2)),
        (3, leg(3)),
        (4, frozenset()),
        (5, None),
        (6, frozenset({"knob"})),
    ]


def test_steps_on_made_hulls_stay_apart() -> None:
    shown = steps((leg(0), Merge()), ({"leg0_low~1"}, Delete()), ({"knob"}, Delete()))
    assert merge_steps(shown, to_canonical_frame(TABLE, None)[0]) == tuple(shown)


def test_no_steps_stay_no_steps() -> None:
    assert merge_steps([], TABLE) == ()
