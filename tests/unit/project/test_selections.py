"""What a person did on a hull survives that hull's split, and comes back when the split is undone."""

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from meshforge import batch
from meshforge.common import ProjectError
from meshforge.formats import read
from meshforge.language import Merge
from meshforge.project import Project, demonstrations
from meshforge.project.prepare import exchange_preparation
from meshforge.store import ConflictError, History
from meshforge.studio.edits.base import make_edit, steps_version
from meshforge.studio.edits.program import SetSteps, StepEdit
from meshforge.studio.wire.program import ActionCall
from meshforge.symbolic import Label
from meshforge.synthesis import Answer, LabelFix
from tests.unit.batch.families import tree
from tests.unit.deaths import deaths, needs_fork
from tests.unit.project.tables import FIRST, LEGS, SECOND, THIRD, applied

KEPT = ("labels/", "demonstrations/", "corrections/", "events.jsonl", "prepared/")
PARTS = {"crumb#0", "crumb#1"}
PLANE = ((5.05, 5.05, 5.05), (0, 0, 1))


def kept(project: Project) -> dict[str, bytes]:
    files = tree(project.folder).items()
    return {name: data for name, data in files if name.startswith(KEPT) and not name.endswith(".tmp")}


def said(folder: Path) -> Project:
    """A project where a person said all there is to say about hulls of its first asset."""
    project = applied(folder)
    project.correct(FIRST, ["left_low~1"], Merge())
    project.add_answer(Answer(1, FIRST, ["crumb"], [["crumb", "top"]]))
    demonstrations.reject(project, LabelFix(FIRST, "crumb", "misc", "leg"))
    project.confirm(LabelFix(FIRST, "crumb", project.mesh(FIRST).hull_of("crumb").label, "top"))
    return project


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return said(tmp_path)


def test_selections_of_a_split_hull_name_its_parts_and_come_back_bit_for_bit(project: Project) -> None:
    before = kept(project)
    project.cut(FIRST, "crumb", *PLANE)
    assert project.steps(FIRST)[0].select == frozenset(PARTS)
    assert project.steps(FIRST)[1].select == frozenset(LEGS)
    flag = "crumb, which is demonstrated for rule 1, was split into crumb#0, crumb#1: look whether all parts are meant"
    assert flag in project.status(workers=0).assets[0].flags
    project.unprepare(FIRST)
    assert kept(project) == before


def test_a_split_is_an_edit_that_the_studio_undoes_and_does_again(project: Project) -> None:
    before = kept(project)
    project.cut(FIRST, "crumb", *PLANE)
    after, history = kept(project), History.open(project.folder)
    assert history.state.undo == f"{FIRST}: crumb cut into 2 hulls"
    history.undo()
    assert kept(project) == before
    history.redo()
    assert kept(project) == after
    project.unprepare(FIRST)
    assert (kept(project), History.open(project.folder).state.undoable) == (before, 2)


def test_an_undo_names_what_was_changed_since_and_by_what_and_writes_nothing(project: Project) -> None:
    project.cut(FIRST, "crumb", *PLANE)
    demonstrations.correct_selection(project, FIRST, 1, ["crumb#0", "crumb#1", "top"])
    assert not any("demonstrated" in flag for flag in project.status(workers=0).assets[0].flags)
    before = kept(project)
    with pytest.raises(ConflictError) as caught:
        project.unprepare(FIRST)
    assert f"demonstrations/{FIRST}.json was changed since, by something else" in caught.value.problem
    assert caught.value.remedy and caught.value.remedy.endswith(f" {FIRST} --remove")
    assert kept(project) == before
    done = project.unprepare(FIRST, everything=True)
    assert done.undone == ("crumb cut into 2 hulls",)
    assert f"demonstrations/{FIRST}.json was changed since, by something else, and stays as it is" in done.notes
    assert any("which it has no more: demonstrate it anew" in note for note in done.notes)
    assert not project.preparation(FIRST).steps


