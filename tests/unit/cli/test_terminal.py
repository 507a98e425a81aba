"""A real conversation at a pseudo-terminal."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tests.unit.cli.terminal import Terminal
from tests.unit.project.shelves import ambiguous


@pytest.mark.skipif(sys.platform == "win32", reason="no pseudo-terminals there")
def test_a_person_answers_and_an_interrupt_loses_nothing(tmp_path: Path) -> None:
    project = ambiguous(tmp_path)
    with Terminal("synthesize", "racks", cwd=tmp_path) as terminal:
        terminal.until("s to stop asking: ")
        terminal.enter("n")
        terminal.until("Enter to leave them: ")
        terminal.interrupt()
        assert terminal.end() == 0  # there is a program, if an open one
    assert "stopped; what you said so far is kept" in terminal.text
    assert "not settled: it is open what rule 1 does on rack2.obj" in terminal.text
    assert project.answers().ids == ("1:rack2.obj",)
