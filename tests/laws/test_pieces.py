"""Laws of pieces: any heap of boxes on a grid is read as the boxes it was made of."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from meshforge.geometry import split_pieces
from tests.examples import examples
from tests.soups import box, together, unindexed

CELLS = st.tuples(st.integers(0, 2), st.integers(0, 2), st.integers(0, 2))


@examples(60)
@given(cells=st.lists(CELLS, min_size=1, max_size=6, unique=True))
def test_a_heap_of_boxes_without_shared_vertices_is_read_as_its_boxes(cells: list[tuple[int, int, int]]) -> None:
    vertices, faces = unindexed(together(*(box(cell) for cell in cells)))
    found = split_pieces(vertices, faces, name="heap")
    lows = [p.shape.aabb.min.tolist() for p in found if p.shape]
    assert lows == [list(map(float, cell)) for cell in cells]


@examples(40)
@given(cells=st.lists(CELLS, min_size=1, max_size=5, unique=True), seed=st.integers(0, 1000))
def test_the_order_of_faces_only_orders_the_pieces_of_boxes_apart(cells: list[tuple[int, int, int]], seed: int) -> None:
    vertices, faces = unindexed(together(*(box([2.0 * x for x in cell]) for cell in cells)))
    mixed = np.random.default_rng(seed).permutation(faces)
    found = split_pieces(vertices, mixed, name="heap")
    assert all(p.shape for p in found)
    assert sorted(p.shape.aabb.min.tolist() for p in found if p.shape) == sorted([2.0 * x for x in c] for c in cells)
    assert [int(p.face_indices[0]) for p in found] == sorted(int(p.face_indices[0]) for p in found)
