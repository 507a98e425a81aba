"""Labels carried from a few meshes to the rest: right mostly, sure when right, the same every time."""

from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest

from benchmark.assets import Sample, samples
from benchmark.labels.metric import PURE
from meshforge.geometry import Pose
from meshforge.label_model import FamilyModel, FamilyPosterior, reference_label
from meshforge.symbolic import Label, SymbolicMesh
from tests.synthesis_boxes import boxes


def propagate(meshes: Sequence[SymbolicMesh]) -> FamilyPosterior:
    """What the labels that others may be taken from say about all hulls."""
    said = [hull.annotation if reference_label(hull.annotation) else None for mesh in meshes for hull in mesh.hulls]
    return FamilyModel(meshes).infer(said)


def asking(rows: Sequence[Sample], told: Sequence[int]) -> list[SymbolicMesh]:
    """The meshes, of which only some are labelled, by a person."""
    return [
        row.mesh.with_labels({hull.name: Label(hull.label or "") if k in told else None for hull in row.mesh.hulls})
        for k, row in enumerate(rows)
    ]


@cache
def advised(category: str, count: int) -> tuple[FamilyPosterior, tuple[int, ...]]:
    """What is found with so many meshes labelled, each the one that was advised."""
    rows = samples(category, calibration=True)
    told: list[int] = []
    for _ in range(count):
        told += propagate(asking(rows, told)).next_to_label()
    return propagate(asking(rows, told)), tuple(told)


def outcome(category: str, count: int) -> tuple[list[bool], list[float]]:
    """Of each hull of one part of the meshes that are not labelled: whether it is right, and how sure that was."""
    rows, (found, told) = samples(category, calibration=True), advised(category, count)
    right, sure = [], []
    for k, row in enumerate(rows):
        for hull, purity, label in zip(row.mesh.hulls, row.purities, found.labels(k), strict=True):
            if k not in told and purity >= PURE:
                assert label is not None and label.source == "propagated"
                right.append(label.name == hull.label)
                sure.append(label.confidence)
    return right, sure


@pytest.mark.slow
@pytest.mark.parametrize("category", ["cup", "door", "table"])
def test_two_labelled_meshes_label_the_family(category: str) -> None:
    right, _ = outcome(category, 2)
    assert np.mean(right) > 0.9


@pytest.mark.parametrize("turn", [(np.pi / 2, 0.0, 0.3), (0.0, -np.pi / 2, 1.0), (np.pi, 0.0, 2.0)])
def test_meshes_that_lie_on_another_side_get_the_labels_they_get_upright(turn: tuple[float, float, float]) -> None:
    meshes = asking(samples("table", calibration=True)[::3], [0, 1])
    pose = Pose.from_rpy((0.0, 0.0, 0.0), turn)
    fallen = [
        SymbolicMesh(tuple(hull.move(pose) for hull in mesh.hulls)) if k % 3 == 2 else mesh
        for k, mesh in enumerate(meshes)
    ]
    upright, lying = propagate(meshes), propagate(fallen)
    same = [
        one == other
        for k in range(2, len(meshes), 3)
        for one, other in zip(names_of(upright, k), names_of(lying, k), strict=True)
    ]
    assert np.mean(same) > 0.9


def names_of(found: FamilyPosterior, mesh: int) -> list[str | None]:
    return [label.name if label else None for label in found.labels(mesh)]


@pytest.mark.slow
def test_a_sure_label_is_right_more_often_than_an_unsure_one() -> None:
    found = [outcome(name, 2) for name in ("cup", "door", "table")]
    right, sure = (np.concatenate([row[k] for row in found]) for k in (0, 1))
    assert right[sure > 0.95].mean() > 0.97 > right[sure < 0.8].mean()


@pytest.mark.slow
def test_chances_are_chances() -> None:
    found, _ = advised("cup", 1)
    assert found.chances.min() >= 0
    assert found.chances.sum(axis=1) == pytest.approx(1.0)


def test_a_label_that_nobody_told_is_not_found_and_a_single_one_is_everywhere() -> None:
    rows = samples("cup", calibration=True)[:3]
    mesh = rows[0].mesh
    only = mesh.with_labels({hull.name: None for hull in mesh.hulls[1:]}).with_labels(
        {mesh.hulls[0].name: Label("wall")}
    )
    found = propagate([only, *asking(rows[1:], [])])
    assert found.seen.labels == ("wall",)
    assert {label.name for k in range(3) for label in found.labels(k) if label} == {"wall"}


def test_what_machines_said_teaches_nothing() -> None:
    mesh = samples("cup", calibration=True)[0].mesh
    said = mesh.with_labels({hull.name: Label("wall", 0.9, "name") for hull in mesh.hulls})
    found = propagate([said])
    assert found.labels(0) == [None] * len(mesh.hulls)
    assert found.next_to_label() == [0]


def test_no_meshes_and_meshes_without_hulls_are_no_error() -> None:
    assert propagate([]).next_to_label() == []
    assert propagate([boxes()]).labels(0) == []
    rows = samples("cup", calibration=True)[:1]
    found = propagate([boxes(), *asking(rows, [0])])
    assert found.labels(0) == []
    assert found.next_to_label(5) == []
