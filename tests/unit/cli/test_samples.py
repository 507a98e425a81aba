"""`meshforge samples` at the command line: the list, a family in a folder, and what it refuses."""

from pathlib import Path

from meshforge.samples import FAMILIES
from tests.loop.readme import parse_commands
from tests.unit.cli.in_process import Run


def test_without_arguments_it_lists_each_family_in_a_line(run: Run) -> None:
    *lines, last = run("samples").out.splitlines()
    assert [line.split()[0] for line in lines] == [family.name for family in FAMILIES]
    assert last == "Write one with: meshforge samples FAMILY DIR"


def test_a_family_and_the_command_that_makes_a_project_of_it(run: Run) -> None:
    shown = run("samples", "tables", "my tables")
    assert shown.code == 0
    assert len(list(Path("my tables").glob("*.obj"))) == 14
    assert "wrote 28 files" in shown.out
    (words,) = parse_commands(shown.out.splitlines()[-1].removeprefix("Next: "))
    assert run(*words).out.startswith("tables: a project of 14 assets")
    assert "all files are there already" in run("samples", "tables", "my tables").out


def test_without_a_folder_it_says_how_to_name_one(run: Run) -> None:
    shown = run("samples", "tables")
    assert shown.code == 2
    assert shown.err == "error: there is no folder to write to\n  meshforge samples tables DIR\n"


def test_a_folder_that_holds_something_else_is_refused_in_one_message(run: Run) -> None:
    Path("out").mkdir()
    Path("out/thesis.txt").write_text("mine")
    shown = run("samples", "tables", "out")
    assert shown.code == 2
    assert shown.err == (
        "error: out: this folder holds something else: thesis.txt\n"
        "  Nothing was written; name an empty folder: meshforge samples tables DIR\n"
    )
