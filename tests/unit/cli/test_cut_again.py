"""A split that is asked for again, as after a kill, was done already."""

from pathlib import Path

import pytest

from tests.cup_project import CUP, cup_project
from tests.faults.runs import outputs
from tests.unit.cli.in_process import Run


def test_the_same_cut_again_says_so_without_changes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, run: Run) -> None:
    monkeypatch.chdir(tmp_path)
    project = cup_project(tmp_path)
    words = ("cut", "project", CUP, "cup/b0", "--at", "0.05,0.05,0.005", "--across", "1,0,0")
    first = run(*words)
    assert first.code == 0, first.err
    before = outputs(project.folder)
    again = run(*words)
    assert again.code == 0 and "this was done already" in again.out + again.err
    assert outputs(project.folder) == before
