"""Lessons with the orientation withheld: which tasks need one, what is shown, and what is counted."""

from benchmark.signoff.orientation import needs_orientation, teach_three_ways


def test_a_task_needs_its_orientation_where_its_reference_selects_something_else_without() -> None:
    assert needs_orientation("chair-medium", calibration=True)
    assert not needs_orientation("chair-easy", calibration=True)


def test_a_lesson_without_orientation_is_made_right_by_what_is_suggested() -> None:
    row = teach_three_ways("chair-medium", 0, 1, calibration=True)
    withheld, upright = row["withheld"], row["upright"]
    assert row["needs"] and row["given"]["right"]
    assert (withheld["plain_right"], withheld["right"], withheld["frame"]) == (False, True, True)
    assert withheld["suggested"].startswith("orient +Z: ")
    assert upright["suggested"] is None and upright["right"]
