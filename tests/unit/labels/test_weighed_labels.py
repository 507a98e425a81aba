"""Labels of all sources weighed together: a person's stays, right ones stay as they are, and all can be put back."""

from contextlib import ExitStack
from pathlib import Path
from typing import cast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.batch import ExecutionOptions
from meshforge.common import StoppedError
from meshforge.labels import LabelChange
from meshforge.project import Project
from meshforge.symbolic import HUMAN_SOURCES, INFERRED_SOURCES, Label, LabelSource
from tests.examples import examples
from tests.unit.batch.families import label_of, tree
from tests.unit.labels.test_label_by_propagation import NAMES, family

RIGHT = {name: label_of(name) for name in NAMES}


def guessed(folder: Path, count: int = 6) -> Project:
    """Tables that a model labelled, one hull of them wrongly and one not at all."""
    project = family(folder, count)
    for asset in project.assets():
        project.set_labels(asset, RIGHT, source="vlm", confidence=0.8)
    project.set_labels("t1.obj", {"top": "leg"}, source="vlm", confidence=0.8)
    project.set_labels("t2.obj", {"left_low": None})
    return project


def labels_of(project: Project) -> dict[tuple[str, str], Label]:
    return {(asset, name): one for asset in project.assets() for name, one in project.labels(asset).labels.items()}


def test_a_wrong_label_is_replaced_a_missing_one_found_and_right_ones_stay_as_they_are(tmp_path: Path) -> None:
    project = guessed(tmp_path)
    before = labels_of(project)
    result = project.label("propagate")
    now = labels_of(project)
    assert {place: label.name for place, label in now.items()} == {
        (asset, name): RIGHT[name] for asset in project.assets() for name in NAMES
    }
    changed = {place: label for place, label in now.items() if before.get(place) != label}
    assert changed.keys() == {("t1.obj", "top"), ("t2.obj", "left_low")}
    assert {label.source for label in changed.values()} == {"propagated"}
    assert changed["t1.obj", "top"].given == Label("leg", 0.8, "vlm")
    assert changed["t2.obj", "left_low"].given is None
    assert result.changes == (LabelChange(None, "leg", 1, 1), LabelChange("leg", "top", 1, 1))
    assert (result.free, result.alike) == (6 * len(NAMES), ())
    assert [report.taken for report in result.outcomes] == [0, 1, 1, 0, 0, 0]


def test_again_changes_nothing(tmp_path: Path) -> None:
    project = guessed(tmp_path)
    before = tree(project.folder / "labels")
    project.label("propagate")
    after = tree(project.folder / "labels")
    again = project.label("propagate")
    assert tree(project.folder / "labels") == after != before
    assert again.changes == () and not any(report.taken for report in again.outcomes)


def test_people_who_labelled_every_hull_are_left_alone(tmp_path: Path) -> None:
    project = family(tmp_path)
    for asset in project.assets():
        project.set_labels(asset, RIGHT | {"top": "misc" if asset == "t1.obj" else "top"})
    before = tree(project.folder / "labels")
    result = project.label("propagate")
    assert (result.free, result.changes, result.next) == (0, (), None)
    assert tree(project.folder / "labels") == before


def test_words_outside_of_the_vocabulary_say_nothing_but_are_kept(tmp_path: Path) -> None:
    project = guessed(tmp_path)
    project.set_labels("t4.obj", {"crumb": "misc", "right_low": "misc"})
    project.set_labels("t5.obj", {"crumb": "leg"})
    project.set_vocabulary(("top", "leg"))
    project.label("propagate")
    labels = labels_of(project)
    assert labels["t4.obj", "crumb"] == labels["t4.obj", "right_low"] == Label("misc")
    assert labels["t0.obj", "crumb"].name == "leg"
    assert labels["t0.obj", "crumb"].given == Label("misc", 0.8, "vlm")


@pytest.mark.parametrize(("source", "sure"), [("user", 1.0), ("file", 1.0), ("file", 0.6)])
def test_a_label_of_one_asset_alone_stays_where_a_person_or_file_gave_it(
    tmp_path: Path, source: LabelSource, sure: float
) -> None:
    project = guessed(tmp_path)
    project.set_vocabulary(("top", "leg", "misc", "knob"))
    hulls = ("crumb", "left_low", "right_low")
    for hull in hulls:
        project.set_labels("t3.obj", {hull: None})
        project.set_labels("t3.obj", {hull: "knob"}, source=source, confidence=sure)
    project.label("propagate")
    labels = project.labels("t3.obj").labels
    assert [labels[hull] for hull in hulls] == [Label("knob", sure, source)] * 3


