"""Laws of the language's text: parsing and printing are inverse, and comments survive."""

import math
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.language import (
    Action,
    Comments,
    Each,
    Extractor,
    HeaderComments,
    Is,
    Orient,
    Program,
    Replace,
    Rule,
    Scale,
    Shrink,
    parse_extractor,
    show,
)
from tests.examples import examples
from tests.program_parts import parse_action, parse_orient
from tests.strategies import VOCABULARY, actions, extractors, orients, programs, rules

LABELS = st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=6) | st.sampled_from(
    ("Union", "Delete", "labels", "as", "box", "keep", "all", 'a"b', "a#b", "é", "x\ny")
)
COMMENT = st.text(st.characters(exclude_categories=["Cs", "Cc", "Zl", "Zp", "Zs"]), max_size=8)
LINES = st.lists(st.none() | COMMENT, max_size=4).map(tuple)
COMMENTS = st.builds(Comments, LINES, st.none() | COMMENT)


@pytest.mark.slow
@given(programs())
@examples(150)
def test_parsing_a_printed_program_gives_the_program(program: Program) -> None:
    assert Program.parse(str(program)) == program


@given(extractors(), actions(), orients())
@examples(100)
def test_parsing_a_printed_part_gives_the_part(extractor: Extractor, action: Action, orient: Orient) -> None:
    assert parse_extractor(show(extractor)) == extractor
    assert parse_action(show(action)) == action
    assert parse_orient(show(orient)) == orient


@given(st.lists(LABELS, min_size=1, max_size=3, unique=True).map(tuple))
@examples(100)
def test_any_text_can_be_a_label(labels: tuple[str, ...]) -> None:
    program = Program(labels, rules=(Rule(Is(labels[0]), Scale("X", 2.0), label=labels[-1]),))
    assert Program.parse(str(program)) == program


@given(st.floats(min_value=0, exclude_min=True, allow_infinity=False))
@examples(200)
def test_a_number_is_printed_shortest_and_read_back_exactly(factor: float) -> None:
    action = Scale("all", factor)
    assert parse_action(show(action)) == action
    assert math.isclose(float(show(action).split()[-1].rstrip(")")), factor, rel_tol=0)


@given(
    st.lists(rules(), max_size=3),
    st.lists(COMMENTS, min_size=3, max_size=3),
    st.builds(HeaderComments, COMMENTS, COMMENTS, COMMENTS, COMMENTS, LINES),
)
@examples(150)
def test_formatting_twice_is_formatting_once_and_loses_no_comment(
    given_rules: list[Rule], beside: list[Comments], headers: HeaderComments
) -> None:
    commented = [Rule(r.extractor, r.action, r.label, c) for r, c in zip(given_rules, beside, strict=False)]
    text = str(Program(VOCABULARY, None, tuple(commented), 0.01, None, headers))
    again = str(Program.parse(text))
    assert str(Program.parse(again)) == again
    used = [headers.labels, headers.contact, *(r.comments for r in commented)]
    kept = [line for c in used for line in (*c.above, c.beside) if line] + [line for line in headers.end if line]
    assert [line.partition("#")[2] for line in again.split("\n") if "#" in line and line.partition("#")[2]] == kept


_SIZES = st.floats(1e-6, 1e6) | st.sampled_from((0.05, 0.002))
_AXES = st.none() | st.sampled_from("XYZ")
_WITH_OPTIONS = st.one_of(
    st.builds(Replace, st.sampled_from(("cylinder", "capsule")), axis=_AXES, radius=st.none() | _SIZES),
    st.builds(
        Replace, st.sampled_from(("cylinder", "capsule")), st.sampled_from(("native", "inscribed", "volume")), _AXES
    ),
    st.builds(Replace, st.just("box"), st.sampled_from((None, "tight", "inscribed", "volume"))),
    st.builds(Replace, st.just("sphere"), st.sampled_from((None, "native", "inscribed", "volume", "longest"))),
    st.builds(Replace, st.just("sphere"), radius=_SIZES),
    st.builds(Shrink, _SIZES),
)


@given(_WITH_OPTIONS, st.booleans(), st.randoms())
@examples(100)
def test_options_are_read_back_in_any_order(action: Action, each: bool, order: random.Random) -> None:
    whole = Each(action) if each else action
    assert parse_action(str(whole)) == whole
    first, *options = str(action).removesuffix(")").split("(")[1].split(", ")
    order.shuffle(options)
    assert parse_action(f"{type(action).__name__}({', '.join([first, *options])})") == action
