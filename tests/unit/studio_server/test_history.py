"""The history of a studio's edits: done, undone, beside changes from elsewhere, and whole after a kill."""

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.common import ProjectError
from meshforge.store import ConflictError, Effect, History
from meshforge.studio.edits.base import make_edit
from meshforge.studio.session.file_sync import FileChanges, changes_of
from tests.examples import examples
from tests.unit.deaths import deaths, needs_fork
from tests.unit.project.tables import FIRST, SECOND, fresh
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


def test_the_acts_around_the_present_state_are_those_that_undo_takes_at_once(tmp_path: Path) -> None:
    project = bare(tmp_path)
    history = History.open(project.folder)
    for k, group in enumerate(["a", None, "g", "g", "g", None]):
        with history.record(f"act {k}", {}, [tmp_path / "data" / "x"], group=group):
            (tmp_path / "data").mkdir(exist_ok=True)
            (tmp_path / "data" / "x").write_text(str(k))
    assert [(act.title, act.changes, act.done) for act in history.list_acts(9)] == [
        ("act 0", 1, 1), ("act 1", 1, 2), ("act 4", 3, 5), ("act 5", 1, 6)]  # fmt: skip
    history.undo()
    history.undo()
    assert [act.title for act in history.list_acts(1)] == ["act 1", "act 4"]


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


ONE = frozenset({FIRST})
LEARNING: frozenset[Effect] = frozenset({"learning"})


@pytest.mark.parametrize(
    ("name", "means"),
    [
        (f"labels/{FIRST}.json", FileChanges(ONE, effects=LEARNING)),
        (f"demonstrations/{FIRST}.json", FileChanges(ONE, effects=LEARNING)),
        (f"corrections/{FIRST}.json", FileChanges(assets=ONE)),
        (f"edited/.meshforge/stamps/{FIRST}.json", FileChanges(assets=ONE)),
        (f"prepared/{FIRST}/preparation.json", FileChanges(ONE, ONE, LEARNING)),
        (f"../assets/{FIRST}", FileChanges(ONE, ONE, LEARNING)),
        ("program.mf", FileChanges(effects=LEARNING | {"program"})),
        ("learned.json", FileChanges(effects=frozenset({"program"}))),
        ("signoffs.jsonl", FileChanges()),
        ("labels/gone.obj.json", FileChanges(effects=LEARNING)),
        ("notes.txt", FileChanges()),
    ],
)
def test_a_file_that_changed_means_what_depends_on_it(tmp_path: Path, name: str, means: FileChanges) -> None:
    assert changes_of(fresh(tmp_path), [name]) == means


def test_settings_concern_every_asset(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    found = changes_of(project, ["meshforge.toml"])
    assert found.assets == set(project.assets()) and found.effects == {"settings", "learning"}
    assert SECOND in found.assets and not found.shapes
