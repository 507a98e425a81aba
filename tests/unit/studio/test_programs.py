"""Programs as the page gets them."""

from pathlib import Path

import pytest

from meshforge.project import Project
from meshforge.studio.queries import programs
from meshforge.studio.wire.program import ProgramView
from tests.studio_project import demo_project


@pytest.fixture
def learned(tmp_path: Path) -> Project:
    project = demo_project(tmp_path)
    assert programs.read_program_view(project) == ProgramView()
    project.synthesize()
    return project


def test_a_learned_program_is_told_rule_by_rule_and_one_that_a_person_changed_is_theirs(learned: Project) -> None:
    view = programs.read_program_view(learned)
    assert view.text == learned.layout.program.read_text()
    assert [rule.rule for rule in view.rules] == [1, 2, 3, 4, 5]
    assert (view.rules[0].text, view.rules[0].sentence) == ("Is(misc) => Delete", "The misc hulls are deleted.")
    assert view.orient_sentence.startswith("For reasoning, turn every asset so that +Z points from the leg hulls")
    assert (view.by_hand, view.outdated, view.error) == (False, False, None)
    learned.layout.program.write_text(view.text.replace("Delete", "Merge"))
    changed = programs.read_program_view(learned)
    assert changed.by_hand and changed.version != view.version
    learned.layout.program.write_text("Is(leg) => Delte\n")
    broken = programs.read_program_view(learned)
    assert (broken.text, broken.rules) == ("Is(leg) => Delte\n", ())
    assert broken.error and "unknown action `Delte`" in broken.error


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
