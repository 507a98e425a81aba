"""The language reference: its programs parse and are canonical, its tables tell what the classes tell."""

import re
from pathlib import Path

import pytest

from meshforge.language import ACTIONS, OPERATORS, Program, parse_extractor

REFERENCE = (Path(__file__).parents[3] / "docs" / "language.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", REFERENCE, re.DOTALL | re.MULTILINE)


@pytest.mark.parametrize("text", blocks("mf"))
def test_every_program_of_the_reference_is_in_canonical_form(text: str) -> None:
    formatted = str(Program.parse(text))
    if "labels " not in text:  # formatting declares what an example leaves out
        formatted = re.sub(r"\Alabels .*\n\n?", "", formatted)
    assert formatted == text


@pytest.mark.parametrize("text", blocks("python"))
def test_every_python_example_of_the_reference_runs(text: str) -> None:
    exec(text, {})


def test_every_operator_is_told_of_with_an_example_that_parses() -> None:
    rows = re.findall(r"^\| `(\w+)[^|]*\|[^|]*\| `(.*)` \|$", REFERENCE, re.MULTILINE)
    assert tuple(name for name, _ in rows) == OPERATORS
    for name, example in rows:
        assert type(parse_extractor(example)).__name__ == name


def test_every_action_is_told_of_in_the_words_of_its_class() -> None:
    rows = re.findall(r"^\| `([^`]*)` \| ([^|]*) \|$", REFERENCE.replace("\\|", "¦"), re.MULTILINE)
    told = [(usage.replace("¦", "|"), summary) for usage, summary in rows]
    assert told == [(kind.usage(), kind.summary()) for kind in ACTIONS.values()]


def test_the_error_of_the_reference_is_the_golden_one() -> None:
    golden = Path(__file__).parents[2] / "golden" / "unknown_label.err"
    assert blocks("text")[0] == golden.read_text(encoding="utf-8").replace("unknown_label.mf", "tables.mf")
