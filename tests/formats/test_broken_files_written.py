"""Odd inputs that are read can be written back: as they were, and with a hull less or as hulls of their own."""

from __future__ import annotations

from pathlib import Path

import pytest

from meshforge.common import MeshForgeError
from meshforge.formats import read, save
from meshforge.symbolic import Asset
from tests.corpus_case import Case, cases

KINDS = ("obj", "stl", "ply", "urdf", "dae", "mjcf", "gltf", "glb", "folder")


def readable() -> list[Case]:
    """The inputs of assets that are not refused."""
    kept = [case for case in cases() if case.kind in KINDS and case.expected]
    return [case for case in kept if case.expected and case.expected[0] == ".out"]


READABLE = readable()


def names(asset: Asset) -> list[str]:
    return [geom.name for geom in asset.geoms] + [piece.name for piece in asset.non_convex]


@pytest.mark.parametrize("case", READABLE, ids=[case.name for case in READABLE])
def test_an_odd_input_is_written_back_as_it_was(case: Case, tmp_path: Path) -> None:
    asset = read(case.path)
    try:
        out = save(asset, tmp_path / "a" / "b" / case.path.name).path
    except MeshForgeError as error:
        assert "outside of the output folder" in error.problem
        return
    if case.path.is_file():
        assert out.read_bytes() == case.path.read_bytes()
    assert names(read(out)) == names(asset)


@pytest.mark.parametrize("case", READABLE, ids=[case.name for case in READABLE])
def test_an_odd_input_loses_a_hull_and_no_other(case: Case, tmp_path: Path) -> None:
    asset = read(case.path)
    if not asset.geoms:
        return
    gone, *kept = asset.geoms
    try:
        saved = save(asset.with_geoms(kept), tmp_path / "a" / "b" / case.path.name)
    except MeshForgeError as error:
        assert error.where
        return
    wanted = [saved.names.get(name, name) for name in names(asset) if name != gone.name]
    assert sorted(names(read(saved.path))) == sorted(wanted)
