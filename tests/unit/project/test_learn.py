"""A project learns from its demonstrations and from what a person said since. What a person says while a program is
learned is kept, read again, and can be taken back."""

import json
from pathlib import Path

import pytest

from meshforge.common import ProjectError
from meshforge.language import Delete, Merge
from meshforge.project import Project, demonstrations, learn, select_assets
from meshforge.symbolic import Label
from meshforge.synthesis import Answer, Found, LabelFix, NeedsRepair, NoProgram, OpenRule, Repair, Step
from tests.open_rules import choose
from tests.unit.project.shelves import OTHER, PLAIN, SHELVED, ambiguous, mislabelled

ALL = "labels board, leg, knob\n\nIs(board) => Delete\n"


def test_answers_about_what_is_gone_are_reported_not_refused(project: Project, tmp_path: Path) -> None:
    project.add_answer(Answer(1, "rack6.obj", ["top"]))
    project.add_answer(Answer(1, "rack5.obj", ["board"]))
    (tmp_path / "assets" / "rack6.obj").unlink()
    project = Project.open(project.folder)
    outcome = project.synthesize()
    assert outcome.program
    assert {answer.asset for answer in outcome.stale} == {"rack6.obj", "rack5.obj"}


def test_an_answer_is_not_taken_for_one_to_another_rule(project: Project) -> None:
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


def test_an_answer_that_fits_nothing_leaves_the_program_as_it_was(project: Project) -> None:
    project.synthesize()
    project.add_answer(Answer(1, SHELVED, ["left"]))
    project.add_answer(Answer(1, "rack3.obj", ["right", "knob"]))
    outcome = project.synthesize()
    assert isinstance(outcome, NoProgram)
    assert str(project.program()) == ALL


def test_a_family_reads_assets_once_and_labels_anew(project: Project) -> None:
    family = project.with_cache()
    before = dict(family.meshes_by_id())
    project.set_labels(SHELVED, {"shelf": None, "knob": "leg"})
    after = dict(family.meshes_by_id())
    assert [name for name in before if before[name] is not after[name]] == [SHELVED]
    assert after[SHELVED].labels == project.mesh(SHELVED).labels
    assert [a.shape for a in before[SHELVED].hulls] == [b.shape for b in after[SHELVED].hulls]


WRONG = LabelFix(PLAIN, "knob", "leg", "knob")
OPEN = OpenRule(1, SHELVED, (frozenset({"top", "shelf"}), frozenset({"top"})))
MACHINE = Label("leg", 0.75, "vlm")


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return ambiguous(tmp_path)


def knob(project: Project) -> Label | None:
    return project.mesh(PLAIN).hull_of("knob").annotation


def test_an_answer_is_kept_as_one_can_read_it(project: Project) -> None:
    assert project.add_answer(choose(OPEN, 1)) == "1:rack2.obj"
    assert project.layout.events.read_text() == (
        '{"event":"answer","rule":1,"asset":"rack2.obj","select":["top"],"action":"Delete"}\n'
    )
    assert [line.answer for line in project.feedback().answers.values()] == [Answer(1, SHELVED, ["top"])]


def test_of_very_many_assets_some_are_learned_from_and_all_of_which_something_was_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    project = ambiguous(tmp_path)
    assert select_assets(project) == project.assets()
    monkeypatch.setattr(learn, "MOST_ASSETS", 2)
    shown = set(project.demonstrations())
    project.add_answer(Answer(1, project.assets()[-1], ()))
    some = select_assets(project)
    assert shown | {project.assets()[-1], project.assets()[0]} <= set(some) < set(project.assets())
    assert list(some) == [asset for asset in project.assets() if asset in some]


def test_the_last_answer_to_a_question_counts_and_the_order_is_stable(project: Project) -> None:
    project.add_answer(Answer(1, "rack4.obj", ()))
    project.add_answer(choose(OPEN, 0))
    project.add_answer(choose(OPEN, None))
    said = [(line.asset, line.select) for line in project.feedback().answers.values()]
    assert said == [(SHELVED, None), ("rack4.obj", ())]


def test_fields_that_this_version_does_not_know_are_kept(project: Project) -> None:
    project.add_answer(choose(OPEN, 0))
    path = project.layout.events
    path.write_text(json.dumps(json.loads(path.read_text()) | {"when": "today"}) + "\n")
    project.add_answer(Answer(1, "rack4.obj", None))
    project.forget_answers()
    first, *others = map(json.loads, path.read_text().splitlines())
    assert first["when"] == "today"
    assert [one["event"] for one in others] == ["answer", "withdrawal", "withdrawal"]


def test_answers_that_cannot_be_are_refused(project: Project) -> None:
    with pytest.raises(ProjectError, match=r"no asset 'rack\.obj'"):
        project.add_answer(Answer(1, "rack.obj", None))
    with pytest.raises(ProjectError, match="no rule 2 to answer for: only rules 1 to 1 are demonstrated"):
        project.add_answer(Answer(2, SHELVED, None))
    assert not project.layout.events.exists()


def test_a_confirmed_repair_becomes_the_label_and_remembers_the_one_before(tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    assert project.confirm(WRONG) == "rack0.obj#knob=knob"
    assert knob(project) == Label("knob", 1.0, "repair")
    line = json.loads(project.layout.events.read_text())
    assert (line["from"], line["to"]) == ("leg", "knob")
    assert line["before"] == {"label": "leg", "source": "vlm", "confidence": 0.75}
    project.confirm(WRONG)
    assert project.take_back("rack0.obj#knob=knob") is None
    assert knob(project) == MACHINE
    assert not project.feedback().answers_and_fixes


def test_a_label_that_a_person_changed_after_the_repair_stays(tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    said = project.confirm(WRONG)
    project.set_labels(PLAIN, {"knob": "board"})
    note = project.take_back(said)
    assert note == "knob in rack0.obj is left labelled board, as it was changed after the repair"
    assert knob(project) == Label("board", 1.0, "user")


def test_a_repair_of_an_asset_that_is_gone_can_be_taken_back(tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    said = project.confirm(WRONG)
    (tmp_path / "assets" / PLAIN).unlink()
    project = Project.open(project.folder)
    assert "there is no asset" in (project.take_back(said) or "")
    assert not project.feedback().answers_and_fixes


def test_a_repair_that_no_longer_fits_is_refused(tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    with pytest.raises(ProjectError, match="no hull 'nob'; did you mean 'knob'"):
        project.confirm(LabelFix(PLAIN, "nob", "leg", "knob"))
    with pytest.raises(ProjectError, match="not in the vocabulary"):
        project.confirm(LabelFix(PLAIN, "knob", "leg", "handle"))
    project.set_labels(PLAIN, {"knob": "board"})
    with pytest.raises(ProjectError, match="knob is labelled board now, no longer leg"):
        project.confirm(WRONG)
    assert not project.feedback().answers_and_fixes


def test_an_unknown_id_names_the_nearest(project: Project) -> None:
    with pytest.raises(ProjectError, match="--list-answers"):
        project.take_back("1:rack2.obj")
    project.add_answer(choose(OPEN, 0))
    with pytest.raises(ProjectError, match=r"Did you mean '1:rack2\.obj'"):
        project.take_back("1:rack2.ob")


def test_everything_can_be_forgotten(tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    project.add_answer(choose(OPEN, 0))
    project.confirm(WRONG)
    demonstrations.reject(project, LabelFix(OTHER, "left", "leg", "knob"))
    assert project.forget_answers() == ()
    assert not project.feedback().answers_and_fixes and knob(project) == MACHINE
