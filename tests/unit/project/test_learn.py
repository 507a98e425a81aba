"""A project learns from its demonstrations and from what a person said since."""

from __future__ import annotations

from pathlib import Path

from meshforge.language import Delete, Merge
from meshforge.project import Project
from meshforge.symbolic import Label
from meshforge.synthesis import Answer, Found, NeedsRepair, NoProgram, Repair, Step
from tests.unit.project.shelves import OTHER, PLAIN, SHELVED, ambiguous, mislabelled

ALL = "labels board, leg, knob\n\nIs(board) => Delete\n"


def test_answers_about_what_is_gone_are_reported_not_refused(tmp_path: Path) -> None:
    project = ambiguous(tmp_path)
    project.add_answer(Answer(1, "rack6.obj", ["top"]))
    project.add_answer(Answer(1, "rack5.obj", ["board"]))
    (tmp_path / "assets" / "rack6.obj").unlink()
    project = Project.open(project.folder)
    outcome = project.synthesize()
    assert outcome.program
    assert {answer.asset for answer in outcome.stale} == {"rack6.obj", "rack5.obj"}


def test_an_answer_is_not_taken_for_one_to_another_rule(tmp_path: Path) -> None:
    project = ambiguous(tmp_path)
    answer = Answer(1, SHELVED, ["top"])
    project.add_answer(answer)
    for asset in (PLAIN, OTHER):
        project.demonstrate(asset, [Step(1, {"left", "right"}, Merge()), Step(2, {"top"}, Delete())])
    outcome = project.synthesize()
    assert outcome.program and outcome.stale == (answer,)


def test_a_confirmed_repair_is_kept_before_the_program_is(tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    asked: list[Repair] = []

    def yes(repair: Repair) -> bool:
        asked.append(repair)
        return True

    outcome = project.synthesize(confirm=yes)
    assert isinstance(outcome, Found) and len(asked) == 1
    assert project.mesh(PLAIN).hull_of("knob").annotation == Label("knob", 1.0, "repair")
    assert not project.status(workers=0).outdated
    again = project.synthesize(confirm=yes)
    assert again.program == outcome.program and len(asked) == 1


def test_a_refused_repair_is_not_proposed_again(tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    outcome = project.synthesize()
    assert isinstance(outcome, NeedsRepair)
    assert not isinstance(project.synthesize(confirm=lambda _: False), NeedsRepair)
    assert tuple(project.feedback().answers_and_fixes) == ("rack0.obj#knob=knob",)
    assert not isinstance(project.synthesize(), NeedsRepair)
    project.forget_answers()
    assert project.synthesize().repairs == outcome.repairs


def test_an_answer_that_fits_nothing_leaves_the_program_as_it_was(tmp_path: Path) -> None:
    project = ambiguous(tmp_path)
    project.synthesize()
    project.add_answer(Answer(1, SHELVED, ["left"]))
    project.add_answer(Answer(1, "rack3.obj", ["right", "knob"]))
    outcome = project.synthesize()
    assert isinstance(outcome, NoProgram)
    assert str(project.program()) == ALL


def test_a_family_reads_assets_once_and_labels_anew(tmp_path: Path) -> None:
    project = ambiguous(tmp_path)
    family = project.with_cache()
    before = dict(family.meshes_by_id())
    project.set_labels(SHELVED, {"shelf": None, "knob": "leg"})
    after = dict(family.meshes_by_id())
    assert [name for name in before if before[name] is not after[name]] == [SHELVED]
    assert after[SHELVED].labels == project.mesh(SHELVED).labels
    assert [a.shape for a in before[SHELVED].hulls] == [b.shape for b in after[SHELVED].hulls]
