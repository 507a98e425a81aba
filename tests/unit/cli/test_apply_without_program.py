"""What is prepared, written without a program: the command says so, and status, prepare and split propose it."""

from pathlib import Path

import pytest

from meshforge.formats import load
from tests.unit.batch.preparation.samples import write_boxes, write_stand
from tests.unit.cli.in_process import Run

HULL = ("--decompose", "hull", "--workers", "1")
ANSWERS = "There is no program yet: assets are written as they are prepared, and nothing else is edited."


@pytest.fixture
def run(run: Run) -> Run:
    """Runs the command line in a folder with a project `p` of a URDF with an opaque piece and an OBJ of three hulls."""
    write_stand(Path("in"))
    write_boxes(Path("in/row.obj"))
    assert run("new", "p", "in/stand.urdf", "in/row.obj", "--vocabulary", "a,b").code == 0
    return run


def names(path: str) -> list[str]:
    return sorted(hull.name for hull in load(path).hulls)


def test_nothing_is_prepared_so_there_is_nothing_to_write(run: Run) -> None:
    told = run("apply", "p")
    assert told.code == 2 and "there is no program yet, and nothing is prepared" in told.err
    assert "Or write what is prepared" not in run("status", "p").out


def test_what_is_prepared_is_written_and_said_to_be_without_a_program(run: Run) -> None:
    told = run("prepare", "p", "stand.urdf", *HULL)
    assert "Next: meshforge apply p writes what is prepared, also without a program" in told.err
    assert "Or write what is prepared, without a program: meshforge apply p" in run("status", "p").out
    told = run("apply", "p")
    assert told.code == 0 and ANSWERS in told.err
    assert names("p/edited/stand.urdf") == ["cover/geom0#0", "frame/body#0", "frame/foot"]
    assert Path("p/edited/row.obj").read_bytes() == Path("in/row.obj").read_bytes()
    assert not Path("p/program.mf").exists()
    assert "Or write what is prepared" not in run("status", "p").out
    assert "2 skipped" in run("apply", "p").out


def test_a_cut_is_written_and_the_output_is_stale_after_another(run: Run) -> None:
    cut = ("cut", "p", "row.obj")
    told = run(*cut, "geom0#0", "--at", "0.5,0.5,0.5", "--across", "1,0,0")
    assert told.code == 0 and "meshforge apply p" in told.err
    assert run("apply", "p").code == 0
    assert len(names("p/edited/row.obj")) == 4
    assert "stale" not in run("status", "p").out
    assert run(*cut, "geom0#1", "--at", "2,0.5,0.5", "--across", "1,0,0").code == 0
    stood = run("status", "p").out
    assert "stale: preparation changed" in stood and "Or write what is prepared" in stood
    assert run("apply", "p").code == 0 and len(names("p/edited/row.obj")) == 5


def test_new_assets_beside_the_project_are_prepared_and_written(run: Run) -> None:
    assert run("prepare", "p", "stand.urdf", *HULL).code == 0
    write_stand(Path("more"), "later.urdf")
    told = run("apply", "p", "more/later.urdf", "--out", "out", "--workers", "1")
    assert told.code == 0 and ANSWERS in told.err
    assert names("out/later.urdf") == ["cover/geom0#0", "frame/body#0", "frame/foot"]


def test_nothing_follows_where_nothing_was_made(run: Run) -> None:
    assert run("prepare", "p", "stand.urdf", *HULL).code == 0
    assert run("prepare", "p", "stand.urdf", *HULL).err == ""
    assert run("prepare", "p", "--remove").err == ""


def test_with_a_program_apply_is_said_to_run_it(run: Run) -> None:
    assert "writes what is prepared, also without" in run("prepare", "p", "stand.urdf", *HULL).err
    Path("p/program.mf").write_text("Is(a) => Delete\n")
    assert "Next: meshforge apply p runs the program on it" in run("prepare", "p", "stand.urdf", *HULL, "--again").err


def test_a_project_or_program_that_is_not_there_is_said_with_the_nearest_name(run: Run) -> None:
    Path("row.mf").write_text("Is(a) => Delete\n")
    for words, near in ((("rows.mf", "in", "--out", "out"), "row.mf"), (("q",), None)):
        told = run("apply", *words)
        assert told.code == 2 and f"{words[0]}: there is no such project or program" in told.err
        assert near is None or f"Did you mean '{near}'?" in told.err


def test_without_hulls_to_write_the_message_names_what_makes_them(run: Run) -> None:
    told = run("convert", "in/corner.obj", "corner.glb", "--names", "unreal")
    assert told.code == 1 and "there is no hull to write" in told.err and "--concave decompose" in told.err
