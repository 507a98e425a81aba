"""The speed benchmark runs, and the answers that it compares agree; no time is asserted."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import meshforge as mf
from benchmark import __main__ as bench
from benchmark.report import Goal, Result, Table, as_text
from benchmark.speed import by_hand, geometry, load, robots, save
from benchmark.speed.assets import multi_hull
from benchmark.speed.contact import one_mesh
from benchmark.speed.watch import look
from meshforge.batch import load_templates
from meshforge.language import Program
from meshforge.samples import TABLES


def silent(_: str) -> None:
    """Takes no notice of progress."""


def test_all_contestants_find_the_same_contacts_on_the_bundled_tables() -> None:
    found = multi_hull(silent, 2, bundled_only=True)
    assert len(found) == 2
    for name, mesh in found.items():
        row = one_mesh(name, mesh, 1)
        assert row["contacts"] == len(mesh.contacts) > 10
        assert row["near"] >= row["contacts"]
        assert {who: differ for who, differ in row["differ"].items() if differ} == {}
        assert all(seconds > 0 for seconds in row["seconds"].values())


@pytest.mark.parametrize("part", [load, robots, save, geometry])
def test_a_part_runs_quickly_on_bundled_files(part: ModuleType) -> None:
    result = part.measure(silent, True)
    assert isinstance(result, Result)
    assert all(table.rows for table in result.tables)
    assert as_text(Result.of_json(json.loads(json.dumps(result.to_json())))) == as_text(result)


def test_apply_is_run_and_watched(tmp_path: Path) -> None:
    assert bench.main(["apply", "--quick", "--out", str(tmp_path)]) == 0
    data = json.loads((tmp_path / "speed-apply.json").read_text("utf-8"))
    (row,) = data["details"]
    assert row["outcomes"] == {"edited": 2}
    assert row["main"] > 10 * 2**20
    assert data["quick"] is True
    page = (tmp_path / "speed.md").read_text("utf-8")
    assert "A quick run" in page
    assert "OBJ, bundled tables" in page
    assert str(tmp_path.anchor + "tmp") not in page


@pytest.mark.long
def test_commands_run_beside_the_script_by_hand(tmp_path: Path) -> None:
    assert bench.main(["commands", "--quick", "--out", str(tmp_path)]) == 0
    data = json.loads((tmp_path / "speed-commands.json").read_text("utf-8"))
    names = [row[0].split(",")[0] for row in data["tables"][0]["rows"]]
    assert names[0] == "the script by hand"
    assert {"apply", "check", "status", "synthesize", "label", "info", "render", "mf.load"} == set(names[1:])
    assert len(data["goals"]) == len(names) - 1


def test_the_script_by_hand_makes_of_a_table_what_its_program_does(tmp_path: Path) -> None:
    table = TABLES / "table_03.obj"
    labels = json.loads(table.with_suffix(".labels.json").read_text("utf-8"))["hulls"]
    tray = by_hand.read_tray(TABLES)
    by_hand.edit_table(by_hand.read_parts(table), labels, tray).export(tmp_path / table.name)
    program = Program.read(TABLES / "tables.mf")
    edited = program.run(mf.load(table), load_templates(program.templates, [TABLES / "templates"])).mesh
    made = mf.load(tmp_path / table.name)
    assert made.aabb and edited.aabb
    assert len(made.hulls) == len(edited.hulls)
    assert np.allclose(made.aabb.corners, edited.aabb.corners, atol=0.02)


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells the memory of other processes")
def test_a_process_that_becomes_another_program_has_the_memory_of_that_one() -> None:
    code = "import os; big = bytes(range(256)) * (1 << 20); print(flush=True); os.read(0, 1); os.execvp('cat', ['cat'])"
    largest: dict[int, int] = {}
    with subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        assert process.stdin is not None and process.stdout is not None
        process.stdout.readline()
        look(process.pid, largest)
        assert largest[process.pid] > 256 * 2**20
        process.stdin.write(b"\nhere\n")
        process.stdin.flush()
        process.stdout.readline()  # what `cat` says
        look(process.pid, largest)
        before = dict(largest)
        process.stdin.close()
        process.wait()
        look(process.pid, largest)
    assert 0 < largest[process.pid] < 64 * 2**20
    assert largest == before  # one that has ended keeps what it had


def test_a_part_that_is_not_there_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stopped:
        bench.main(["contacts"])
    assert stopped.value.code == 2
    assert "there is no part 'contacts'" in capsys.readouterr().err


def test_a_page_says_what_was_reached_and_what_not() -> None:
    goals = (Goal("quick", "at least", 10.0, 12.5), Goal("small", "at most", 2.0, 2.5))
    text = as_text(
        Result("x", "A part", (Table("Times", ("", "ms"), (("a|b", 1234.5), ("c", 0.01234))),), goals, ("so",))
    )
    assert "| quick  | at least 10 | 12.5     | reached         |" in text
    assert "| small  | at most 2   | 2.5      | **not reached** |" in text
    assert "| a/b | 1,234  |" in text or "| a/b | 1,234" in text
    assert "0.0123" in text
    assert text.endswith("- so\n")
