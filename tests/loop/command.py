"""Runs the command line as a person does: another process, words, exit code, output."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

_RUN = "from meshforge.cli import main; main()"


@dataclass(frozen=True)
class Done:
    """What a command left behind."""

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