def test_two_names_of_one_part_are_told(tmp_path: Path) -> None:
    project = family(tmp_path, 8, "top", "leg", "legs", "misc")
    for place, asset in enumerate(project.assets()):
        legs = {name: "legs" for name, label in RIGHT.items() if label == "leg" and place % 2}
        project.set_labels(asset, RIGHT | legs, source="user" if place < 2 else "vlm", confidence=0.8)
    result = project.label("propagate")
    assert result.alike == (("leg", "legs"),)
    assert project.labels("t1.obj").labels["left_low"] == Label("legs", 0.8)


def test_a_label_that_was_changed_meanwhile_stays(tmp_path: Path) -> None:
    project = guessed(tmp_path)

    def write(best: str | None) -> ExitStack:
        project.set_labels("t1.obj", {"top": "misc"}, source="name", confidence=0.3)
        return ExitStack()

    project.label("propagate", write_block=write)
    assert project.labels("t1.obj").labels["top"] == Label("misc", 0.3, "name")


def test_a_stop_leaves_all_labels_as_they_were(tmp_path: Path) -> None:
    project = guessed(tmp_path)
    before = tree(project.folder / "labels")
    with pytest.raises(StoppedError):
        project.label("propagate", execution=ExecutionOptions(0, stop=lambda: True))
    assert tree(project.folder / "labels") == before


def test_what_is_foretold_is_what_is_done_then(tmp_path: Path) -> None:
    project = guessed(tmp_path)
    before = tree(project.folder / "labels")
    shown = project.label("propagate", dry_run=True).proposals
    assert tree(project.folder / "labels") == before
    assert [(row.label, row.kind, row.hulls) for row in shown.rows] == [
        ("top", "likeness, not leg", 1),
        ("leg", "likeness", 1),
    ]
    assert shown.labelled == 6 * len(NAMES) - 2
    project.label("propagate")
    assert project.label("propagate", dry_run=True).proposals.rows == ()


ANSWERS = st.lists(
    st.tuples(
        st.sampled_from(["user", "vlm", "name", "file"]),
        st.sampled_from(["t0.obj", "t1.obj", "t2.obj"]),
        st.sampled_from(NAMES),
        st.sampled_from(["top", "leg", "misc"]),
        st.sampled_from([0.1, 0.5, 0.9]),
    ),
    min_size=1,
    max_size=24,
)


@examples(25)
@given(said=ANSWERS)
def test_whatever_is_said_people_stay_and_again_changes_nothing(
    tmp_path_factory: pytest.TempPathFactory, said: list[tuple[str, str, str, str, float]]
) -> None:
    project = family(tmp_path_factory.mktemp("family"))
    for source, asset, hull, label, sure in said:
        by = cast(LabelSource, source)
        project.set_labels(asset, {hull: label}, source=by, confidence=1.0 if by == "user" else sure)
    before = labels_of(project)
    project.label("propagate")
    once, after = tree(project.folder / "labels"), labels_of(project)
    assert all(after[place] == told for place, told in before.items() if told.source in HUMAN_SOURCES)
    for place, now in after.items():
        assert now == before.get(place) or (now.source in INFERRED_SOURCES and now.given == before.get(place))
    project.label("propagate")
    assert tree(project.folder / "labels") == once
    project.label("propagate") if any(label.source == "user" for label in before.values()) else None
    project.label("propagate")
    assert tree(project.folder / "labels") == once


def test_all_keeps_what_files_elsewhere_and_models_gave_beside_names(tmp_path: Path) -> None:
    project = guessed(tmp_path)
    kept = {"top": "top", "left_low": "leg", "crumb": "misc"}
    project.set_labels("t0.obj", kept, source="file", confidence=0.97)
    project.label()
    labels = project.labels("t0.obj").labels
    assert {hull: (labels[hull].name, labels[hull].source) for hull in kept} == {
        hull: (label, "file") for hull, label in kept.items()
    }
