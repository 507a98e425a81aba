"""Projects in a plain script of a user's: without a main guard, beside threads, in a folder of somebody else."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cup_project import cup_project
from tests.plugin_packages import build_wheel, unpack

SCRIPT = """
import threading, time
threading.Thread(target=time.sleep, args=[60], daemon=True).start()  # beside which nothing is forked
from pathlib import Path
from meshforge import Project
project = Project.open("project")
print([type(outcome).__name__ for outcome in project.apply()])
print(len(project.review().assessment.assets), project.status().name)
print(project.label("propagate"))
print(sum(1 for _ in project.decompose(project.assets())), len(list(project.rebuild_spanning(dry_run=True))))
"""
COMMAND = """
import sys, threading, time
sys.path.remove("")  # as the command that pip installs
threading.Thread(target=time.sleep, args=[60], daemon=True).start()
from meshforge.cli import main
sys.argv[1:] = ["apply", "project", "--again", "--workers", "2", "--accept-outliers"]
main()
"""
_SAFE = "PYTHONSAFEPATH"


def _run(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    environment = {name: value for name, value in os.environ.items() if name not in ("MESHFORGE_WORKERS", _SAFE)}
    environment["PYTHONPATH"] = os.pathsep.join(path for path in sys.path if path)
    return subprocess.run([sys.executable, *words], cwd=folder, env=environment, capture_output=True, text=True)


@pytest.mark.slow
def test_a_script_without_a_main_guard_runs_as_any_other(tmp_path: Path) -> None:
    cup_project(tmp_path)
    (tmp_path / "script.py").write_text(SCRIPT)
    done = _run(tmp_path, "script.py")
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    assert done.stdout.splitlines()[:2] == ["['Skipped', 'Skipped']", "2 cups"]


@pytest.mark.slow
def test_python_m_meshforge_loads_nothing_of_the_present_folder(tmp_path: Path) -> None:
    points = {"meshforge.checks": {"mine": "stranger:Check"}}
    unpack(build_wheel(tmp_path, "stranger", "1.0", {"stranger.py": "open('loaded', 'w')"}, points), tmp_path)
    for name in ("numpy", "typer"):
        (tmp_path / f"{name}.py").write_text("open('loaded', 'w')")
    done = _run(tmp_path, "-m", "meshforge", "plugins")
    assert done.returncode == 0 and "There are no plug-ins" in done.stdout, done.stdout + done.stderr
    assert not (tmp_path / "loaded").exists()


@pytest.mark.slow
def test_workers_load_nothing_of_the_present_folder(tmp_path: Path) -> None:
    cup_project(tmp_path)
    for name in ("numpy", "scipy", "yaml", "pydantic", "pebble", "lark", "trimesh", "coal"):
        (tmp_path / f"{name}.py").write_text(f"open('loaded-{name}', 'w')")
    done = _run(tmp_path, "-c", COMMAND)
    assert done.returncode == 0, done.stdout + done.stderr
    assert not list(tmp_path.glob("loaded*"))