def test_an_undo_names_the_edit_that_changed_something_since(project: Project) -> None:
    project.cut(FIRST, "crumb", *PLANE)
    steps = [StepEdit(select=("top",), action=ActionCall(name="Delete"))]
    version = steps_version(project, FIRST)
    make_edit(History(project.folder), project, SetSteps(asset=FIRST, version=version, steps=tuple(steps)))
    with pytest.raises(ConflictError, match=f"was changed since, by “.*{FIRST}.*”"):
        project.unprepare(FIRST)


def test_what_people_said_of_other_assets_since_stays_when_a_split_is_undone(project: Project) -> None:
    before = kept(project)["events.jsonl"]
    project.cut(FIRST, "crumb", *PLANE)
    project.add_answer(Answer(1, SECOND, ["top"]))
    project.unprepare(FIRST)
    assert kept(project)["events.jsonl"].startswith(before)
    assert set(project.feedback().answers) == {f"1:{FIRST}", f"1:{SECOND}"}


def test_an_answer_about_a_hull_that_was_split_since_fits_no_more_and_is_named(project: Project) -> None:
    answer = Answer(1, THIRD, ["top"])
    project.add_answer(answer)
    project.cut(THIRD, "top", (0.5, 0.5, 1), (1, 0, 0))
    assert answer in project.synthesize().stale
    project.unprepare(THIRD)
    assert answer not in project.synthesize().stale


def test_a_split_is_undone_and_done_again_in_a_project_whose_history_is_gone(project: Project) -> None:
    project.cut(FIRST, "crumb", *PLANE)
    shutil.rmtree(project.layout.history)
    done = project.unprepare(FIRST)
    assert done.undone == ("crumb cut into 2 hulls",)
    assert any("crumb#0, crumb#1, which it has no more: demonstrate it anew" in note for note in done.notes)
    assert "crumb" in project.mesh(FIRST).index


