"""Labellers on a few meshes: what they are scored by, and a model on loopback, which is asked five times."""

import json
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from benchmark import __main__ as bench
from benchmark.assets import CATEGORIES
from benchmark.labels import labellers
from benchmark.labels import model as model_module
from benchmark.labels.families import LABELLED, Family, families
from benchmark.labels.methods import REPEATS, LabellerOutput, Method, offline
from benchmark.labels.scores import score_labels
from meshforge.common import UsageError
from meshforge.labels.vlm.prompt import MeshHulls, PromptConfig, build_questions
from meshforge.store import VlmSettings
from tests.loopback import Asked, labels_as_json, serving
from tests.unit.benchmark.model_asking import PRICES, key, settings_file

__all__ = ["key"]
pytestmark = pytest.mark.usefixtures("key")
SIZE = 256
SMALL = f"size = {SIZE}\n"


@pytest.fixture(scope="module")
def cups() -> Family:
    (family,) = families(4, ("cup",), ("coarse",))
    return family


@pytest.mark.long
def test_the_sample_is_spread_over_categories_and_assets_and_leaves_out_what_is_labelled_by_hand(cups: Family) -> None:
    drawn = families(200)
    assert len(drawn) == 24
    assert Counter(family.name for family in drawn for _ in family.drawn) == dict.fromkeys(CATEGORIES, 25)
    assert [family.count for family in families(11)] == [1] * 11
    assert [(family.name, family.setting) for family in families(1)] == [("cup", "coarse")]
    (every,) = families(22, ("cup",), ("coarse",))
    assert len(every.drawn) == len(set(every.drawn)) == 22
    assert set(every.drawn) == set(range(25)) - set(every.advised)
    assert all(len({sample.asset.name for sample in family.samples}) == 25 for family in drawn)
    assert len({family.samples[place].asset.name for family in drawn[::8] for place in family.drawn}) >= 20
    assert len(cups.advised) == LABELLED
    assert set(cups.drawn) <= set(every.drawn)
    assert not any(hull.label for mesh in cups.bare for hull in mesh.hulls)
    for wrong in (0, -1, 529):
        with pytest.raises(UsageError, match="cannot be drawn"):
            families(wrong)


def truth(family: Family) -> list[list[str]]:
    return [[hull.label or "" for hull in family.samples[place].mesh.hulls] for place in family.drawn]


def test_none_and_foreign_words_count_as_wrong_and_repeats_are_held_against_each_other(cups: Family) -> None:
    right = truth(cups)
    hulls = sum(map(len, right))
    first = tuple(tuple(row) for row in right)
    other = (("gizmo", None, *right[0][2:]), *first[1:])
    told = [[LabellerOutput(other, cost=0.4)], [LabellerOutput(first)], [LabellerOutput(first)]]
    score = score_labels(Method("one", lambda family, repeat: told[repeat][0]), [cups], told)
    assert score.accuracy == pytest.approx(1 - 2 / hulls)
    assert score.unlabelled == pytest.approx(1 / hulls)
    assert score.foreign == pytest.approx(1 / hulls)
    assert score.agreement == pytest.approx(1 - 2 / hulls)
    assert score.friedman == pytest.approx(0.3679, abs=1e-3)  # one mesh of four differs: chi squared 2 of 2 degrees
    assert (score.meshes, score.cost, score.of("cup")) == (4, 0.4, score.accuracy)
    pure = [p >= 0.8 for place in cups.drawn for p in cups.samples[place].purities]
    assert score.accuracy_pure == pytest.approx(1 - sum(pure[:2]) / sum(pure))
    same = score_labels(Method("one", lambda family, repeat: told[1][0]), [cups], told[1:] * 2)
    assert (same.accuracy, same.agreement, same.friedman) == (1.0, 1.0, None)
    alone = score_labels(Method("one", lambda family, repeat: told[0][0]), [cups], told[:1])
    assert (alone.agreement, alone.friedman) == (None, None)


class Model:
    """A model that knows the meshes by their first picture, and what is wrong with its answers."""

    def __init__(self, family: Family) -> None:
        self.truth: dict[bytes, dict[int, str]] = {}
        for place, labels in zip(family.drawn, truth(family), strict=True):
            mesh, config = family.bare[place], PromptConfig(family.vocabulary, VlmSettings(size=SIZE))
            (asked,) = build_questions([MeshHulls("", mesh, [*mesh.index])], config)
            self.truth[next(asked.question.pictures)] = dict(enumerate(labels))
        self.asked = 0

    def __call__(self, asked: Asked) -> str:
        right = self.truth[asked.pictures[0]]
        said = {number: right[number] for number in asked.numbers}
        said |= {0: "gizmo"} if 0 in said else {}
        self.asked += 1
        return labels_as_json(said)


@pytest.fixture
def answers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where answers are kept; of the labellers that ask nobody only the quickest is tried beside the model."""
    monkeypatch.setattr(labellers, "offline", lambda folders: [row for row in offline(folders) if row.name == "names"])
    monkeypatch.setattr(model_module, "JOURNALS", tmp_path / "journals")
    return tmp_path / "journals"


def run(out: Path, *more: object) -> dict[str, Any]:
    assert bench.main(["labellers", "--quick", "--sample", "2", "--out", str(out), *map(str, more)]) == 0
    found = json.loads((out / "labels-labellers.json").read_text("utf-8"))
    table = found["tables"][0]
    return {row[0]: dict(zip(table["columns"], row, strict=True)) for row in table["rows"]} | {"notes": found["notes"]}


def test_without_a_model_its_row_says_so(tmp_path: Path) -> None:
    found = run(tmp_path)
    assert set(list(found["a vision-language model"].values())[1:]) == {"not run"}
    assert found["paper: GPT-4o"]["right"] == 0.92
    assert found["propagation, 2 labelled"]["repeats"] == REPEATS
    assert any("No model was named." in note for note in found["notes"])
    assert "## Labellers on the same meshes" in (tmp_path / "labels.md").read_text("utf-8")


def test_a_model_is_asked_five_times_and_its_price_is_that_of_once(tmp_path: Path, answers: Path) -> None:
    (family,) = families(2, ("cup",), ("coarse",))
    model = Model(family)
    with serving(model) as server:
        settings = settings_file(server, tmp_path / "vlm.toml", SMALL)
        found = run(tmp_path / "out", "--vlm", settings)
        asked, spent = model.asked, dict(server.usage)
        again = run(tmp_path / "again", "--vlm", settings)
        assert model.asked == asked
    row, other = found["loopback-vl"], again["loopback-vl"]
    assert {**row, "s a mesh": 0, "$ a mesh": 0} == {**other, "s a mesh": 0, "$ a mesh": 0}
    assert row["$ a mesh"] == pytest.approx(other["$ a mesh"])  # added up as answers come
    assert asked == 2 * REPEATS
    hulls = sum(map(len, truth(family)))
    assert row["right"] == pytest.approx(1 - 2 / hulls)
    assert row["no label, %"] == pytest.approx(200 / hulls)
    assert (row["repeats"], row["all repeats agree, %"], row["Friedman, p"]) == (REPEATS, 100, "no difference")
    cost = (PRICES[0] * spent["input"] + PRICES[1] * spent["output"]) / 1e6
    assert row["$ a mesh"] == pytest.approx(cost / REPEATS / 2, rel=0.2)  # but for probes
    assert any("loopback-vl, asked about all hulls" in note for note in found["notes"])
