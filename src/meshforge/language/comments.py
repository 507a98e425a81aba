"""Which comment of a program text belongs to which statement."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from meshforge.language.program import Comments, Lines

_TEXT_OR_COMMENT = re.compile(r'"(?:[^"\\\n]|\\.)*"|#(?P<comment>[^\n]*)')


def attached(text: str, lines: Sequence[int]) -> tuple[list[Comments], Lines]:
    """The comments of the statements on some lines (from 1, rising), and those after the last one.

    A comment alone on its line belongs to the next statement; empty lines between are kept, several as one.
    """
    found = [_comment(line) for line in text.split("\n")]
    comments, done = [], 0
    for line in lines:
        comments.append(Comments(_squeezed(found[done : line - 1], first=done == 0), found[line - 1]))
        done = line
    end = _squeezed(found[done:], first=done == 0)
    return comments, end[:-1] if end[-1:] == (None,) else end


def _comment(line: str) -> str | None:
    """The comment in a line of program text, without its `#`."""
    for match in _TEXT_OR_COMMENT.finditer(line):
        if match["comment"] is not None:
            return match["comment"].rstrip()
    return None


def _squeezed(lines: Iterable[str | None], *, first: bool) -> Lines:
    """The lines with several empty ones as one, and none at the start of a text."""
    out: list[str | None] = []
    for line in lines:
        if line is not None or (out[-1] is not None if out else not first):
            out.append(line)
    return tuple(out)
