"""What all tests share: which of them are run (see `tests/slow_tests.py`), and that Ctrl-C reaches their programs."""

from __future__ import annotations

import os
import signal
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from tests.unit.cli.in_process import Run

pytest_plugins = ["tests.slow_tests"]

# A job in the background is started with Ctrl-C ignored, and so would be all processes that tests start and interrupt.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# No studio that a test starts is to be among the recent projects of whoever runs the tests.
os.environ.setdefault("MESHFORGE_STATE", tempfile.mkdtemp(prefix="meshforge-state-"))

# Tests of crashes, time-outs and memory count on workers, as commands do; scripts of users work in their own process.
os.environ["MESHFORGE_WORKERS"] = "1"

# What commands print is compared however busy the machine is; how far work is comes after seconds.
os.environ["MESHFORGE_PROGRESS_AFTER"] = "1e6"


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Run:
    """Runs a command here, in the test's own folder; who needs something there has a fixture of this name, too."""
    from tests.unit.cli.in_process import runner  # which loads modules that read the settings above

    monkeypatch.chdir(tmp_path)
    return runner(monkeypatch, capsys)
