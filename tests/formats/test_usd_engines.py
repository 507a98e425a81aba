"""What USD's own physics reader, the one that engines call, finds in stages made of real assets, and in edited ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from meshforge.formats import read, save
from meshforge.geometry import Box
from meshforge.symbolic import Asset, Geom
from tests.corpus_path import corpus
from tests.loads.comparing import differences, shapes_of
from tests.loads.readers import READERS
from tests.usd_stages import complaints

REAL = (
    "cups_mugs/pybullet-URDF-models/orange_cup/model.urdf",
    "cups_mugs/object_sim/mug/object.xml",
    "doors_cabinets/furniture_sim/hingecabinet.xml",
)


def agrees(path: Path) -> Asset:
    """The asset in a stage, which USD's reader and its validators agree with."""
    asset, seen = read(path), list(READERS["usd"].shapes(path))
    assert complaints(path) == []
    assert differences(shapes_of(asset), seen, READERS["usd"], path.suffix) == []
    return asset


@pytest.mark.parametrize("suffix", [".usda", ".usdc", ".usdz"])
@pytest.mark.parametrize("name", REAL)
def test_usd_tells_engines_the_hulls_of_a_converted_asset(tmp_path: Path, name: str, suffix: str) -> None:
    before = read(corpus() / name)
    assert len(agrees(save(before, tmp_path / f"a{suffix}").path).geoms) == len(before.geoms)


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".usda", ".usdc", ".usdz"])
@pytest.mark.parametrize("name", REAL)
def test_usd_tells_engines_the_hulls_of_an_edited_stage(tmp_path: Path, name: str, suffix: str) -> None:
    asset = agrees(save(read(corpus() / name), tmp_path / f"a{suffix}").path)
    first, second, *rest = asset.geoms
    made = Geom(f"{second.name}~1", second.body, Box.of_bounds(second.shape.aabb), parent=second.name)
    edited = agrees(save(asset.with_geoms([*rest, made]), tmp_path / "out" / f"a{suffix}").path)
    assert len(edited.geoms) == len(asset.geoms) - 1
    assert first.name not in {geom.name for geom in edited.geoms}
    known = {i.body: i.mass for i in asset.mechanism.inertials}
    after = {i.body: i.mass for i in edited.mechanism.inertials}
    assert all(np.isclose(after[body], mass) for body, mass in known.items())
