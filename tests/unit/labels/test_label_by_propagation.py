from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.common import ProjectError
from meshforge.project import Project
from meshforge.symbolic import HUMAN_SOURCES, Label
from tests.examples import examples
from tests.unit.batch.families import label_of, table_boxes, write_table

NAMES = tuple(table_boxes())


def family(folder: Path, count: int = 3, *vocabulary: str) -> Project:
    """Tables of different heights, none of which is labelled."""
    for k in range(count):
        write_table(folder / f"assets/t{k}.obj", height=0.8 + 0.3 * k, labels=False)
    return Project.create(folder / "p", [folder / "assets"], vocabulary=vocabulary or ("top", "leg", "misc"))


def test_one_labelled_table_labels_the_others(tmp_path: Path) -> None:
    project = family(tmp_path)
    project.set_labels("t0.obj", {name: label_of(name) for name in NAMES})
    carried = project.label("propagate")
    assert [report.asset for report in carried.outcomes] == ["t0.obj", "t1.obj", "t2.obj"]
    assert [report.taken for report in carried.outcomes] == [0, len(NAMES), len(NAMES)]
    assert carried.next in ("t1.obj", "t2.obj")
    for asset in ("t1.obj", "t2.obj"):
        labels = project.labels(asset).labels
        assert {name: label.name for name, label in labels.items()} == {name: label_of(name) for name in NAMES}
        assert {label.source for label in labels.values()} == {"propagated"}


def test_again_changes_nothing_and_a_correction_teaches_the_others(tmp_path: Path) -> None:
    project = family(tmp_path)
    project.set_labels("t0.obj", {name: label_of(name) for name in NAMES})
    project.label("propagate")
    before = project.labels("t1.obj").labels
    assert [report.same for report in project.label("propagate").outcomes] == [len(NAMES)] * 3
    assert project.labels("t1.obj").labels == before
    project.set_labels("t1.obj", {"crumb": "leg"})
    project.label("propagate")
    assert project.labels("t1.obj").labels["crumb"] == Label("leg")
    crumb = project.labels("t2.obj").labels["crumb"]
    assert crumb.name == "leg" or crumb.confidence < before["crumb"].confidence


def test_what_a_file_says_without_being_sure_teaches_little(tmp_path: Path) -> None:
    project = family(tmp_path)
    wrong = dict.fromkeys(NAMES, "misc")
    project.set_labels("t0.obj", wrong, source="file", confidence=0.4)
    assert "nothing follows from one alone" in project.label("propagate").notes[0]
    assert not project.labels("t2.obj").labels
    project.set_labels("t1.obj", {name: label_of(name) for name in NAMES}, source="file", confidence=0.8)
    project.label("propagate")
    assert {name: label.name for name, label in project.labels("t2.obj").labels.items()} == {
        name: label_of(name) for name in NAMES
    }


def test_without_a_label_or_a_vocabulary_it_says_what_to_do(tmp_path: Path) -> None:
    project = family(tmp_path)
    with pytest.raises(ProjectError, match=r"no label that others could be taken from\n  Label .* best t\d\.obj"):
        project.label("propagate")
    project.set_labels("t0.obj", {NAMES[0]: label_of(NAMES[0])})
    project.set_vocabulary(())
    with pytest.raises(ProjectError, match="the vocabulary is empty"):
        project.label("propagate")


def test_a_label_that_left_the_vocabulary_teaches_nothing(tmp_path: Path) -> None:
    project = family(tmp_path)
    project.set_labels("t0.obj", {name: label_of(name) for name in NAMES})
    project.set_vocabulary(("top", "leg"))
    carried = project.label("propagate")
    assert not any(report.problems for report in carried.outcomes)
    assert {label.name for label in project.labels("t1.obj").labels.values()} == {"top", "leg"}
    assert project.labels("t0.obj").labels["crumb"] == Label("misc")


Act = tuple[str, str, str, str]
ACTS = st.lists(
    st.tuples(
        st.sampled_from(["user", "vlm", "name", "propagate"]),
        st.sampled_from(["t0.obj", "t1.obj"]),
        st.sampled_from(NAMES),
        st.sampled_from(["top", "leg", "misc"]),
    ),
    max_size=12,
)


@examples(25)
@given(acts=ACTS)
def test_no_label_of_a_person_is_changed_by_machine(tmp_path_factory: pytest.TempPathFactory, acts: list[Act]) -> None:
    project = family(tmp_path_factory.mktemp("family"), 2)
    said: dict[tuple[str, str], str] = {}
    for who, asset, hull, label in acts:
        match who:
            case "user":
                project.set_labels(asset, {hull: label})
                said[asset, hull] = label
            case "propagate" if said:
                project.label("propagate")
            case "vlm" | "name":
                project.set_labels(asset, {hull: label}, source=who, confidence=0.9)
        kept = {
            (one, name): label.name
            for one in project.assets()
            for name, label in project.labels(one).labels.items()
            if label.source in HUMAN_SOURCES
        }
        assert kept == said
