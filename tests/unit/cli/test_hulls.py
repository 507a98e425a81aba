"""Hulls as people type them: ranges of numbers and of names."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.cli.hulls import find_hulls
from meshforge.common import UsageError

NAMES = [*(f"geom#{place}" for place in range(20, 30)), "top", "odd#1-2"]


@given(st.integers(0, 11), st.integers(0, 11))
def test_a_range_is_all_numbers_from_the_first_to_the_last(one: int, other: int) -> None:
    first, last = sorted((one, other))
    assert find_hulls(f"#{first}-{last}", NAMES, "HULLS") == set(NAMES[first : last + 1])
    assert find_hulls(f"#{first}-#{last}, top", NAMES, "HULLS") == {*NAMES[first : last + 1], "top"}


def test_a_range_of_names_is_those_hulls() -> None:
    assert find_hulls("geom#22-26", NAMES, "HULLS") == {f"geom#{place}" for place in range(22, 27)}


def test_a_name_that_looks_like_a_range_is_that_hull() -> None:
    assert find_hulls("odd#1-2", NAMES, "HULLS") == {"odd#1-2"}


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("#0-99999999999", "no hull has the number #99999999999"),
        ("#5-3", "#5-3 ends before it begins"),
        ("geom#22-40", "no hull is named 'geom#40'"),
    ],
)
def test_a_range_that_leads_beyond_the_hulls_is_refused(text: str, problem: str) -> None:
    with pytest.raises(UsageError, match=problem):
        find_hulls(text, NAMES, "HULLS")


BODIES = ("leg_left/foot", "leg_left/geom1", "leg_right/foot", "top/leg_plate")


@pytest.mark.parametrize(
    ("pattern", "found"),
    [
        ("leg_left/*", {"leg_left/foot", "leg_left/geom1"}),
        ("leg_*", {"leg_left/foot", "leg_left/geom1", "leg_right/foot"}),
        ("*/leg_*", {"top/leg_plate"}),
        ("*/foot", {"leg_left/foot", "leg_right/foot"}),
        ("*", set(BODIES)),
    ],
)
def test_a_pattern_is_compared_with_the_whole_name_and_a_star_takes_slashes(pattern: str, found: set[str]) -> None:
    assert find_hulls(pattern, BODIES, "HULLS") == found


@pytest.mark.parametrize(
    ("text", "remedy"),
    [
        ("leg_left", "That is a body. For all of its hulls, write: 'leg_left/*'"),
        ("foot", "A name begins with that of its body. Write it so: '*/foot'"),
        ("geom?", "A name begins with that of its body. Write it so: '*/geom?'"),
    ],
)
def test_a_body_or_a_name_without_its_body_is_refused_with_the_pattern_that_is_meant(text: str, remedy: str) -> None:
    with pytest.raises(UsageError) as refused:
        find_hulls(text, BODIES, "HULLS")
    assert refused.value.remedy == remedy
    assert find_hulls(remedy.split("'")[1], BODIES, "HULLS")
