"""Which asset is best labelled next: the one that tells most for each second that labelling it takes."""

from collections.abc import Sequence

import numpy as np
import pytest

from meshforge.geometry import Ints
from meshforge.label_model import FamilyPosterior, FamilyTable, Observations, posterior
from meshforge.label_model.describe import ROW_WIDTH, SHAPE_COLUMNS
from meshforge.label_model.similar import CLICK, KEY, LOOK, ROUND, THINK, estimate_seconds
from meshforge.label_model.table import ColumnScale
from meshforge.symbolic import Label

LARGE, SMALL = [0, 1, 2, 3, 4, 5], [0, 0, 0, 0]
FAMILY = [LARGE, SMALL, SMALL, SMALL, SMALL]


def advise(kinds: Sequence[Sequence[int]], labelled: Sequence[int] = (), **options: int) -> list[int]:
    """What is advised for meshes whose hulls are of some kinds, unlike each other; labelled: hulls by their places."""
    table = make_table(kinds)
    said = [Label(f"part_{k}") if k in labelled else None for k in range(len(table.owner))]
    return FamilyPosterior.of(table, Observations.of(said)).next_to_label(**options)


def make_table(kinds: Sequence[Sequence[int]]) -> FamilyTable:
    every = [kind for own in kinds for kind in own]
    rows = np.zeros((len(every), ROW_WIDTH))
    rows[np.arange(len(every)), SHAPE_COLUMNS.start + np.array(every)] = 10.0
    owner = np.repeat(np.arange(len(kinds)), [len(own) for own in kinds])
    scale = ColumnScale(np.zeros(ROW_WIDTH), np.ones(ROW_WIDTH))
    return FamilyTable(rows, scale, owner, np.zeros((0, 2), np.int64), np.ones(ROW_WIDTH))


def test_a_small_asset_that_tells_most_a_second_comes_before_the_largest_that_tells_most() -> None:
    assert advise(FAMILY, count=2) == [1, 0]


def test_where_all_tell_alike_a_second_the_first_comes() -> None:
    assert advise([SMALL] * 4, count=4) == [0, 1, 2, 3]


def test_hulls_whose_label_is_given_cost_nothing() -> None:
    parts = [[0, 1, 2, 3, 4, 5], [0, 1, 2, 3, 4, 6], *[[0, 6]] * 6]
    assert advise(parts, count=1) == [2]
    assert advise(parts, labelled=range(6, 11), count=1) == [1]


def test_an_asset_of_another_family_is_not_advised() -> None:
    assert advise(FAMILY, count=9, below=1) == [0]


def test_look_alikes_are_labelled_at_once() -> None:
    table, opening = make_table(FAMILY), ROUND + THINK + CLICK
    assert estimate_seconds(table, np.arange(6, 10)) == pytest.approx(opening + CLICK + 2 * KEY + 4 * LOOK)
    assert estimate_seconds(table, np.arange(6)) == pytest.approx(opening + 6 * (CLICK + 2 * KEY + LOOK))


def test_of_very_many_assets_some_are_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    priced = list[int]()

    def price(_: FamilyTable, hulls: Ints) -> float:
        priced.append(len(hulls))
        return 1.0

    monkeypatch.setattr(posterior, "_MESHES", 7)
    monkeypatch.setattr(posterior, "estimate_seconds", price)
    assert len(advise([SMALL] * 40, count=9)) == len(priced) == 7