def test_parts_get_the_labels_of_what_split_their_hull_and_a_persons_comes_back(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.set_labels(FIRST, {"top": "top"})
    before = kept(project)
    known = {"top#0": Label("leg", 0.9, "propagated"), "top#1": Label("top", 0.8, "propagated")}
    after = batch.cut_hull(read(project.path(FIRST)), batch.Preparation(), "top", (1, 0, 0), (1, 0, 0))
    exchange_preparation(project, FIRST, after, None, known)
    labels = project.mesh(FIRST).labels
    assert labels["top#0"] == Label("leg", 0.9, "propagated")
    assert labels["top#1"] == Label("top", 1.0, "user")
    project.unprepare(FIRST)
    assert kept(project) == before
    exchange_preparation(project, FIRST, after, None, known)
    project.set_labels(FIRST, {"top#0": "misc", "top#1": "misc"})
    notes = project.unprepare(FIRST).notes
    assert project.mesh(FIRST).hull_of("top").label == "misc"
    assert "top gets its label from its parts, which were labelled since it was split" in notes


def include_again(project: Project, copy: Path) -> None:
    shutil.rmtree(project.folder)
    shutil.copytree(copy, project.folder)


def said_and_labelled(folder: Path) -> Project:
    """The same, with a label of a person on what is split, so that labels change as well."""
    project = said(folder)
    project.set_labels(FIRST, {"crumb": "top"})
    return project


@pytest.mark.slow
@needs_fork
@pytest.mark.parametrize("everything", [False, True])
def test_a_killed_undo_is_finished_by_the_next_bit_for_bit(tmp_path: Path, everything: bool) -> None:
    project = said_and_labelled(tmp_path)
    before = kept(project)
    project.cut(FIRST, "crumb", *PLANE)
    middle = kept(project)
    project.cut(FIRST, "crumb#0", project.mesh(FIRST).hull_of("crumb#0").aabb.center.tolist(), (1, 0, 0))
    shutil.copytree(project.folder, tmp_path / "late")
    for _ in deaths(lambda: project.unprepare(FIRST, everything=everything), removals=True, costly=True):
        cut_short = bool(History(project.folder).interrupted)
        assert any("cut short" in flag for flag in project.status(workers=0).assets[0].flags) == cut_short
        if cut_short or FIRST in project.layout.preparation.ids:
            assert project.unprepare(FIRST, everything=everything).undone
        assert kept(project) == (before if everything else middle)
        include_again(project, tmp_path / "late")


@pytest.mark.slow
@needs_fork
def test_after_a_killed_split_or_undo_a_split_and_its_undo_leave_nothing(tmp_path: Path) -> None:
    project = said_and_labelled(tmp_path)
    before = kept(project)
    shutil.copytree(project.folder, tmp_path / "before")
    project.cut(FIRST, "crumb", *PLANE)
    after = kept(project)
    shutil.copytree(project.folder, tmp_path / "after")
    work: dict[str, Callable[[], object]] = {
        "before": lambda: project.cut(FIRST, "crumb", *PLANE),
        "after": lambda: project.unprepare(FIRST),
    }
    for start, change in work.items():
        include_again(project, tmp_path / start)
        for _ in deaths(change, removals=True, costly=True):
            if project.preparation(FIRST).steps:
                project.unprepare(FIRST)
                assert kept(project) == before
            else:
                project.cut(FIRST, "crumb", *PLANE)
                assert kept(project) == after
                project.unprepare(FIRST)
                assert kept(project) == before
            include_again(project, tmp_path / start)


@pytest.mark.slow
@needs_fork
def test_a_killed_undo_does_not_overwrite_labels_that_a_person_changed_since(tmp_path: Path) -> None:
    project = said_and_labelled(tmp_path)
    project.cut(FIRST, "crumb", *PLANE)
    project.set_labels(FIRST, {"crumb#0": "misc", "crumb#1": "misc"})
    shutil.copytree(project.folder, tmp_path / "after")
    for _ in deaths(lambda: project.unprepare(FIRST), removals=True, costly=True):
        if FIRST in project.layout.preparation.ids:
            project.unprepare(FIRST)
        assert project.mesh(FIRST).hull_of("crumb").label == "misc"
        include_again(project, tmp_path / "after")
    assert project.mesh(FIRST).hull_of("crumb").label == "misc"


BROKEN = {"no json": b"{", "no text": b"\xff", "a list": b"[]", "no fields": b'{"answers": [{}], "steps": [{}]}'}


@pytest.mark.parametrize("content", BROKEN)
@pytest.mark.parametrize("kind", ["answers", "demonstration", "manual_edits"])
def test_a_broken_file_is_named_and_nothing_is_written(project: Project, kind: str, content: str) -> None:
    layout = project.layout
    path = layout.events if kind == "answers" else getattr(layout, kind)(FIRST)
    good = path.read_bytes()
    path.write_bytes(BROKEN[content])
    before = kept(project)
    with pytest.raises(ProjectError, match=path.name) as caught:
        project.cut(FIRST, "crumb", *PLANE)
    assert caught.value.where == str(path)
    assert caught.value.remedy and caught.value.remedy.startswith("Correct ")
    assert "by hand, or remove it" in caught.value.remedy
    assert kept(project) == before
    path.write_bytes(good)
    project.cut(FIRST, "crumb", *PLANE)
    path.write_bytes(BROKEN[content])
    before = kept(project)
    for everything in (False, True):
        with pytest.raises(ProjectError, match=path.name):
            project.unprepare(FIRST, everything=everything)
    assert kept(project) == before
    assert messages_of_status(project).count(caught.value.message) == 1


def messages_of_status(project: Project) -> list[str]:
    """What a status says of files of the first asset; what it raises where it can say nothing else."""
    try:
        return list(project.status(workers=0).assets[0].flags)
    except ProjectError as error:
        return [error.message]


def test_files_with_other_line_ends_come_back_bit_for_bit(project: Project) -> None:
    for path in (project.layout.events, project.layout.demonstration(FIRST)):
        path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes().replace(b"\n", b"\r\n"))
    before = kept(project)
    project.cut(FIRST, "crumb", *PLANE)
    assert project.steps(FIRST)[0].select == frozenset(PARTS)
    project.unprepare(FIRST)
    assert kept(project) == before


def test_selections_and_labels_come_back_where_the_asset_cannot_be_read(tmp_path: Path) -> None:
    project = said_and_labelled(tmp_path)
    before = kept(project)
    project.cut(FIRST, "crumb", *PLANE)
    project.path(FIRST).write_bytes(b"f 1 2 3")
    assert not project.unprepare(FIRST, everything=True).notes
    assert kept(project) == before
