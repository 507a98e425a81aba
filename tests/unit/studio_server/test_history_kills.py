"""A studio that is killed has made an edit whole, or it can be taken back whole."""

from __future__ import annotations

from pathlib import Path

import pytest

from meshforge.store import History
from meshforge.studio.edits.base import make_edit
from tests.unit.deaths import deaths, needs_fork
from tests.unit.studio_server.writing import Write, bare, data

BEFORE: dict[str, str | None] = {"a": "1", "b": "1"}
EDIT = Write(files={"a": "2", "b": None, "c/d": "2"})


@needs_fork
def test_a_killed_edit_can_be_undone_or_never_was(tmp_path: Path) -> None:
    project = bare(tmp_path)
    make_edit(History.open(project.folder), project, Write(files=BEFORE))
    before = data(project)
    for _ in deaths(lambda: make_edit(History.open(project.folder), project, EDIT)):
        left = data(project)
        history = History.open(project.folder)
        assert data(project) == left
        assert history.state.undoable == (1 if left == before else 2)
        if left != before:
            assert history.undo()
        assert data(project) == before
    assert data(project) == {"a": b"2", "c/d": b"2"}


@needs_fork
def test_a_killed_undo_is_brought_to_its_end(tmp_path: Path) -> None:
    project = bare(tmp_path)
    history = History.open(project.folder)
    make_edit(history, project, Write(files=BEFORE))
    before = data(project)
    make_edit(history, project, EDIT)
    after = data(project)
    for _ in deaths(lambda: History.open(project.folder).undo()):
        history = History.open(project.folder)
        assert data(project) == (before if history.state.redoable else after)
        while history.state.redoable:
            history.redo()
        assert data(project) == after
    assert data(project) == before


@pytest.mark.slow
@needs_fork
def test_a_killed_change_of_known_contents_is_taken_back_whole_but_for_what_others_wrote_since(tmp_path: Path) -> None:
    project = bare(tmp_path)
    make_edit(History.open(project.folder), project, Write(files=BEFORE))
    before, folder = data(project), project.folder / "data"
    writes = [(folder / "a", b"between"), (folder / "b", None), (folder / "c/d", b"2"), (folder / "a", b"2")]
    died = 0
    for _ in deaths(lambda: History(project.folder).write("change", {}, writes), removals=True):
        died += 1
        taken_back = History(project.folder).recover()
        assert taken_back is None or taken_back.entry.title == "change"
        if History(project.folder).state.undoable == 2:
            assert data(project) == {"a": b"2", "c/d": b"2"}
            History(project.folder).undo()
        assert data(project) == before
    assert died > 4 and data(project) == {"a": b"2", "c/d": b"2"}
    History(project.folder).undo()
    for _ in deaths(lambda: History(project.folder).write("change", {}, writes)):
        if data(project) != before:
            (folder / "c").mkdir(exist_ok=True)
            (folder / "c/d").write_text("of an editor")
            History(project.folder).recover()
            assert data(project)["c/d"] == b"of an editor"
            break


@needs_fork
def test_an_edit_after_some_were_undone_may_be_killed_as_well(tmp_path: Path) -> None:
    project = bare(tmp_path)
    history = History.open(project.folder)
    for value in "123":
        make_edit(history, project, Write(files={"a": value}))
    for _ in deaths(lambda: _branch(project)):
        history = History.open(project.folder)
        while history.redo():
            pass
        while history.undo():
            pass
        assert data(project) == {}
    assert data(project) == {"a": b"4"}


def _branch(project: object) -> None:
    from meshforge.project import Project

    assert isinstance(project, Project)
    history = History.open(project.folder)
    history.undo()
    history.undo()
    make_edit(history, project, Write(files={"a": "4"}))
