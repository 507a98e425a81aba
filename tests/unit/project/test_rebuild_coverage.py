"""Rebuilt bodies leave no gap in the surface that hulls held."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from meshforge.project import RebuildSettings
from tests.soups import merge_solids
from tests.surface_cover import sample_lost
from tests.unit.project.stools import boxes, coarse, create_stools

SIZES = {"a": (0.2, 0.4), "b": (0.22, 0.45), "c": (0.18, 0.5)}


def test_a_missing_hull_is_a_gap() -> None:
    parts = boxes(*SIZES["c"])
    lost = sample_lost(*merge_solids(parts), parts, parts[1:])
    assert len(lost) > 100
    assert np.all(lost[:, 2] > SIZES["c"][1] - 0.01), "of the seat"


@pytest.mark.slow
def test_stools_have_no_gap_where_hulls_that_span_parts_were(tmp_path: Path) -> None:
    project = create_stools(tmp_path, SIZES, spanning="c")
    parts = boxes(*SIZES["c"])
    assert list(project.rebuild_spanning(["c.urdf"], RebuildSettings(0.5)))
    after = [hull.shape for hull in project.mesh("c.urdf").hulls]
    before = coarse(parts)
    assert len(after) > len(before)
    assert not len(sample_lost(*merge_solids(parts), before, after))
