"""Programs as the page gets them."""

from __future__ import annotations

from pathlib import Path

import pytest

from meshforge.project import Project
from meshforge.studio.queries import programs
from tests.studio_project import demo_project


def learned(folder: Path) -> Project:
    project = demo_project(folder)
    project.synthesize()
    return project


def test_a_project_without_a_program_has_an_empty_view(tmp_path: Path) -> None:
    view = programs.read_program_view(demo_project(tmp_path))
    assert (view.text, view.version, view.rules, view.by_hand, view.error) == ("", "", (), False, None)


def test_a_learned_program_is_told_rule_by_rule(tmp_path: Path) -> None:
    project = learned(tmp_path)
    view = programs.read_program_view(project)
    assert view.text == project.layout.program.read_text()
    assert [rule.rule for rule in view.rules] == [1, 2, 3, 4, 5]
    assert (view.rules[0].text, view.rules[0].sentence) == ("Is(misc) => Delete", "The misc hulls are deleted.")
    assert view.orient_sentence.startswith("For reasoning, turn every asset so that +Z points from the leg hulls")
    assert (view.by_hand, view.outdated, view.error) == (False, False, None)


def test_a_program_that_a_person_changed_is_theirs(tmp_path: Path) -> None:
    project = learned(tmp_path)
    before = programs.read_program_view(project)
    project.layout.program.write_text(before.text.replace("Delete", "Merge"))
    after = programs.read_program_view(project)
    assert after.by_hand
    assert after.version != before.version


def test_a_program_that_does_not_parse_keeps_its_text_and_says_why(tmp_path: Path) -> None:
    project = learned(tmp_path)
    project.layout.program.write_text("Is(leg) => Delte\n")
    view = programs.read_program_view(project)
    assert view.text == "Is(leg) => Delte\n"
    assert view.error
    assert "unknown action `Delte`" in view.error
    assert view.rules == ()


def test_a_right_text_is_told_in_words() -> None:
    found = programs.check_text("orient +Z: Is(leg) -> Is(panel)\nIs(leg) => Each(Merge)  # as one\n")
    assert found.mark is None
    assert [(rule.text, rule.sentence) for rule in found.rules] == [
        ("Is(leg) => Each(Merge)", "Each connected group of leg hulls is merged into one convex hull.")
    ]
    assert found.orient_sentence


@pytest.mark.parametrize(
    ("text", "line", "column", "message"),
    [
        ("Is(leg) => Merge\nIs(leg) => Delte\n", 2, 12, "unknown action `Delte`. Did you mean Delete?"),
        ("labels leg\n\n  Is(lge) => Delete", 3, 6, "unknown label 'lge'"),
        ("Is(leg => Delete", 1, 8, "expected `)`"),
        ("Is(leg) =>", 1, 11, "expected an action"),
    ],
)
def test_what_is_wrong_is_marked_where_it_stands(text: str, line: int, column: int, message: str) -> None:
    mark = programs.check_text(text).mark
    assert mark
    assert (mark.line, mark.column) == (line, column)
    assert message in mark.message
    assert "\n" not in mark.message
