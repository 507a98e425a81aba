"""Runs the command line in this process, as fast as tests want it."""

import sys
from collections.abc import Callable

import pytest

from meshforge.cli import main
from tests.loop.command import Done

Run = Callable[..., Done]


def runner(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """A function of the words after `meshforge`; no traceback may reach the user."""

    def run(*words: str) -> Done:
        monkeypatch.setattr(sys, "argv", ["meshforge", *words])
        with pytest.raises(SystemExit) as left:
            main()
        printed = capsys.readouterr()
        assert "Traceback" not in printed.err
        return Done(int(left.value.code or 0), printed.out, printed.err)

    return run
