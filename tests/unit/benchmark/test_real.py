"""Families of real assets: their labels and tasks are whole; and what a label file may not say."""

import json
import re
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmark.real.ceiling import judge_sample
from benchmark.real.examination import find_faults, find_unlabelled
from benchmark.real.family import families, family
from benchmark.real.parts import cut_parts, make_solids
from benchmark.real.regions import label_surface, parse_region
from benchmark.real.samples import RECORD, digest_of, is_pure, make_sample
from benchmark.real.surface import AssetSurface, Patch, read_surface
from benchmark.real.tasks import real_task, tasks_of
from meshforge.common import AssetError
from meshforge.geometry import Box, Pose
from tests.corpus_path import corpus

LABELS = ("panel", "leg")


def _patch(name: str, low: tuple[float, ...], high: tuple[float, ...]) -> Patch:
    middle, half = (np.array(low) + high) / 2, (np.array(high) - low) / 2
    box = Box(Pose.of_translation(middle), half)
    return Patch(name, np.asarray(box.vertices), np.asarray(box.faces))


def _table() -> AssetSurface:
    """A board on one leg, and a bar from the floor to the board that is leg below and panel above."""
    pieces = (
        _patch("board", (0, 0, 0.9), (1, 1, 1)),
        _patch("leg", (0, 0, 0), (0.1, 0.1, 0.9)),
        _patch("bar", (0.9, 0.9, 0), (1, 1, 0.9)),
    )
    return AssetSurface("table", pieces, Pose.identity())


def _regions(text: str) -> list[dict[str, Any]]:
    return list(tomllib.loads(text)["regions"])


def test_the_first_region_that_fits_wins_and_a_box_cuts_what_crosses_its_side() -> None:
    rows = _regions(
        'regions = [{label = "panel", pieces = ["bar"], box = [[0, 0, 0.5], [1, 1, 1]]}, '
        '{label = "leg", pieces = ["bar", "leg"]}, {label = "panel", part = "top"}]'
    )
    regions = [parse_region(row, LABELS, "table") for row in rows]
    found = label_surface(_table(), regions)
    assert [(row.patch.name, row.label, row.part) for row in found] == [
        ("board", "panel", "top"),
        ("leg", "leg", "leg_1"),
        ("bar", "panel", "panel_1"),
        ("bar", "leg", "leg_2"),
    ]
    upper = next(row.patch for row in found if row.part == "panel_1")
    assert upper.vertices[:, 2].min() == pytest.approx(0.5)
    assert sum(row.patch.area for row in found) == pytest.approx(sum(piece.area for piece in _table().pieces))


def test_parts_are_solids_cut_where_regions_end() -> None:
    rows: list[dict[str, Any]] = [
        {"label": "leg", "boxes": [[[0, 0, 0], [1, 1, 0.5]], [[0, 0, 0.5], [0.2, 1, 0.9]]]},
        {"label": "panel"},
    ]
    regions = [parse_region(row, LABELS, "table") for row in rows]
    parts = cut_parts(_table(), regions, make_solids(_table()))
    volumes = {part.name: part.solid.volume() for part in parts}
    assert volumes == pytest.approx({"leg_1": 0.009, "leg_2": 0.005, "panel_1": 0.1, "panel_2": 0.004}, rel=1e-3)


def test_a_region_that_matches_nothing_is_one_error_that_names_asset_and_region() -> None:
    region = parse_region({"label": "leg", "pieces": ["foot*"]}, LABELS, "table")
    with pytest.raises(AssetError, match=r"table: region 1 \(leg, pieces foot\*\) has no surface"):
        label_surface(_table(), [region])


@pytest.mark.parametrize(
    ("row", "told"),
    [
        ({"label": "lid"}, "'lid' is no label of the family"),
        ({"label": "leg", "piece": ["a"]}, "a region has no piece"),
        ({"label": "leg", "box": [[0, 0, 0], [1, 1]]}, "is no box"),
        ({"label": "leg", "box": [[0, 0, 0.5], [1, 1, 0.5]]}, "is no box"),
    ],
)
def test_a_region_that_cannot_be_is_an_error_that_names_it(row: dict[str, object], told: str) -> None:
    with pytest.raises(AssetError, match=f"(?s)table, region 2.*{re.escape(told)}"):
        parse_region(row, LABELS, "table, region 2")


@pytest.mark.parametrize("name", families())
def test_a_family_has_three_tasks_in_its_own_words(name: str) -> None:
    one = family(name)
    assert [task.difficulty for task in tasks_of(name)] == ["easy", "medium", "hard"]
    for task in tasks_of(name):
        assert set(task.program.labels) == set(one.vocabulary)
    assert len(one.names) == len(set(one.names)) >= 8
    regions = tomllib.loads((one.folder / "regions.toml").read_text("utf-8"))
    assert regions.keys() == set(one.names)
    known = json.loads((one.folder / RECORD).read_text("utf-8"))
    assert {key.rsplit("_", 1)[0] for key in known} == {source.name for source in one.sources if source.decompose}


@pytest.mark.parametrize("name", families())
def test_files_are_those_that_were_labelled_and_all_of_the_surface_is(name: str) -> None:
    corpus()
    assert find_faults(family(name)) == []


def test_the_reference_passes_on_a_small_asset_as_it_comes() -> None:
    corpus()
    sample = make_sample(family("tables"), "jokkmokk-0694", "as_is")
    assert sample is not None
    assert list(find_unlabelled(family("tables"), read_surface(family("tables").source("jokkmokk-0694")))) == []
    for level in ("easy", "medium", "hard"):
        task = real_task("tables", level)
        row = judge_sample(task, sample)
        assert is_pure(task, sample)
        assert row["reference"] is None
        assert row["unedited"] is not None
        assert row["wrong"] is not None


def test_a_decomposition_is_the_one_that_was_recorded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    corpus()
    monkeypatch.setattr("benchmark.real.samples.CACHE", tmp_path)
    sample = make_sample(family("tables"), "heavy-duty", "coarse")
    assert sample is not None
    known = json.loads((family("tables").folder / RECORD).read_text("utf-8"))
    assert digest_of(sample) == known[sample.name]
