from __future__ import annotations

from meshforge.geometry import Aabb, Box
from meshforge.symbolic import Hull, SymbolicMesh, mask_of, split_by_contact


def row(*hulls: tuple[float, str]) -> SymbolicMesh:
    boxes = [(Box.of_bounds(Aabb([x, 0, 0], [x + 1, 1, 1])), body) for x, body in hulls]
    return SymbolicMesh(tuple(Hull(f"h{k}", body, box) for k, (box, body) in enumerate(boxes)))


def test_hulls_in_a_chain_are_one_component() -> None:
    mesh = row((0, "b"), (1, "b"), (2, "b"), (5, "b"))
    assert split_by_contact(mesh, 0b1111) == [0b0111, 0b1000]


def test_a_chain_through_a_hull_outside_the_selection_connects_nothing() -> None:
    assert split_by_contact(row((0, "b"), (1, "b"), (2, "b")), 0b101) == [0b001, 0b100]


def test_bodies_are_never_joined() -> None:
    assert split_by_contact(row((0, "a"), (1, "b"), (2, "a")), 0b111) == [0b001, 0b010, 0b100]


def test_components_come_in_the_order_of_their_lowest_index() -> None:
    mesh = row((9, "b"), (0, "b"), (5, "b"), (1, "b"), (10, "b"))
    assert split_by_contact(mesh, mask_of(range(5))) == [0b10001, 0b01010, 0b00100]


def test_nothing_has_no_components() -> None:
    assert split_by_contact(row((0, "a")), 0) == []
