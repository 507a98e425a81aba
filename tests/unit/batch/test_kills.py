"""A batch that is killed or stopped leaves whole files, and the next run makes good."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS, apply, expand, make_jobs
from meshforge.language import Program
from tests.unit.batch.families import PROGRAM, tree, write_tables, write_urdf_table
from tests.unit.deaths import deaths, needs_fork

OLD = "labels top, leg, misc\nUnion(Is(leg), Is(top)) => Merge\n"
NEW = "labels top, leg, misc\nIs(misc) => Delete\nIs(leg) => Merge\n"


def run(assets: Path, out: Path, text: str) -> list[str]:
    outcomes = apply(Program.parse(text), make_jobs(expand([assets])), out, execution=IN_PROCESS)
    return [outcome.status for outcome in outcomes]


def files(out: Path) -> dict[str, bytes]:
    return {name: data for name, data in tree(out).items() if not name.startswith(".meshforge")}


@needs_fork
def test_whenever_a_run_is_killed_each_file_is_the_old_or_the_new_and_the_next_run_completes(tmp_path: Path) -> None:
    assets, out = tmp_path / "robots", tmp_path / "out"
    write_urdf_table(assets)
    run(assets, tmp_path / "old", OLD)
    run(assets, tmp_path / "new", NEW)
    old, new = files(tmp_path / "old"), files(tmp_path / "new")
    run(assets, out, OLD)
    died = 0
    for _ in deaths(lambda: run(assets, out, NEW)):
        died += 1
        for name, data in files(out).items():
            assert data in (old.get(name), new.get(name)), name
        assert set(files(out)) <= set(old) | set(new)
    assert died > len(new)
    assert tree(out) == tree(tmp_path / "new")


SCRIPT = """\
import sys
import time
from pathlib import Path
from meshforge.batch import ExecutionOptions, apply, expand, make_jobs
from meshforge.language import Program

if __name__ == "__main__":
    assets, out, text = sys.argv[1:]
    for outcome in apply(Program.parse(text), make_jobs(expand([assets])), Path(out), execution=ExecutionOptions(1)):
        print(outcome.asset, flush=True)
"""


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="Ctrl-C is no signal here")
def test_ctrl_c_leaves_finished_work_intact_and_no_process_behind(tmp_path: Path) -> None:
    assets, out = tmp_path / "assets", tmp_path / "out"
    write_tables(assets, 40)
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    command = [sys.executable, str(script), str(assets), str(out), PROGRAM]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True, text=True
    ) as process:
        assert process.stdout
        first = process.stdout.readline().strip()
        os.killpg(process.pid, signal.SIGINT)  # to the whole group, as a terminal does
        rest, errors = process.communicate(timeout=60)
    assert process.returncode != 0 and "KeyboardInterrupt" in errors
    wait_until_gone(process.pid)
    finished = [first, *rest.split()]
    work = make_jobs(expand([assets]))[: len(finished) + 1]
    words = [outcome.status for outcome in apply(Program.parse(PROGRAM), work, out, execution=IN_PROCESS)]
    assert words == ["skipped"] * len(finished) + ["edited"]
    assert not (out / ".meshforge" / "drafts").exists()


def wait_until_gone(group: int) -> None:
    """Return when no process of the group is left; a test that hangs here has found one that stays."""
    while True:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return
        time.sleep(0.02)
