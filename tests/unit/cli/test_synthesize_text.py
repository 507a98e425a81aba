"""What learning results in as text: the assets to look at are one list."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from meshforge.cli.synthesize import LearningContext, format_remarks
from meshforge.language import All, Is, Program
from meshforge.synthesis import Ambiguous, CandidateProgram, Found, Hint, OpenRule

ABOUT = LearningContext(Path("p"), assets=9, in_use=9, readable=9)
READINGS = (
    CandidateProgram("a", 1, Is("leg"), 0.9),
    CandidateProgram("b", 1, All(), 0.1, ("a.obj", "b.obj", "c.obj")),
    CandidateProgram("c", 2, All(), 0.1, ("b.obj",)),
    CandidateProgram("d", 2, All(), 1e-9, ("z.obj",)),
)
HINT = Hint("c.obj", "it has 2 hulls unlike any that was demonstrated")


FOUND = Found(
    rules=(),
    candidates=READINGS,
    tried=(),
    seconds={},
    program=Program(),
    unambiguous=False,
    hint=HINT,
    sample=("b.obj", "d.obj", "e.obj"),
    overruled=("f.obj", "a.obj"),
)


def test_assets_to_look_at_are_one_list_in_which_each_stands_once_with_all_reasons() -> None:
    assert (
        format_remarks(FOUND, ABOUT)
        == """learned in 0.00 s, kept as p/program.mf
Look first at:
  f.obj: its result was accepted, which no program keeps that does what is demonstrated
  a.obj: its result was accepted, which no program keeps that does what is demonstrated; rule 1 might mean something else
  b.obj: rules 1, 2 might mean something else
  c.obj: rule 1 might mean something else; demonstrate it to be more certain: it has 2 hulls unlike any that was demonstrated
  d.obj, e.obj: best to see whether the program is right
  meshforge demonstrate p c.obj 'HULLS => ACTION' ...
Next: meshforge apply p"""  # noqa: E501
    )


@pytest.mark.parametrize("overruled", [(), ("f.obj",)])
def test_where_all_readings_agree_only_accepted_results_that_are_not_kept_are_named(overruled: tuple[str, ...]) -> None:
    text = format_remarks(replace(FOUND, unambiguous=True, overruled=overruled), ABOUT)
    assert "all believable readings of the rules agree on your 9 assets" in text
    assert ("Look first at:\n  f.obj: its result was accepted" in text) == bool(overruled)
    assert "might mean" not in text and "demonstrate p" not in text and "d.obj" not in text


def test_where_a_question_is_open_the_asset_to_demonstrate_alone_is_named() -> None:
    open_rule = OpenRule(1, "b.obj", (frozenset({"x"}), frozenset()))
    asked = Ambiguous(
        rules=(), candidates=READINGS, tried=(), seconds={}, program=Program(), open_rule=open_rule, hint=HINT
    )
    assert format_remarks(asked, ABOUT).splitlines()[1:-1] == [
        "ambiguous: it is open what rule 1 does on b.obj",
        "Look first at:",
        "  c.obj: demonstrate it to be more certain: it has 2 hulls unlike any that was demonstrated",
        "  meshforge demonstrate p c.obj 'HULLS => ACTION' ...",
    ]
