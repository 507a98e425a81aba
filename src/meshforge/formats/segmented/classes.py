"""The names of classes: in a text file, or in the comments of a PLY file."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from meshforge.errors import AssetError
from meshforge.words import counted

_NUMBERED = re.compile(r"(-?\d+)\s*[\s:,=]\s*(\S.*)")
_COMMENT = re.compile(r"comment\s+(?:label|class|part|segment)\s+(-?\d+)\s*[\s:,=]\s*(\S.*)", re.I)
_LIST = re.compile(r"comment\s+(?:labels|classes|parts|segments|names)\s*[:=]?\s*(\S.*)", re.I)


def read_classes(path: Path) -> dict[int, str]:
    """The names of classes in a text file, by their number: a name a line, or `3 drawer`, with the number before it.

    Raises AssetError: it cannot be read, or says a number twice, or some lines have one and some have none.
    """
    try:
        lines = [line.strip() for line in path.read_text(encoding="utf-8-sig").splitlines()]
    except OSError as error:
        raise AssetError(f"the names of classes cannot be read ({error.strerror})", where=str(path)) from error
    except UnicodeDecodeError as error:
        raise AssetError("the names of classes are not UTF-8 text", where=str(path)) from error
    numbered = [(k, found) for k, line in enumerate(lines) if (found := _NUMBERED.fullmatch(line))]
    said = [line for line in lines if line]
    if numbered and len(numbered) < len(said):
        problem = f"{counted(len(numbered), 'line')} of {len(said)} begin with a number"
        raise AssetError(problem, where=str(path), remedy="Number all classes, or none.")
    if not numbered:
        return {k: line for k, line in enumerate(lines) if line}
    names: dict[int, str] = {}
    for k, found in numbered:
        number = int(found[1])
        if number in names:
            raise AssetError(f"class {number} is named twice", where=f"{path}:{k + 1}", remedy="Keep one of them.")
        names[number] = found[2]
    return names


def in_comments(lines: Iterable[str]) -> dict[int, str]:
    """The names of classes in header lines: `comment label 3 drawer`, or `comment classes drawer, handle`."""
    names: dict[int, str] = {}
    for line in lines:
        if found := _COMMENT.fullmatch(line.strip()):
            names[int(found[1])] = found[2].strip()
        elif found := _LIST.fullmatch(line.strip()):
            names |= in_order([name.strip() for name in found[1].split(",")])
    return names


def in_order(names: Sequence[str]) -> dict[int, str]:
    """Names by their place; an empty one is none."""
    return {k: name for k, name in enumerate(names) if name}
