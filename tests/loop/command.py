"""Runs the command line as a person does: words, exit code, output; in another process or in this one."""

from __future__ import annotations

import json
import subprocess
import sys
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Any

import pytest

from meshforge.cli import main

_RUN = "from meshforge.cli import main; main()"


@dataclass(frozen=True)
class Done:
    code: int
    out: str
    err: str

    @property
    def json(self) -> Any:
        return json.loads(self.out)

    @property
    def lines(self) -> list[Any]:
        return [json.loads(line) for line in self.out.splitlines()]


def meshforge(*words: str | Path, cwd: Path, code: int = 0) -> Done:
    """Run `meshforge WORDS` in a folder and check its exit code; no traceback may reach the user."""
    made = subprocess.run(
        [sys.executable, "-c", _RUN, *map(str, words)],
        cwd=cwd,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert "Traceback" not in made.stderr, made.stderr
    assert made.returncode == code, f"exit code {made.returncode}\n{made.stdout}\n{made.stderr}"
    return Done(made.returncode, made.stdout, made.stderr)


def meshforge_here(*words: str | Path, cwd: Path, code: int = 0) -> Done:
    """The same in this process, without the second that it takes to begin one."""
    out, err = StringIO(), StringIO()
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(out), redirect_stderr(err):
        patch.setattr(sys, "argv", ["meshforge", *map(str, words)])
        patch.chdir(cwd)
        with pytest.raises(SystemExit) as left:
            main()
    left_with = int(left.value.code or 0)
    assert "Traceback" not in err.getvalue(), err.getvalue()
    assert left_with == code, f"exit code {left_with}\n{out.getvalue()}\n{err.getvalue()}"
    return Done(left_with, out.getvalue(), err.getvalue())
