"""Figures about hulls that span parts: counts, purities and parts by hand, and a hull of a real asset cut in two."""

from __future__ import annotations

import numpy as np
import pytest

from benchmark.assets import samples
from benchmark.assets.decomposition import volumes_in_parts
from benchmark.spanning.course import SplitHull, SplitPart, parts_of
from benchmark.spanning.detection import Detection
from benchmark.spanning.family import choose_known, is_spanning, split_hulls
from benchmark.spanning.pictures import choose_assets
from benchmark.spanning.sets import surface_of
from benchmark.spanning.splits import Purity
from meshforge.geometry import Polytope, cut, volume_inside

CUBE = [[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]


def hull(
    chance: float, volumes: dict[str, float], *parts: tuple[str, dict[str, float]], spans: bool = True
) -> SplitHull:
    made = tuple(SplitPart(CUBE, label, inside) for label, inside in parts)
    return SplitHull("cup_01", 0, chance, spans, volumes, made, 0.0)


SPLIT = hull(0.8, {"wall": 3.0, "handle": 1.0}, ("wall", {"wall": 3.0}), ("wall", {"handle": 0.9, "wall": 0.1}))
MISSED = hull(0.2, {"wall": 3.0, "handle": 1.0})


def test_purity_counts_a_missed_hull_as_it_is() -> None:
    found = Purity.of([SPLIT, MISSED])
    assert found.before == pytest.approx(6 / 8)
    assert found.after == pytest.approx((3.9 + 3) / 8)
    assert found.mean == pytest.approx((3.9 / 4 + 3 / 4) / 2)


def test_labels_are_right_by_the_volume_of_split_hulls_alone() -> None:
    assert Purity.of([SPLIT, MISSED]).right == pytest.approx(3.1 / 4)


def test_a_hull_less_likely_than_is_asked_for_is_not_split() -> None:
    assert SPLIT.is_split(0.5) and not SPLIT.is_split(0.9)
    assert Purity.of([SPLIT], 0.9).after == pytest.approx(3 / 4)
    assert not parts_of([SPLIT], 0.9)


def test_precision_and_recall_count_hulls() -> None:
    found = Detection.of([SPLIT, MISSED, MISSED, hull(0.9, {"wall": 1.0}, spans=False)])
    assert found.precision == pytest.approx(1 / 2)
    assert found.recall == pytest.approx(1 / 3)


@pytest.mark.parametrize("count", [8, 9, 25])
def test_one_asset_of_each_third_is_labelled(count: int) -> None:
    known = sorted(choose_known(count))
    assert [sum(place in third for place in known) for third in np.array_split(np.arange(count), 3)] == [1, 1, 1]


def test_pictures_show_the_best_and_then_the_worst() -> None:
    rows = [
        {"asset": f"cup_{k:02}", "set": "union", "labels": "pieces", "before": 0.5, "after": 0.5 + k / 20}
        for k in range(9)
    ]
    assert [row["asset"][-2:] for row in choose_assets(rows)] == ["08", "07", "06", "02", "01", "00"]


@pytest.mark.parametrize(("setting", "most"), [("union", 1.01), ("welded", 1.5)])
def test_the_surface_holds_the_parts_in_the_box_of_the_hulls(setting: str, most: float) -> None:
    sample = samples("cup", True, (setting,))[0]
    points, faces = surface_of(sample)
    corners = np.concatenate([one.vertices for one in sample.mesh.hulls])
    assert np.allclose(points.min(axis=0), corners.min(axis=0), atol=2e-3)
    assert np.allclose(points.max(axis=0), corners.max(axis=0), atol=2e-3)
    volume = sum(part.solid.volume() for part in sample.asset.parts)
    inside = volume_inside(points, faces)
    assert inside and 0.9 * volume < inside < most * volume


def test_parts_of_a_hull_stand_in_its_place_with_their_true_labels() -> None:
    sample = next(one for one in samples("cup", True, ("union",)) if any(map(is_spanning, one.shares)))
    place = next(place for place, share in enumerate(sample.shares) if is_spanning(share))
    whole = sample.decomposition.hulls[place]
    halves = [half for half in cut(whole, whole.centroid, np.array([1.0, 0.0, 0.0])) if half is not None]
    split = split_hulls(sample, {place: halves})
    name = sample.mesh.hulls[place].name
    assert [one.name for one in split.mesh.hulls][place : place + 2] == [f"{name}_0", f"{name}_1"]
    assert len(split.mesh.hulls) == len(sample.mesh.hulls) + 1 == len(split.shares)
    for one, share in zip(split.mesh.hulls[place : place + 2], split.shares[place : place + 2], strict=True):
        assert isinstance(one.shape, Polytope)
        volumes = volumes_in_parts(one.shape, sample.asset.parts, sample.asset.pose)
        assert one.label == max(volumes, key=lambda label: volumes[label]) == max(share, key=lambda label: share[label])
