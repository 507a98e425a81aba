"""Hulls and labels by name."""

from __future__ import annotations

from pathlib import Path

import pytest

import meshforge as mf
from tests.unit.batch.families import write_urdf_table
from tests.unit.rendering.scenes import table


def test_a_hull_is_got_by_its_name() -> None:
    mesh = table()
    assert mesh["leg1"] is mesh.hulls[3]
    assert "leg1" in mesh and "leg2" not in mesh
    assert [hull.name for hull in mesh] == [hull.name for hull in mesh.hulls]


def test_a_name_that_no_hull_has_is_a_key_error_with_the_nearest_one(tmp_path: Path) -> None:
    with pytest.raises(KeyError) as caught:
        mf.load(write_urdf_table(tmp_path))["body/tpo"]
    assert isinstance(caught.value, mf.MeshForgeError)
    assert str(caught.value) == f"{tmp_path}/table.urdf: there is no hull 'body/tpo'\n  Did you mean 'body/top'?"
    with pytest.raises(mf.MeshForgeError, match=r"It has 5 hulls; see `\.index`"):
        table()["zzzz"]


def test_labels_are_given_by_name_when_a_mesh_is_loaded(tmp_path: Path) -> None:
    path = write_urdf_table(tmp_path)
    mesh = mf.load(path, labels={"body/top": "seat", "body/left": mf.Label("side", 0.5, "vlm")})
    assert [h.label for h in mesh.hulls] == ["seat", "side", None, None]  # those of the file beside it do not count
    assert (mesh["body/top"].confidence, mesh["body/top"].source) == (1.0, "user")
    assert mesh["body/left"].confidence == 0.5
    assert all(hull.label is None for hull in mf.load(path, labels={}).hulls)
    with pytest.raises(mf.MeshForgeError, match="Did you mean 'body/top'"):
        mf.load(path, labels={"body/topp": "seat"})
