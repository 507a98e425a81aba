"""Alarms on the bundled families, through a project: none with their labels, few without, and merged legs are found."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmark.spanning.alarms import KNOWN, open_bundled, open_merged


@pytest.mark.parametrize(("family", "hulls"), [("tables", 587), pytest.param("chairs", 148, marks=pytest.mark.long)])
@pytest.mark.parametrize(("labelled", "most"), [(None, 0), (KNOWN, 3)])
def test_hulls_of_one_part_are_not_named(
    tmp_path: Path, family: str, hulls: int, labelled: int | None, most: int
) -> None:
    case = open_bundled(tmp_path, family, labelled)
    meshes = [case.project.mesh(asset) for asset in case.project.assets()]
    assert sum(len(mesh.hulls) for mesh in meshes) == hulls
    assert case.find()[1] <= most


@pytest.mark.long
def test_of_seven_chairs_with_a_leg_merged_into_the_seat_six_are_found(tmp_path: Path) -> None:
    case = open_merged(tmp_path)
    assert len(case.project.assets()) == 10 and len(case.spanning) == 7
    found, others = case.find()
    assert found >= 6 and others <= 3
