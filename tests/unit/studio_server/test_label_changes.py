"""What the history says about propagated labels: what changed, which labels came since, and undo."""

from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.project import GIVEN, Project, PropagationState
from meshforge.store import History
from meshforge.studio.edits.assets import LabelHulls, RenameLabel
from meshforge.studio.edits.base import Edit, make_edit
from meshforge.studio.label_changes import LabelChanges
from meshforge.studio.wire.family import Card
from meshforge.symbolic import GIVEN_SOURCES, HUMAN_SOURCES, Label
from tests.examples import examples
from tests.unit.batch.families import label_of, table_boxes, tree
from tests.unit.deaths import deaths, needs_fork
from tests.unit.labels.test_label_by_propagation import NAMES, family

ASSETS = ("t0.obj", "t1.obj", "t2.obj")


def label(asset: str, hull: str, to: str | None) -> LabelHulls:
    return LabelHulls(hulls={asset: (hull,)}, label=to)


def labelled(folder: Path) -> tuple[Project, History]:
    """Three tables, of which one is labelled."""
    project = family(folder)
    project.set_labels("t0.obj", {name: label_of(name) for name in NAMES})
    return project, History.open(project.folder)


def carry(project: Project, history: History, best: str | None = "t1.obj") -> None:
    """Propagate labels, as the job does."""
    with recorded(project, history, history.state.undoable, best):
        project.label("propagate")


def recorded(project: Project, history: History, used: int, best: str | None) -> AbstractContextManager[int]:
    edit = {"kind": "label-all", "used": used, "next": best}
    return history.record("hulls labelled", edit, [project.folder / "labels"])


def labels(project: Project) -> dict[str, bytes]:
    return tree(project.folder / "labels")


def cards(project: Project) -> list[Card]:
    rows = {asset: project.labels(asset).labels for asset in ASSETS}
    given = {asset: {hull for hull, one in row.items() if one.source in GIVEN_SOURCES} for asset, row in rows.items()}
    return [Card(asset=asset, confidence=tuple(GIVEN if n in given[asset] else 60 for n in NAMES)) for asset in ASSETS]


def read_propagation(project: Project, history: History) -> PropagationState | None:
    return LabelChanges(history).propagation_state(cards(project))


def test_what_a_person_says_since_is_counted_until_labels_are_carried_over_again(tmp_path: Path) -> None:
    project, history = labelled(tmp_path)
    assert read_propagation(project, history) is None
    carry(project, history)
    assert read_propagation(project, history) == PropagationState(unused=0, next="t1.obj")

    def unused_after(edit: Edit) -> int:
        make_edit(history, project, edit)
        now = read_propagation(project, history)
        assert now
        return now.unused

    assert unused_after(label("t1.obj", "crumb", "leg")) == 1
    assert unused_after(label("t1.obj", "crumb", "misc")) == 1
    assert unused_after(label("t1.obj", "top", "top")) == 2, "a label that was right is news, now that a person says it"
    assert unused_after(label("t0.obj", "top", "misc")) == 3
    assert unused_after(RenameLabel(old="leg", new="foot")) == 3
    assert unused_after(label("t1.obj", "crumb", None)) == 2
    history.undo()
    assert read_propagation(project, history) == PropagationState(unused=3, next="t1.obj")
    project.set_labels("t2.obj", {"top": "misc"}, source="propagated", confidence=0.2)
    carry(project, history, "t2.obj")
    assert read_propagation(project, history) == PropagationState(unused=0, next="t2.obj")
    history.undo()
    assert read_propagation(project, history) == PropagationState(unused=3, next="t1.obj")


def test_labels_are_used_also_where_that_changes_none(tmp_path: Path) -> None:
    project, history = labelled(tmp_path)
    relabelling = LabelChanges(history)
    relabelling.note_no_change(0, "t2.obj")
    assert relabelling.propagation_state(cards(project)) == PropagationState(unused=0, next="t2.obj")
    carry(project, history)
    make_edit(history, project, label("t1.obj", "top", "top"))
    assert relabelling.propagation_state(cards(project)) == PropagationState(unused=1, next="t1.obj")
    relabelling.note_no_change(2, "t2.obj")
    assert relabelling.propagation_state(cards(project)) == PropagationState(unused=0, next="t2.obj")
    make_edit(history, project, label("t2.obj", "top", "top"))
    assert relabelling.propagation_state(cards(project)) == PropagationState(unused=1, next="t2.obj")
    history.undo()
    history.undo()
    assert relabelling.propagation_state(cards(project)) == PropagationState(unused=0, next="t1.obj"), (
        "before it was said"
    )


