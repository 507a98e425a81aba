import json
import pickle
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.common import AssetError
from meshforge.geometry import Aabb, Box, digest
from meshforge.symbolic import (
    INFERRED_SOURCES,
    LABEL_SOURCES,
    Hull,
    Label,
    LabelFile,
    SymbolicMesh,
    format_labels,
    read_labels,
    write_labels,
)
from tests.examples import examples


def box(x: float) -> Box:
    return Box.of_bounds(Aabb([x, 0, 0], [x + 1, 1, 1]))


def mesh() -> SymbolicMesh:
    return SymbolicMesh(
        (
            Hull("top", "body", box(0), Label("panel", 0.5, "vlm")),
            Hull("bare", "body", box(2)),
            Hull("ножка/1#2", "body", box(4), Label("leg", 1.0, "user")),
        )
    )


def written(path: Path, data: object) -> Path:
    path.write_text(data if isinstance(data, str) else json.dumps(data), encoding="utf-8")
    return path


def test_what_is_written_reads_back_the_same(tmp_path: Path) -> None:
    write_labels(tmp_path / "x.labels.json", mesh(), ["leg", "panel"])
    file = read_labels(tmp_path / "x.labels.json")
    assert file.vocabulary == ("leg", "panel")
    assert dict(file.labels) == mesh().labels
    assert file.digests == {"top": digest(box(0)), "ножка/1#2": digest(box(4))}


def test_a_hull_is_a_line_and_the_text_ends_with_a_new_line() -> None:
    text = write_labels(None, mesh(), ["panel", "leg"])
    geometry = digest(box(0))
    assert text.splitlines()[3] == (
        f'    "top": {{"label": "panel", "confidence": 0.5, "source": "vlm", "digest": "{geometry}"}},'
    )
    assert len(text.splitlines()) == 7
    assert text.endswith("}\n")


def test_a_mesh_without_labels_writes_an_empty_file_that_reads_back(tmp_path: Path) -> None:
    write_labels(tmp_path / "x.json", SymbolicMesh((Hull("a", "b", box(0)),)), ["leg"])
    file = read_labels(tmp_path / "x.json")
    assert (file.vocabulary, dict(file.labels)) == (("leg",), {})


def test_labels_that_the_vocabulary_lacks_are_added_to_it() -> None:
    assert json.loads(write_labels(None, mesh(), ["leg", "drawer"]))["vocabulary"] == ["leg", "drawer", "panel"]


def test_the_short_form_is_read_as_certain_and_of_source_file(tmp_path: Path) -> None:
    file = read_labels(written(tmp_path / "x.json", {"hulls": {"a": "leg", "b": None}}))
    assert dict(file.labels) == {"a": Label("leg", 1.0, "file")}
    assert not file.digests


def test_a_labels_file_pickles(tmp_path: Path) -> None:
    file = read_labels(written(tmp_path / "x.json", {"hulls": {"a": "leg"}}))
    assert pickle.loads(pickle.dumps(file)).labels == dict(file.labels)


def inferred(given: object) -> dict[str, object]:
    """A file with one label, and what was given before it."""
    return {"hulls": {"a": {"label": "panel", "confidence": 0.9, "source": "propagated", "given": given}}}


def test_the_label_that_an_inferred_one_replaced_is_written_and_read(tmp_path: Path) -> None:
    label = Label("leg", 0.875, "propagated", Label("panel", 0.5, "vlm"))
    text = write_labels(tmp_path / "x.json", SymbolicMesh((Hull("top", "body", box(0), label),)), ["leg"])
    assert '"source": "propagated", "given": {"label": "panel", "confidence": 0.5, "source": "vlm"}, "digest"' in text
    file = read_labels(tmp_path / "x.json")
    assert (file.vocabulary, file.labels["top"]) == (("leg", "panel"), label)


WORDS = st.text(st.characters(exclude_categories=["C", "Z"]), min_size=1)
ANSWERS = st.builds(Label, WORDS, st.floats(0, 1), st.sampled_from(sorted({*LABEL_SOURCES} - INFERRED_SOURCES)))
INFERRED = st.builds(Label, WORDS, st.floats(0, 1), st.sampled_from(sorted(INFERRED_SOURCES)), st.none() | ANSWERS)


@examples(100)
@given(labels=st.dictionaries(st.text(), ANSWERS | INFERRED), vocabulary=st.lists(WORDS))
def test_whatever_labels_say_is_read_as_it_was_written(
    tmp_path_factory: pytest.TempPathFactory, labels: dict[str, Label], vocabulary: list[str]
) -> None:
    path = tmp_path_factory.mktemp("labels") / "x.json"
    path.write_text(format_labels(LabelFile(tuple(vocabulary), labels)), encoding="utf-8")
    file = read_labels(path)
    assert dict(file.labels) == labels
    assert format_labels(file) == path.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("data", "message"),
    [
        ("{", r"x\.json:1:2: the labels are no JSON"),
        ([], "this is no labels file"),
        ({"hulls": []}, "this is no labels file"),
        ({"hulls": {}, "more": 1}, "is not one of a labels file"),
        ({"vocabulary": "leg", "hulls": {}}, "vocabulary is not a list"),
        ({"hulls": {"a": 1}}, "hull 'a' has no label"),
        ({"hulls": {"a": {"confidence": 1}}}, "hull 'a' has no label"),
        ({"hulls": {"a": {"label": "leg", "confidence": 1.5}}}, "confidence of hull 'a' is 1.5"),
        ({"hulls": {"a": {"label": "leg", "confidence": True}}}, "confidence of hull 'a' is True"),
        ({"hulls": {"a": {"label": "leg", "source": "me"}}}, "source of hull 'a' is 'me'"),
        ({"vocabulary": ["panel", "leg"], "hulls": {"a": "panell"}}, "'panell' of hull 'a'.*\n.*'panel'"),
        ('{"hulls": {"a": "leg", "a": "panel"}}', "'a' is given twice"),
        (inferred("leg"), "what hull 'a' was given before is no label that a person, a file or a machine gave"),
        (inferred({"label": "leg", "source": "propagated"}), "what hull 'a' was given before is no label"),
        (inferred({"label": "leg", "given": {"label": "leg"}}), "what hull 'a' was given before is no label"),
        (inferred({"label": "leg", "source": "me"}), "source of hull 'a' is 'me'"),
        (inferred({"label": "leg", "confidence": 2}), "confidence of hull 'a' is 2"),
        (inferred({"label": "legs"}) | {"vocabulary": ["panel", "leg"]}, "'legs' of hull 'a'.*\n.*'leg'"),
        ('{"hulls": {"a": {"label": "leg", "confidence": NaN}}}', "confidence of hull 'a' is nan"),
    ],
)
def test_a_wrong_file_is_refused_with_its_name_and_the_hull(tmp_path: Path, data: object, message: str) -> None:
    with pytest.raises(AssetError, match=message) as caught:
        read_labels(written(tmp_path / "x.json", data))
    assert "x.json" in str(caught.value)


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(AssetError, match=r"none\.json: the labels cannot be read"):
        read_labels(tmp_path / "none.json")


def test_a_file_that_is_no_text_is_named(tmp_path: Path) -> None:
    (tmp_path / "x.json").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(AssetError, match=r"x\.json: the labels are not UTF-8"):
        read_labels(tmp_path / "x.json")
