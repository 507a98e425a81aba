from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.common import ProjectError
from meshforge.store import ConflictError, History
from meshforge.studio.edits.base import make_edit
from tests.examples import examples
from tests.unit.studio_server.writing import Write, bare, data

NAMES = st.sampled_from(["a", "b", "deep/c", "deep/er/d"])
WRITES = st.builds(
    lambda files: Write(files=files), st.dictionaries(NAMES, st.sampled_from(["1", "2", None]), min_size=1, max_size=3)
)
MOVES = st.lists(st.one_of(WRITES, st.sampled_from(["undo", "redo", "reopen"])), max_size=14)


@examples(40)
@given(MOVES)
def test_undo_and_redo_walk_through_the_very_states_that_were(moves: Sequence[Write | str]) -> None:
    with TemporaryDirectory() as folder:
        project = bare(Path(folder))
        history, states, at = History.open(project.folder), [data(project)], 0
        for move in moves:
            if isinstance(move, Write):
                changed = make_edit(history, project, move) is not None
                now = data(project)
                assert changed == (now != states[at])
                if changed:
                    states, at = [*states[: at + 1], now], at + 1
            elif move == "reopen":
                history = History.open(project.folder)
            else:
                way = -1 if move == "undo" else 1
                possible = 0 <= at + way < len(states)
                assert bool(history.undo() if way < 0 else history.redo()) == possible
                at += way if possible else 0
            assert data(project) == states[at]
            assert (history.state.undoable, history.state.redoable) == (at, len(states) - 1 - at)


def test_a_failed_edit_leaves_nothing_behind(tmp_path: Path) -> None:
    project = bare(tmp_path)
    history = History.open(project.folder)
    make_edit(history, project, Write(files={"a": "1"}))
    with pytest.raises(ProjectError):
        make_edit(history, project, Write(files={"a": "2", "new/b": "2", "c": "2"}, fails=2))
    assert data(project) == {"a": b"1"}
    assert history.state.undoable == 1


def test_what_something_else_changed_is_not_undone(tmp_path: Path) -> None:
    project = bare(tmp_path)
    history = History.open(project.folder)
    make_edit(history, project, Write(files={"a": "1", "b": "1"}))
    (tmp_path / "data" / "b").write_text("from an editor")
    with pytest.raises(ConflictError, match=r"data/b was changed since"):
        history.undo()
    assert data(project) == {"a": b"1", "b": b"from an editor"}
    assert history.state.undoable == 1
    (tmp_path / "data" / "b").write_text("1")
    history.undo()
    assert data(project) == {}


def test_what_learning_writes_is_put_back_whatever_it_is_by_then(tmp_path: Path) -> None:
    project = bare(tmp_path)
    history = History.open(project.folder, lambda: frozenset({"data/learned"}))
    make_edit(history, project, Write(files={"learned": "1"}))
    make_edit(history, project, Write(files={"learned": "by hand"}))
    (tmp_path / "data" / "learned").write_text("learned anew")
    history.undo()
    assert data(project) == {"learned": b"1"}


def test_entries_of_one_group_are_undone_together(tmp_path: Path) -> None:
    project = bare(tmp_path)
    history = History.open(project.folder)
    make_edit(history, project, Write(files={"a": "1"}))
    for name in ("b", "c"):
        edit = Write(files={name: "1"})
        with history.record(f"wrote {name}", {}, [project.folder / "data"], group="job"):
            edit.apply(project)
    assert [entry.title for entry in history.undo()] == ["wrote c", "wrote b"]
    assert data(project) == {"a": b"1"}
    assert len(history.redo()) == 2
    assert history.state.undoable == 3


def test_contents_that_nothing_mentions_are_forgotten_on_opening(tmp_path: Path) -> None:
    project = bare(tmp_path)
    history = History.open(project.folder)
    blobs = tmp_path / ".meshforge" / "studio" / "history" / "blobs"
    make_edit(history, project, Write(files={"a": "1"}))
    history.undo()
    make_edit(history, project, Write(files={"a": "2"}))
    assert {blob.read_text() for blob in blobs.glob("*/*")} == {"1", "2"}
    History.open(project.folder)
    assert {blob.read_text() for blob in blobs.glob("*/*")} == {"2"}


def test_lost_contents_are_a_message_and_the_file_stays(tmp_path: Path) -> None:
    project = bare(tmp_path)
    history = History.open(project.folder)
    make_edit(history, project, Write(files={"a": "1"}))
    make_edit(history, project, Write(files={"a": "2"}))
    for blob in (tmp_path / ".meshforge" / "studio" / "history" / "blobs").glob("*/*"):
        blob.write_text("damaged")
    with pytest.raises(ProjectError, match="no longer kept"):
        history.undo()
    assert data(project) == {"a": b"2"}
