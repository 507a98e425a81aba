"""Every real MJCF, unedited and with one edit each: MuJoCo finds all but the edited geoms as it was, bit for bit."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats.base import Mass
from meshforge.geometry import Box, convex_hull
from meshforge.symbolic import Asset, Geom
from tests.corpus_path import corpus
from tests.mjcf_engines import read
from tests.mjcf_models import Pair, compiled, hull, replaced, write


def _is_model(path: Path) -> bool:
    text = path.read_bytes()
    return b"<mujoco" in text and b"<mujocoinclude" not in text


@pytest.fixture(scope="module")
def assets() -> dict[str, Asset]:
    """All models that can be read, fragments left out."""
    root = corpus()
    found = [path for path in sorted(root.rglob("*.xml")) if _is_model(path)]
    return {path.relative_to(root).as_posix(): read(path) for path in found}


def whole(assets: dict[str, Asset]) -> dict[str, Asset]:
    """Those that MuJoCo compiles."""
    found = {key: asset for key, asset in assets.items() if not any("refuses" in note for note in asset.notes)}
    assert len(found) >= 72
    return found


def home(key: str, folder: Path) -> Path:
    """Where an output lies, so that references find what they name: under the folders it was under."""
    return (folder / key).parent


@pytest.mark.slow
def test_unedited_models_come_back_byte_for_byte_and_compile_alike(assets: dict[str, Asset], tmp_path: Path) -> None:
    for key, asset in whole(assets).items():
        path, output = write(asset, home(key, tmp_path))
        assert path.read_bytes() == asset.path.read_bytes()
        assert not output.notes and not output.names
        Pair(compiled(asset.path), compiled(path)).assert_same()
    assert not list(tmp_path.rglob("*--*"))


def deleted(asset: Asset, k: int) -> tuple[Asset, list[Geom]]:
    return replaced(asset, [asset.geoms[k].name]), []


def boxed(asset: Asset, k: int) -> tuple[Asset, list[Geom]]:
    geom = asset.geoms[k]
    made = hull(asset, geom.name, Box.of_bounds(geom.shape.aabb))
    return replaced(asset, [geom.name], made), [made]


def merged(asset: Asset, k: int) -> tuple[Asset, list[Geom]]:
    body = asset.geoms[k].body
    pair = [geom for geom in asset.geoms if geom.body == body][:2]
    largest = max(pair, key=lambda geom: geom.shape.volume)
    shape = convex_hull(np.concatenate([geom.shape.vertices for geom in pair]))
    made = hull(asset, largest.name, shape)
    return replaced(asset, [geom.name for geom in pair], made), [made]


EDITS = (deleted, boxed, merged)


@pytest.mark.slow
@pytest.mark.parametrize("mass", ["keep", "recompute"])
def test_an_edit_of_one_geom_changes_what_it_says(assets: dict[str, Asset], mass: Mass, tmp_path: Path) -> None:
    tried = [0, 0, 0]
    for number, (key, asset) in enumerate(whole(assets).items()):
        if not asset.geoms:
            continue
        kind = (number + (mass == "keep")) % 3
        edited, made = EDITS[kind](asset, number % len(asset.geoms))
        gone = {geom.name for geom in asset.geoms} - {geom.name for geom in edited.geoms}
        path, output = write(edited, home(key, tmp_path), mass)
        assert not output.notes and not output.names, key
        pair = Pair(compiled(asset.path), compiled(path))
        pair.assert_same(removed=gone, made=made, masses=mass == "keep")
        assert [geom.name for geom in read(path).geoms].count(made[0].name if made else "") == len(made)
        tried[kind] += 1
    assert min(tried) > 18


def test_models_that_mujoco_refuses_are_edited_all_the_same(assets: dict[str, Asset], tmp_path: Path) -> None:
    refused = {key: asset for key, asset in assets.items() if any("refuses" in note for note in asset.notes)}
    edited = {key: boxed(asset, 0) for key, asset in refused.items() if asset.geoms}
    assert len(edited) >= 5
    unweighed = "weird/15_unknown_element_region.xml"  # its visuals weigh, and are not there
    with pytest.raises(AssetError, match=r"mass of body 'base' cannot be kept[^$]*--mass recompute"):
        write(edited[unweighed][0], home(unweighed, tmp_path))
    for key, (asset, made) in edited.items():
        path, _ = write(asset, home(key, tmp_path), "recompute" if key == unweighed else "keep")
        again = read(path)
        assert made[0].name in [geom.name for geom in again.geoms]
        assert {geom.name for geom in again.geoms} == {geom.name for geom in asset.geoms}
        with pytest.raises(ValueError, match=r"(?i)error"):
            mujoco.MjModel.from_xml_path(str(path))