def test_what_is_said_while_labels_are_carried_over_is_kept_and_is_news(tmp_path: Path) -> None:
    project, history = labelled(tmp_path)

    @contextmanager
    def keeping(best: str | None) -> Iterator[None]:
        make_edit(history, project, label("t1.obj", "crumb", "leg"))
        with recorded(project, history, 0, best):
            yield

    project.label("propagate", write_block=keeping)
    assert project.labels("t1.obj").labels["crumb"] == Label("leg")
    now = read_propagation(project, history)
    assert now and now.unused == 1
    history.undo()
    assert {name: one.name for name, one in project.labels("t1.obj").labels.items()} == {"crumb": "leg"}


def test_a_damaged_history_tells_less_and_fails_nowhere(tmp_path: Path) -> None:
    project, history = labelled(tmp_path)
    carry(project, history)
    make_edit(history, project, label("t1.obj", "crumb", "leg"))
    for blob in (project.folder / ".meshforge/studio/history/blobs").glob("*/*"):
        blob.write_bytes(b"{")
    found = read_propagation(project, history)
    assert found and found.next == "t1.obj"
    history = History.open(project.folder)
    make_edit(history, project, label("t1.obj", "crumb", "misc"))
    assert read_propagation(project, history) == PropagationState(unused=1, next="t1.obj")


MOVES = st.lists(
    st.one_of(
        st.builds(
            label, st.sampled_from(ASSETS), st.sampled_from(tuple(table_boxes())), st.sampled_from(["leg", "misc"])
        ),
        st.sampled_from(["carry", "carry", "undo", "redo", "reopen"]),
    ),
    max_size=8,
)


@examples(12)
@given(moves=MOVES)
def test_no_label_of_a_person_is_ever_lost(
    tmp_path_factory: pytest.TempPathFactory, moves: Sequence[LabelHulls | str]
) -> None:
    project, history = labelled(tmp_path_factory.mktemp("family"))
    states, at = [(labels(project), _said(project))], 0
    for move in moves:
        if move == "reopen":
            history = History.open(project.folder)
        elif move in ("undo", "redo"):
            way = -1 if move == "undo" else 1
            moved = bool(history.undo() if move == "undo" else history.redo())
            at += way if moved else 0
        else:
            said = dict(states[at][1])
            if isinstance(move, LabelHulls):
                changed = make_edit(history, project, move) is not None
                said |= {(asset, hull): str(move.label) for asset, (hull,) in move.hulls.items()}
            else:
                done = history.state.undoable
                carry(project, history)
                changed = history.state.undoable > done
            if changed:
                states, at = [*states[: at + 1], (labels(project), said)], at + 1
        assert (labels(project), _said(project)) == states[at]


def _said(project: Project) -> dict[tuple[str, str], str]:
    """What people said, by asset and hull."""
    return {
        (asset, name): one.name
        for asset in ASSETS
        for name, one in project.labels(asset).labels.items()
        if one.source in HUMAN_SOURCES
    }


@needs_fork
def test_carrying_over_that_is_killed_leaves_whole_labels_and_can_be_taken_back(tmp_path: Path) -> None:
    project, history = labelled(tmp_path)
    make_edit(history, project, label("t1.obj", "crumb", "leg"))
    before, said = labels(project), _said(project)
    for _ in deaths(lambda: carry(project, History.open(project.folder))):
        left = {name: text for name, text in labels(project).items() if not name.endswith(".tmp")}
        assert _said(project) == said
        history = History.open(project.folder)
        if left == before:
            assert history.state.undoable == 1
            continue
        assert history.state.undo == "hulls labelled"
        history.undo()
        assert {name: text for name, text in labels(project).items() if not name.endswith(".tmp")} == before
    assert _said(project) == said
    assert len(project.labels("t2.obj").labels) == len(NAMES)
