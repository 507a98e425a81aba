"""What USD's own physics reader, the one that engines call, finds in stages made of real assets, and in edited ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from meshforge.formats import read, save
from meshforge.formats.usd.stage import UsdDocument
from meshforge.geometry import Box, Capsule, Cylinder, Shape, Sphere
from meshforge.symbolic import Asset, Geom
from tests.corpus_path import corpus
from tests.usd_stages import complaints, physics_shapes

REAL = (
    "cups_mugs/pybullet-URDF-models/orange_cup/model.urdf",
    "cups_mugs/object_sim/mug/object.xml",
    "doors_cabinets/furniture_sim/hingecabinet.xml",
)


def sizes(told: object) -> list[float]:
    """The sizes of a native shape as the reader tells them."""
    names = ("halfExtents", "radius", "halfHeight")
    return [float(x) for name in names if hasattr(told, name) for x in np.atleast_1d(np.array(getattr(told, name)))]


def wanted(shape: Shape) -> list[float]:
    match shape:
        case Box():
            return [float(x) for x in shape.half]
        case Sphere():
            return [shape.radius]
        case Cylinder() | Capsule():
            return [shape.radius, shape.half_length]
    return []


def agrees(path: Path) -> Asset:
    """The asset in a stage, which USD's reader and its validators agree with."""
    asset, told = read(path), physics_shapes(path)
    assert complaints(path) == []
    assert len(told) == len(asset.geoms) + len(asset.non_convex)
    assert isinstance(asset.document, UsdDocument)
    paths = {name: element.path for element in asset.document.authored for name in element.names}
    poses = asset.body_poses
    for geom in asset.geoms:
        found = told[paths[geom.name]]
        body = poses[geom.body]
        middle = body.inverse().apply(_origin(geom.shape)[None])[0] if wanted(geom.shape) else None
        assert np.allclose(sizes(found), wanted(geom.shape), rtol=1e-5)
        assert middle is None or np.allclose(np.array(found.localPos), middle, atol=1e-5)
    return asset


def _origin(shape: Shape) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return shape.centroid


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
