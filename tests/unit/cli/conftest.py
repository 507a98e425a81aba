"""The command line in this process, in a folder of the test's own."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.unit.cli.in_process import Run, runner


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Run:
    """Runs a command; a file that needs something in the folder first has a fixture of this name, too."""
    monkeypatch.chdir(tmp_path)
    return runner(monkeypatch, capsys)
