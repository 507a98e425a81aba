"""Learning with a person who answers."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from PIL import Image

from meshforge.cli import mesh_pictures
from meshforge.cli.synthesize_dialog import Conversation
from meshforge.cli.synthesize_session import LearningSession
from meshforge.project import Project
from meshforge.synthesis import Ambiguous, Found, LearningOutcome, NeedsRepair, NoProgram, Options
from tests.unit.project.shelves import PLAIN, SHELVED, ambiguous, mislabelled

HIGHEST = "labels board, leg, knob\n\nGeo(Is(board), +Z) => Delete\n"


@pytest.fixture(autouse=True)
def _small(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(mesh_pictures, "PICTURE_SIZE", (240, 160))
    monkeypatch.chdir(tmp_path)


def talk(project: Project, *lines: str) -> tuple[LearningOutcome, str, list[str]]:
    """The outcome when a person types these lines and then has enough, all that was to be read, and the pictures."""
    seen, pictures = list[str](), list[str]()
    typed: Iterator[str] = iter(lines)

    def ask(prompt: str) -> str:
        for path in sorted(project.layout.questions.glob("*.png")):
            with Image.open(path) as picture:
                assert picture.size == (240, 160)
            pictures.append(path.stem)
        line = next(typed, None)
        seen.append(prompt + (line or ""))
        if line is None:
            raise EOFError
        return line

    outcome = Conversation(LearningSession(project, Options()), ask, seen.append).run()
    assert not project.layout.questions.exists()
    assert next(typed, None) is None
    return outcome, "\n".join(seen), pictures


def test_a_choice_between_pictures_settles_the_rule(tmp_path: Path) -> None:
    project = ambiguous(tmp_path)
    outcome, seen, pictures = talk(project, "two", "2")
    assert isinstance(outcome, Found) and outcome.settled
    assert str(project.program()) == HIGHEST
    assert pictures == [f"rule-1-rack2-choice-{k}" for k in (1, 2, 3)] * 2  # asked twice
    assert (
        seen
        == """\
labels board, leg, knob

Is(board) => Delete

Rule 1 can be read in more than one way.
  now: Is(board) => Delete
       The board hulls are deleted.
What should rule 1 take on rack2.obj?
  1  2 hulls: top, shelf
     racks/.meshforge/questions/rule-1-rack2-choice-1.png
  2  1 hull: top
     racks/.meshforge/questions/rule-1-rack2-choice-2.png
  3  1 hull: shelf
     racks/.meshforge/questions/rule-1-rack2-choice-3.png
1, 2, 3, n for neither, s to stop asking: two
Type one of: 1, 2, 3, n, s.
1, 2, 3, n for neither, s to stop asking: 2

Rule 1 is now: Geo(Is(board), +Z) => Delete
  The board hulls that reach farthest along +Z are deleted.
"""
    )


def test_neither_leads_to_the_labels(tmp_path: Path) -> None:
    project = ambiguous(tmp_path)
    outcome, seen, _ = talk(project, "n", "shelf=lek", "shelf", "shelf=leg", "1")
    assert isinstance(outcome, Found)
    assert project.mesh(SHELVED).hull_of("shelf").label == "leg"
    assert tuple(project.feedback().said) == ("1:rack3.obj",)
    assert (
        """
Then a label may be wrong. The choices differ on:
  shelf  board
  top  board
HULL=LABEL to correct one (more with commas), Enter to leave them: shelf=lek
there is no label 'lek'; did you mean 'leg'?
HULL=LABEL to correct one (more with commas), Enter to leave them: shelf
'shelf' is not of the form HULL=LABEL
"""
        in seen
    )


def test_neither_without_a_wrong_label_goes_on_to_another_asset(tmp_path: Path) -> None:
    project = ambiguous(tmp_path)
    outcome, _, _ = talk(project, "n", "", "s")
    assert isinstance(outcome, Ambiguous)
    assert outcome.question.asset != SHELVED
    assert tuple(project.feedback().said) == ("1:rack2.obj",)


@pytest.mark.parametrize("lines", [("s",), ()])
def test_stopping_leaves_the_program_and_the_question(tmp_path: Path, lines: tuple[str, ...]) -> None:
    project = ambiguous(tmp_path)
    outcome, _, _ = talk(project, *lines)
    assert isinstance(outcome, Ambiguous) and project.program() == outcome.program
    assert not project.feedback().said


def test_having_enough_amid_the_labels_keeps_what_was_said(tmp_path: Path) -> None:
    project = ambiguous(tmp_path)
    _, seen, _ = talk(project, "n")
    assert seen.endswith("\nstopped; what you said so far is kept")
    assert tuple(project.feedback().said) == ("1:rack2.obj",)


@pytest.mark.slow
def test_an_answer_that_leaves_no_program_can_be_taken_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    project = ambiguous(tmp_path)
    learn, failed = LearningSession.learn, Project.open(project.folder).synthesize

    def without_program(self: LearningSession) -> LearningOutcome:
        """As if no rule agreed with the answer."""
        if not project.feedback().said:
            return learn(self)
        found = failed()
        assert found.program
        nearest = _missing(project)
        return NoProgram(rules=(), readings=(), tried=(), seconds={}, nearest=nearest.nearest, why="none fits")

    monkeypatch.setattr(LearningSession, "learn", without_program)
    outcome, seen, _ = talk(project, "1", "y", "1", "n")
    assert isinstance(outcome, NoProgram)
    assert seen.count("With your answer about rack2.obj there is no program: none fits") == 2
    assert tuple(project.feedback().said) == ("1:rack2.obj",)


def _missing(project: Project) -> NoProgram:
    from meshforge.synthesis import Answer

    impossible = [Answer(1, SHELVED, ["left"]), Answer(1, "rack3.obj", ["right", "knob"])]
    outcome = project.synthesize(accept=False, answers=impossible)
    assert isinstance(outcome, NoProgram)
    return outcome


def test_a_confirmed_repair_is_made_and_learned_from(tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    outcome, seen, pictures = talk(project, "y")
    assert isinstance(outcome, Found)
    assert project.mesh(PLAIN).hull_of("knob").source == "repair"
    assert pictures == ["label-rack0"]
    lines = seen.splitlines()
    assert lines[:2] == ["A label may be wrong.", "  knob of rack0.obj: leg -> knob"]
    assert lines[2].startswith("  why: ")
    assert lines[3:] == [
        "  how sure: 99 %",
        "  picture: racks/.meshforge/questions/label-rack0.png",
        "Repair it? y, n, s to stop asking: y",
        "repaired: knob of rack0.obj: leg -> knob",
    ]


def test_a_refused_repair_is_not_asked_about_again(tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    outcome, seen, _ = talk(project, "n")
    assert not isinstance(outcome, NeedsRepair)
    assert seen.count("Repair it?") == 1
    assert project.mesh(PLAIN).hull_of("knob").label == "leg"


def test_a_repair_can_be_left_open(tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    assert isinstance(talk(project, "s")[0], NeedsRepair)
    assert not project.feedback().said
