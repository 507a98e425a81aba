"""How far a run of several parts is, kept until it ends: the same command goes on after the parts that are done."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from pathlib import Path

from benchmark.journal import JOURNALS, digest


class Progress:
    """The parts that a command has done, by the code that did them. A part whose code has changed is done again."""

    def __init__(self, command: Sequence[str], folder: Path = JOURNALS) -> None:
        name = hashlib.blake2b("\0".join(command).encode(), digest_size=8).hexdigest()
        self._path = folder / f"run-{name}.txt"
        self._done = frozenset(self._path.read_text("utf-8").splitlines()) if self._path.is_file() else frozenset()

    def is_done(self, page: str, part: str) -> bool:
        """Whether an interrupted run of the command has done a part with the code as it is."""
        return _line(page, part) in self._done

    def note(self, page: str, part: str) -> None:
        """A part is done, and its result written."""
        self._path.parent.mkdir(parents=True, exist_ok=True)
        with self._path.open("a", encoding="utf-8") as file:
            file.write(_line(page, part) + "\n")

    def end(self) -> None:
        """All is done: the next run of the command begins anew."""
        self._path.unlink(missing_ok=True)


def _line(page: str, part: str) -> str:
    return f"{part} {digest(f'benchmark.{page}.{part}')}"
