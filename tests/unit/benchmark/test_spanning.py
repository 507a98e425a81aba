"""Figures about hulls that span parts: counts by hand, and the surface of an asset."""

from __future__ import annotations

import numpy as np
import pytest

from benchmark.assets import samples
from benchmark.spanning.course import HullChance
from benchmark.spanning.detection import Detection
from benchmark.spanning.sets import surface_of
from meshforge.geometry import volume_inside


def test_precision_and_recall_count_hulls() -> None:
    rows = [(0.8, True), (0.2, True), (0.2, True), (0.9, False)]
    found = Detection.of([HullChance("cup_01", number, *row) for number, row in enumerate(rows)])
    assert found.precision == pytest.approx(1 / 2)
    assert found.recall == pytest.approx(1 / 3)


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
