"""Hulls that look like some hulls, in one mesh and in several."""

from functools import cache

import numpy as np
import pytest

from meshforge.geometry import Ints
from meshforge.label_model import FamilyTable, MeshDescriber, choose_exemplars, find_similar
from meshforge.label_model.similar import OTHER_STEPS, OWN_STEPS, RADIUS
from meshforge.symbolic import Hull, SymbolicMesh
from script.families.chairs import _list_chairs

PARTS = ("seat", "legs", "back", "arms", "rails")


@cache
def _chairs() -> tuple[FamilyTable, list[str]]:
    """All sample chairs as a table, and the part of each hull."""
    described, parts = [], list[str]()
    for chair in _list_chairs():
        hulls = [(part, hull) for part in PARTS for hull in getattr(chair, part)]
        mesh = SymbolicMesh(tuple(Hull(f"h{k}", "chair", hull) for k, (_, hull) in enumerate(hulls)))
        found = MeshDescriber(mesh).describe()
        described.append((found.rows, found.touching))
        parts += [part for part, _ in hulls]
    return FamilyTable.of(described), parts


def _of(mesh: int, part: str) -> Ints:
    table, parts = _chairs()
    return np.flatnonzero((table.owner == mesh) & (np.array(parts) == part))


def _nothing() -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    return np.zeros(len(_chairs()[0].owner), dtype=np.bool_)


@pytest.mark.parametrize("mesh", range(10))
def test_one_leg_finds_all_legs_of_its_chair_and_nothing_else(mesh: int) -> None:
    table, parts = _chairs()
    legs = _of(mesh, "legs")
    found, _ = find_similar(table, legs[:1], _nothing(), None, 0)
    assert {parts[place] for place in found.tolist()} == {"legs"}
    assert set(table.owner[found]) == {mesh}


@pytest.mark.parametrize("others", [None, np.arange(10)], ids=["own", "all"])
def test_every_step_takes_what_the_one_before_took_until_none_is_left(others: Ints | None) -> None:
    table, _ = _chairs()
    before, step = set[int](), 0
    while step < len(OWN_STEPS if others is None else OTHER_STEPS):
        found, taken = find_similar(table, _of(1, "back")[:1], _nothing(), others, step)
        assert taken >= step
        assert before <= set(found.tolist())
        before, step = set(found.tolist()), taken + 1


def test_legs_of_other_chairs_are_found_and_hardly_anything_else() -> None:
    table, parts = _chairs()
    found, _ = find_similar(table, _of(0, "legs")[:1], _nothing(), np.arange(10), 1)
    kinds = [parts[place] for place in found.tolist()]
    assert len(set(table.owner[found])) >= 6
    assert kinds.count("legs") >= 0.9 * len(kinds)


def test_what_is_excluded_is_never_taken_and_what_is_like_it_neither() -> None:
    table, _ = _chairs()
    excluded = _nothing()
    excluded[_of(3, "legs")] = True
    found, _ = find_similar(table, _of(0, "legs")[:1], excluded, np.arange(10), 3)
    assert not excluded[found].any()


def test_nothing_is_like_nothing() -> None:
    table, _ = _chairs()
    found, _ = find_similar(table, np.zeros(0, dtype=np.int64), _nothing(), np.arange(10), 0)
    assert not len(found)


def test_exemplars_are_near_every_hull_and_within_the_limits_the_most_telling_first() -> None:
    table, parts = _chairs()
    whole = choose_exemplars(table, len(parts), len(parts))
    places = [place for own in whole.values() for place in own]
    gaps = np.abs((table.rows[:, None] - table.rows[None, places]) * table.metric).sum(axis=2)
    assert gaps.min(axis=1).max() <= 2 * RADIUS  # one of its cluster is asked about
    few = choose_exemplars(table, 3, 4)
    assert [*few] == [*whole][:3] and all(len(own) <= 4 for own in few.values())
    assert all(set(table.owner[own]) == {mesh} for mesh, own in whole.items())
    assert choose_exemplars(FamilyTable.of([]), 3, 4) == {}
