"""A real conversation at a pseudo-terminal."""

import json
import sys
from pathlib import Path

import pytest

from tests.unit.batch.families import PROGRAM, write_tables
from tests.unit.cli.terminal import Terminal
from tests.unit.project.shelves import ambiguous


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="no pseudo-terminals there")
def test_a_person_answers_and_an_interrupt_loses_nothing(tmp_path: Path) -> None:
    project = ambiguous(tmp_path)
    with Terminal("review", "racks", cwd=tmp_path) as terminal:
        terminal.until("What does rule 1 mean")
        terminal.until("q stop; Enter: 1: ")
        terminal.enter("n")
        terminal.until("q stop; Enter: 1: ")
        terminal.interrupt()
        assert terminal.end() == 1  # some results need review
    (answer,) = project.feedback().answers.values()
    assert answer.rule == 1 and answer.select is None and answer.refused


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="no pseudo-terminals there")
def test_results_go_into_a_file_while_the_bar_is_at_the_terminal(tmp_path: Path) -> None:
    write_tables(tmp_path / "assets", 4)
    (tmp_path / "p.mf").write_text(PROGRAM)
    with (tmp_path / "lines.json").open("wb") as results:
        words = ("apply", "p.mf", "assets", "--out", "out", "--json")
        with Terminal(*words, cwd=tmp_path, results=results) as terminal:
            assert terminal.end() == 0
    lines = [json.loads(line) for line in (tmp_path / "lines.json").read_text().splitlines()]
    assert [line["status"] for line in lines] == ["edited"] * 4
    assert "{" not in terminal.text
