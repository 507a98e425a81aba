"""Laws of hulls that stand for no surface: their cells fill them, and their parts lie within them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from meshforge.geometry import Box, Polytope, Pose, convex_hull, volume_of_union
from meshforge.label_model import AssetCells, CellModel, cut_into_cells
from meshforge.symbolic import Hull, Label, SymbolicMesh

sizes = st.floats(0.05, 0.5).map(lambda x: round(x, 3))
boxes = st.builds(lambda a, b, c, x, y, z: box((x, y, z), (a, b, c)), *[sizes] * 3, *[st.floats(-1, 1)] * 3)


def box(middle: tuple[float, float, float], half: tuple[float, float, float]) -> Polytope:
    return Box(Pose(np.eye(3), np.array(middle, dtype=float)), np.array(half, dtype=float)).tessellate()


@settings(max_examples=15, deadline=None)
@given(st.lists(boxes, min_size=2, max_size=3), st.integers(1, 8))
def test_cells_fill_a_hull_and_nothing_beside(solids: list[Polytope], count: int) -> None:
    hull = convex_hull(np.concatenate([solid.vertices for solid in solids]))
    cells = cut_into_cells(hull, solids, count)
    assert len(cells) == count
    assert sum(cell.volume for cell in cells) == pytest.approx(hull.volume, rel=1e-6), "they do not overlap"
    assert volume_of_union([hull, *cells]) == pytest.approx(hull.volume, rel=1e-6), "they lie within it"


def test_a_flat_hull_is_one_cell() -> None:
    flat = box((0, 0, 0), (1, 1, 1e-9))
    assert 1 <= len(cut_into_cells(flat, [], 8)) <= 8


@pytest.fixture(scope="module")
def pairs() -> list[SymbolicMesh]:
    """A rod on a plate, as two hulls, thrice; then as one."""
    found = list[SymbolicMesh]()
    for k in range(4):
        plate = box((0, 0, 0), (0.5 + 0.02 * k, 0.5, 0.05))
        rod = box((0.3, 0, 0.55), (0.05, 0.05 + 0.01 * k, 0.5))
        shapes = [plate, rod] if k < 3 else [convex_hull(np.concatenate([plate.vertices, rod.vertices]))]
        found.append(SymbolicMesh(tuple(Hull(f"h{j}", "base", shape) for j, shape in enumerate(shapes))))
    return found


@pytest.fixture(scope="module")
def model(pairs: list[SymbolicMesh]) -> CellModel:
    return CellModel([AssetCells(mesh) for mesh in (*pairs, SymbolicMesh(()))])


def test_parts_of_a_hull_lie_within_it_and_have_the_labels_of_look_alikes(
    pairs: list[SymbolicMesh], model: CellModel
) -> None:
    found = model.infer([*(Label(name) for _ in range(3) for name in ("plate", "rod")), None])
    assert found.chances_of(3)[0] > found.chances_of(0).max()
    parts = found.divide(3, 0)
    hull = pairs[3].hulls[0]
    assert volume_of_union([hull.shape, *(part.shape for part in parts)]) == pytest.approx(hull.volume, rel=1e-6)
    assert {found.labels[part.kind] for part in parts} == {"plate", "rod"}
    for part in parts:
        assert part.shares.sum() == pytest.approx(1.0)


@pytest.mark.slow
def test_the_same_labels_say_the_same_bit_for_bit(pairs: list[SymbolicMesh]) -> None:
    labels = [*(Label(name) for _ in range(3) for name in ("plate", "rod")), None]
    one, other = (CellModel([AssetCells(mesh) for mesh in pairs]).infer(labels) for _ in range(2))
    assert all((a == b).all() for a, b in zip(one.chances, other.chances, strict=True))


def test_where_nothing_is_labelled_no_hull_spans(model: CellModel) -> None:
    found = model.infer([None] * 7)
    assert found.labels == () and not found.shares_of(3).size
    assert (found.chances_of(3) < 0.5).all()


def test_an_asset_without_hulls_has_no_chances(model: CellModel) -> None:
    found = model.infer([Label("plate"), *[None] * 6])
    assert found.chances_of(4).shape == (0,) and found.shares_of(4).shape == (0, 1)
