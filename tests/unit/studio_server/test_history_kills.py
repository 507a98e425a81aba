"""A studio that is killed has made an edit whole, or it can be taken back whole."""

from __future__ import annotations

from pathlib import Path

from meshforge.studio.history import History
from tests.unit.deaths import deaths, needs_fork
from tests.unit.studio_server.writing import Write, bare, data

BEFORE: dict[str, str | None] = {"a": "1", "b": "1"}
EDIT = Write(files={"a": "2", "b": None, "c/d": "2"})


@needs_fork
def test_a_killed_edit_can_be_undone_or_never_was(tmp_path: Path) -> None:
    project = bare(tmp_path)
    History(project).do(project, Write(files=BEFORE))
    before = data(project)
    for _ in deaths(lambda: History(project).do(project, EDIT)):
        left = data(project)
        history = History(project)
        assert data(project) == left
        assert history.view.undoable == (1 if left == before else 2)
        if left != before:
            assert history.undo(project)
        assert data(project) == before
    assert data(project) == {"a": b"2", "c/d": b"2"}


@needs_fork
def test_a_killed_undo_is_brought_to_its_end(tmp_path: Path) -> None:
    project = bare(tmp_path)
    history = History(project)
    history.do(project, Write(files=BEFORE))
    before = data(project)
    history.do(project, EDIT)
    after = data(project)
    for _ in deaths(lambda: History(project).undo(project)):
        history = History(project)
        assert data(project) == (before if history.view.redoable else after)
        while history.view.redoable:
            history.redo(project)
        assert data(project) == after
    assert data(project) == before


@needs_fork
def test_an_edit_after_some_were_undone_may_be_killed_as_well(tmp_path: Path) -> None:
    project = bare(tmp_path)
    history = History(project)
    for value in "123":
        history.do(project, Write(files={"a": value}))
    for _ in deaths(lambda: _branch(project)):
        history = History(project)
        while history.redo(project):
            pass
        while history.undo(project):
            pass
        assert data(project) == {}
    assert data(project) == {"a": b"4"}


def _branch(project: object) -> None:
    from meshforge.project import Project

    assert isinstance(project, Project)
    history = History(project)
    history.undo(project)
    history.undo(project)
    history.do(project, Write(files={"a": "4"}))
