"""Selections as bit sets: side by side, grouped, and indexed."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from meshforge.synthesis.search.atoms import atoms, packed, singles, split_by
from meshforge.synthesis.search.columns import Columns, positions
from meshforge.synthesis.search.space import Space
from tests.synthesis_boxes import boxes

masks = st.integers(0, 2**12 - 1)
EVERY = 2**12 - 1


@given(st.lists(masks, max_size=30), masks, masks)
def test_the_index_finds_the_rows_that_hold_one_set_and_avoid_another(rows: list[int], need: int, avoid: int) -> None:
    columns = Columns(rows, 12)
    found = columns.avoiding(avoid, columns.holding(need, columns.every))
    assert list(positions(found)) == [k for k, row in enumerate(rows) if row & need == need and not row & avoid]


@given(st.lists(masks, max_size=6))
def test_atoms_part_the_hulls_and_no_mask_splits_one(shown: list[int]) -> None:
    groups = atoms(shown, EVERY)
    assert sum(groups) == EVERY
    assert sum(group.bit_count() for group in groups) == 12
    assert all(split_by(mask, groups) == () for mask in shown)


@given(st.lists(masks, max_size=6))
def test_two_hulls_in_different_atoms_are_told_apart_by_a_mask(shown: list[int]) -> None:
    firsts = [next(positions(group)) for group in atoms(shown, EVERY)]
    told_apart = {tuple(mask >> hull & 1 for mask in shown) for hull in firsts}
    assert len(told_apart) == len(firsts)


def test_a_mask_that_splits_a_group_names_it() -> None:
    assert split_by(0b0110, (0b0011, 0b0100, 0b1000)) == (0b0011,)


def test_a_mask_is_packed_by_groups() -> None:
    assert packed(0b1011, (0b0011, 0b0100, 0b1000)) == 0b101
    assert packed(0b1010, singles(0b1110)) == 0b101
    assert atoms([], 0) == ()


def test_meshes_side_by_side_are_split_as_they_were_joined() -> None:
    one = boxes(("a", None, (0, 0, 0), (1, 1, 1)), ("b", None, (2, 0, 0), (1, 1, 1)))
    other = boxes(("c", None, (0, 0, 0), (1, 1, 1)))
    space = Space([one, other])
    assert space.everything == 0b111
    assert space.join([0b10, 0b1]) == 0b110
    assert space.split(0b110) == (0b10, 0b1)
    assert Space([]).everything == 0
