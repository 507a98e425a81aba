"""Selections as bit sets: side by side, grouped, and indexed."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.language import EXTREMITY, Extractor, select_mask
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.search import bank
from meshforge.synthesis.search.bank import Columns, positions
from meshforge.synthesis.search.observation_table import ObservationTable
from meshforge.synthesis.search.smallest import ErrorCounter
from tests.examples import examples
from tests.strategies import extractors, grid_boxes, meshes
from tests.synthesis_boxes import boxes, table

LABELS = ("a", "b", "c")
masks = st.integers(0, 2**12 - 1)
batches = st.lists(meshes(grid_boxes(), vocabulary=LABELS), min_size=1, max_size=4)


@given(st.lists(masks, max_size=30), masks, masks)
def test_the_index_finds_the_rows_that_hold_one_set_and_avoid_another(rows: list[int], need: int, avoid: int) -> None:
    columns = Columns(rows, 12)
    found = columns.rows_without(avoid, columns.rows_with(need, columns.every))
    assert list(positions(found)) == [k for k, row in enumerate(rows) if row & need == need and not row & avoid]
    for _ in range(2):  # as worked out, and as remembered
        assert columns.all_with(need) & columns.all_without(avoid) == found


def test_an_index_that_has_forgotten_answers_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bank, "_REMEMBERED", 2)
    columns = Columns([0b011, 0b110], 3)
    for need in (0b001, 0b010, 0b100, 0b001, 0b111):
        assert columns.all_with(need) == columns.rows_with(need, columns.every)
        assert columns.all_without(need) == columns.rows_without(need, columns.every)


@examples(200)
@given(batches, extractors(LABELS), st.booleans(), st.sampled_from([EXTREMITY, 0.3]))
def test_what_an_extractor_selects_is_a_set_of_groups(
    batch: list[SymbolicMesh], extractor: Extractor, group: bool, extremity: float
) -> None:
    field = ObservationTable(batch, LABELS, extremity=extremity, group=group)
    chosen = field.bits(extractor)
    assert [field.on(chosen, k) for k in range(len(batch))] == [select_mask(extractor, m, extremity) for m in batch]


@examples(50)
@given(batches)
def test_leaves_tell_the_first_hulls_of_two_groups_apart(batch: list[SymbolicMesh]) -> None:
    field = ObservationTable(batch, LABELS)
    seen = {tuple(term.bits >> group & 1 for term in field.terms) for group in range(field.width)}
    assert len(seen) == field.width


@examples(50)
@given(batches, st.integers(0, 2**32 - 1), masks)
def test_errors_are_counted_by_hulls(batch: list[SymbolicMesh], shown: int, chosen: int) -> None:
    field = ObservationTable(batch, LABELS)
    selections = [shown >> 8 * k & ((1 << len(mesh.hulls)) - 1) for k, mesh in enumerate(batch)]
    wrong = sum((field.on(chosen, k) ^ selection).bit_count() for k, selection in enumerate(selections))
    assert ErrorCounter(selections, field.groups, field.width).count(chosen & ((1 << field.width) - 1)) == wrong


def test_groups_of_the_first_meshes_come_first() -> None:
    field = ObservationTable([table(), table(drawers=2)], LABELS)
    assert field.width_of(0) == 0
    assert set(field.groups[0]) == set(range(field.width_of(1)))


def test_two_like_hulls_of_which_one_is_selected_are_named() -> None:
    mesh = boxes(*((f"leg{k}", "a", (2.0 * k, 0, 0), (1, 1, 1)) for k in range(4)))
    assert ObservationTable([mesh], LABELS).find_conflict([0b0010]) == ((0, 1), (0, 2))
    assert ObservationTable([mesh], LABELS).find_conflict([0b0110]) is None


def test_a_field_without_meshes_has_no_groups() -> None:
    assert ObservationTable([], LABELS).width == 0
