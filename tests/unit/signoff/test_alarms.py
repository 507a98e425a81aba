from dataclasses import replace
from functools import cache

import pytest

from meshforge.formats import load
from meshforge.language import Program
from meshforge.samples import TABLES
from meshforge.signoff.outliers import Alarm, EditMeasures, find_alarms, measure_edit
from meshforge.symbolic import SymbolicMesh

USUAL = EditMeasures(30, 20, 0.5, 0.1, 0.1, (1.0, 1.0, 1.0), (1.0, 1.0, 1.0), 0.9, 0.01, 0.02)
BLOCK = replace(USUAL, hulls_after=5, volume_after=0.6, filled=0.7)
GONE = replace(USUAL, hulls_after=0, removed=1.0, volume_after=0.0, extents_after=(0.0, 0.0, 0.0), filled=0, freed=1.0)

SOLID = {"table_03.obj", "table_07.obj", "table_09.obj", "table_10.obj", "table_11.obj", "table_12.obj"}
"""The bundled tables with shelves: these are called panel, as the top is."""


def family(*edits: EditMeasures) -> dict[str, EditMeasures]:
    return {f"asset_{k}": edit for k, edit in enumerate(edits)}


def kinds(alarms: tuple[Alarm, ...]) -> set[str]:
    return {alarm.kind for alarm in alarms}


@cache
def tables() -> dict[str, SymbolicMesh]:
    return {p.name: load(p, labels=TABLES / f"{p.stem}.labels.json") for p in sorted(TABLES.glob("table_*.obj"))}


def edit_tables(text: str) -> dict[str, EditMeasures]:
    program = Program.parse(text)
    return {name: measure_edit(mesh, program.run(mesh, {}).mesh) for name, mesh in tables().items()}


@pytest.mark.slow
def test_the_tables_that_the_shorter_reading_makes_solid_stand_out_although_they_are_six_of_fourteen() -> None:
    """Who makes the top of a table without shelves one box, as the tour says, may get this program."""
    found = find_alarms(edit_tables("orient +Z: Is(leg) -> Is(panel)\nIs(misc) => Delete\nIs(panel) => Replace(box)"))
    assert found.keys() == SOLID
    for alarms in found.values():
        volume = next(alarm for alarm in alarms if alarm.kind == "volume")
        assert int(volume.text.split("%")[0].removeprefix("volume +")) > 280
        assert volume.text.endswith(", the family +0% to +37%")


def test_no_table_stands_out_that_the_bundled_program_would_edit_so() -> None:
    top = "orient +Z: Is(leg) -> Is(panel)\nIs(misc) => Delete\nGeo(Is(panel), +Z) => Replace(box)"
    assert find_alarms(edit_tables(top)) == {}


@pytest.mark.parametrize(("text", "kind"), [("All => Delete", "deleted"), ("All => Replace(box)", "block")])
def test_what_leaves_nothing_or_fills_all_stands_out_on_every_table(text: str, kind: str) -> None:
    found = find_alarms(edit_tables(text))
    assert found.keys() == tables().keys()
    assert all(kinds(alarms) == {kind} for alarms in found.values())


@pytest.mark.parametrize("size", [1, 2, 3])
def test_small_families_have_only_alarms_that_need_no_family(size: int) -> None:
    large = replace(USUAL, volume_after=0.9)
    assert find_alarms(family(*[USUAL] * (size - 1), large)) == {}
    assert find_alarms(family(*[USUAL] * (size - 1), GONE)).keys() == {f"asset_{size - 1}"}
    found = find_alarms(family(*[USUAL] * (size - 1), BLOCK))
    assert {name: kinds(alarms) for name, alarms in found.items()} == {f"asset_{size - 1}": {"block"}}


def test_three_wrong_of_five_stand_out_and_the_two_right_ones_do_not() -> None:
    found = find_alarms(family(USUAL, BLOCK, BLOCK, USUAL, replace(BLOCK, volume_after=0.8)))
    assert found.keys() == {"asset_1", "asset_2", "asset_4"}


def test_equal_edits_do_not_stand_out_by_rounding() -> None:
    edits = [replace(USUAL, volume_after=0.1 * (1 + 1e-9 * k), filled=0.01 + 1e-4 * (k == 3)) for k in range(9)]
    assert find_alarms(family(*edits)) == {}


def test_a_rare_variant_is_no_outlier_for_being_rare() -> None:
    """One table has drawers, which the program makes one box each."""
    rare = replace(USUAL, hulls_before=60, volume_after=0.13, filled=0.08)
    assert find_alarms(family(*[USUAL] * 24, rare)) == {}


def test_a_sentence_says_what_the_edit_did_and_what_the_family_did() -> None:
    others = [replace(USUAL, volume_after=0.1 * ratio) for ratio in (0.88, 0.95, 1.0, 1.0, 1.03)]
    found = find_alarms(family(*others, replace(USUAL, volume_after=0.58)))
    assert [(alarm.kind, alarm.text) for alarm in found["asset_5"]] == [
        ("volume", "volume +480%, the family -12% to +3%")
    ]
    assert found["asset_5"][0].excess > 5


def test_an_asset_of_which_nothing_is_left_stands_out_first_of_all_for_that() -> None:
    found = find_alarms(family(*[USUAL] * 6, GONE))
    assert found.keys() == {"asset_6"}
    assert found["asset_6"][0].text == "no hull is left"


def test_assets_without_hulls_do_not_disturb_a_family() -> None:
    nothing = measure_edit(SymbolicMesh(()), SymbolicMesh(()))
    assert find_alarms(family(*[nothing] * 6)) == {}
    assert find_alarms(family(*[USUAL] * 6, nothing)) == {}
