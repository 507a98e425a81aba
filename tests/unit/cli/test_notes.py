"""The same note on many assets, or on many hulls of one, is printed once, with a count and the first names."""

from pathlib import Path

import pytest

from meshforge.cli.console import NoteLog, fold_notes
from tests.unit.cli.in_process import Run

LOST = "{} ({}) {} left out: MeshForge does not convert masses to OBJ"
CAPSULE = "URDF has no capsule: 'c{}' is written as a hull of 50 vertices"


def test_a_note_on_many_hulls_names_the_first_of_them() -> None:
    notes = [*(CAPSULE.format(k) for k in range(11)), "another"]
    also = " (also c1, c2, c3, c4, c5 and 5 more)"
    assert list(fold_notes(notes)) == [CAPSULE.format(0) + also, "another"]
    assert list(fold_notes(["the same", "the same"])) == ["the same"]


def test_a_note_on_many_assets_is_printed_once_and_its_number_after(capsys: pytest.CaptureFixture[str]) -> None:
    log = NoteLog(numbered=True)
    first = log.describe("crate", "edited a", [LOST.format("1 mass", "x", "is"), CAPSULE.format(1), CAPSULE.format(2)])
    assert first.splitlines() == [
        "edited a",
        f"    note: {LOST.format('1 mass', 'x', 'is')} [1]",
        f"    note: {CAPSULE.format(1)} (also c2) [2]",
    ]
    assert log.describe("desk", "edited b", [LOST.format("2 masses", "y, z", "are"), "odd"]) == (
        "edited b [1]\n    note: odd [3]"
    )
    assert log.describe("lamp", "edited c", [CAPSULE.format(9), LOST.format("1 mass", "w", "is")]) == "edited c [2] [1]"
    log.print_repeated()
    assert capsys.readouterr().out == "    [1] on 3 assets: crate, desk, lamp\n    [2] on 2 assets: crate, lamp\n"


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("1 mass (x) is left out: a", "1 joint (x) is left out: a"),
        ("1 mass (x) is left out: a", "1 mass (x) is left out: b"),
        ("1 other element (comment) is left out: a", "1 other element (sensor) is left out: a"),
        ("the gap shrinks from 0.2 m to 0.1 m", "the gap shrinks from 0.2 m to 0 m"),
    ],
)
def test_notes_that_say_another_thing_are_both_printed(one: str, other: str) -> None:
    log = NoteLog(numbered=True)
    log.describe("first", "first", [one])
    assert log.describe("second", "second", [other]) == f"second\n    note: {other} [2]"


def test_a_note_that_names_the_asset_and_its_hulls_is_printed_once() -> None:
    log, note = (
        NoteLog(numbered=True),
        "2 hull names ({0}#0, {0}#1) are written otherwise: they read back as UCX_{0}_00",
    )
    log.describe("in/jar.gltf", "jar", [note.format("jar")])
    assert log.describe("in/mug.gltf", "mug", [note.format("mug")]) == "mug [1]"
    assert log.describe("in/ug.gltf", "ug", [note.format("mug")]).startswith("ug\n")


def test_a_run_over_one_asset_has_no_numbers() -> None:
    assert NoteLog(numbered=False).describe("a", "a", ["x", "y"]) == "a\n    note: x\n    note: y"


@pytest.mark.slow
def test_apply_convert_and_check_print_the_same_note_once(run: Run) -> None:
    run("samples", "cups", "cups")
    cups = len(list(Path("cups").glob("**/*.urdf")))
    Path("p.mf").write_text("labels base, wall, handle, lid\n\nIs(handle) => Replace(capsule, tight)\n")
    for told, note, count in (
        (run("apply", "p.mf", "cups/**/*.urdf", "--out", "a"), "URDF without --urdf-capsules", cups - 1),
        (run("convert", "cups/**/*.urdf", "b", "--to", "obj"), "does not convert masses", cups),
        (run("check", "cups", "--engine", "unity", "--fit"), "engine: by the limits of Unity", cups),
    ):
        assert told.code == 0 and told.out.count(note) == 1
        number = next(line for line in told.out.splitlines() if note in line).rsplit(" ", 1)[1]
        marked = [line for line in told.out.splitlines() if number in line.split() and "note:" not in line]
        assert len([line for line in marked if "engine:" not in line]) == count  # all but the first, and the end
        assert any(f"{number} " in line and f"on {count} assets: camping_mug/" in line for line in marked)
