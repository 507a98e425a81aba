"""Places in a program text, and errors that show them: file, line and column, the line itself, a caret."""

from __future__ import annotations

import re
from dataclasses import dataclass

from meshforge.errors import ProgramError

_THING = re.compile(r"""[^\W\d]\w*|"(?:[^"\\\n]|\\.)*"|[+-]?(?:\d+\.?\d*|\.\d+)\w*|[+-][^\W\d]\w*|=>|->|[^\n]|""")


@dataclass(frozen=True, slots=True)
class Source:
    """A program text and the name it goes by in errors."""

    text: str
    name: str

    def piece_at(self, offset: int) -> str:
        """The word, text, number or sign at an offset; empty at the end of a line."""
        found = _THING.match(self.text, offset)
        thing = found.group() if found else ""
        return "" if thing.startswith("#") or thing.isspace() else thing

    def position_of(self, offset: int) -> tuple[int, int]:
        """Line and column of an offset, both from 1."""
        before = self.text[:offset]
        return before.count("\n") + 1, offset - (before.rfind("\n") + 1) + 1

    def error_at(self, offset: int, problem: str, remedy: str | None = None, width: int | None = None) -> ProgramError:
        """The error at an offset, with the line and `width` carets below it (the length of what stands there)."""
        line, column = self.position_of(offset)
        text = self.text.split("\n")[line - 1].replace("\t", " ").rstrip("\r")
        carets = "^" * max(1, len(self.piece_at(offset)) if width is None else width)
        excerpt = f"    {text}\n    {' ' * (column - 1)}{carets}"
        return ProgramError(f"{problem}\n{excerpt}", where=f"{self.name}:{line}:{column}", remedy=remedy)
