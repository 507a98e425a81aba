"""Runs the command line at a terminal of its own, where a person types."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import TracebackType
from typing import IO

_RUN = "from meshforge.cli import main; main()"


class Terminal:
    """A `meshforge` command at a pseudo-terminal. text: everything it has printed there.

    results: where its stdout goes, if elsewhere.
    """

    def __init__(self, *words: str, cwd: Path, results: IO[bytes] | None = None) -> None:
        self._ours, theirs = os.openpty()
        environment = {**os.environ, "TERM": "dumb", "COLUMNS": "200"}
        self._process = subprocess.Popen(
            [sys.executable, "-c", _RUN, *words],
            cwd=cwd,
            env=environment,
            stdin=theirs,
            stdout=results or theirs,
            stderr=theirs,
            start_new_session=True,
        )
        os.close(theirs)
        self.text = ""
        self._seen = 0

    def until(self, words: str, seconds: float = 60.0) -> str:
        """What it prints up to some words."""
        end = time.monotonic() + seconds
        while words not in self.text[self._seen :]:
            assert time.monotonic() < end, f"waiting for {words!r} in:\n{self.text}"
            assert self._read(), f"it ended before {words!r}:\n{self.text}"
        start, self._seen = self._seen, self.text.index(words, self._seen) + len(words)
        return self.text[start : self._seen]

    def enter(self, line: str) -> None:
        """Type a line, and Enter."""
        os.write(self._ours, f"{line}\n".encode())

    def interrupt(self, seconds: float = 60.0) -> None:
        """Ctrl-C, as a person presses it: when the command waits, which it does not yet when its last words are here.

        Between these words and the wait Python notes a signal and goes to sleep over it; a second one wakes it.
        """
        end = time.monotonic() + seconds
        while not self._sleeps():
            assert time.monotonic() < end, f"it does not wait for anything:\n{self.text}"
            time.sleep(0.05)
        os.kill(self._process.pid, signal.SIGINT)

    def _sleeps(self) -> bool:
        """Whether its main thread waits for something; told by Linux, elsewhere guessed after a moment."""
        stat = Path(f"/proc/{self._process.pid}/stat")
        if not stat.exists():
            time.sleep(0.5)
            return True
        return stat.read_text().rpartition(")")[2].split()[0] == "S"

    def end(self, seconds: float = 60.0) -> int:
        """Wait for its end; the exit code."""
        end = time.monotonic() + seconds
        while self._read():
            assert time.monotonic() < end, f"it did not end:\n{self.text}"
        return self._process.wait(10)

    def _read(self) -> bool:
        """Read what is there; whether more can come."""
        if not select.select([self._ours], [], [], 0.5)[0]:
            return True
        try:
            data = os.read(self._ours, 65536)
        except OSError:  # the other side is closed
            return False
        self.text += data.decode(errors="replace").replace("\r\n", "\n")
        return bool(data)

    def __enter__(self) -> Terminal:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        if self._process.poll() is None:
            self._process.kill()
        self._process.wait(10)
        os.close(self._ours)
