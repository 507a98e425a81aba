"""The names of classes, in a text file or the comments of a PLY file, and what PartNet-Mobility calls the links of
an asset, in the `semantics.txt` beside its `mobility.urdf`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from meshforge.common import AssetError, pluralize

_NUMBERED = re.compile(r"(-?\d+)\s*[\s:,=]\s*(\S.*)")
_COMMENT = re.compile(r"comment\s+(?:label|class|part|segment)\s+(-?\d+)\s*[\s:,=]\s*(\S.*)", re.I)
_LIST = re.compile(r"comment\s+(?:labels|classes|parts|segments|names)\s*[:=]?\s*(\S.*)", re.I)

SEMANTICS_FILE = "semantics.txt"
"""The name of such a file."""
_REMEDY = "Each line has a link, the kind of its joint and what it is: link_0 hinge rotation_door."


def read_class_names(path: Path) -> dict[int, str]:
    """The names of classes in a text file, by their number: a name a line, or `3 drawer`, with the number before it.

    Raises AssetError: it cannot be read, or says a number twice, or some lines have one and some have none.
    """
    lines = [line.strip() for line in _read_lines(path, "the names of classes")]
    numbered = [(k, found) for k, line in enumerate(lines) if (found := _NUMBERED.fullmatch(line))]
    count = sum(map(bool, lines))
    if numbered and len(numbered) < count:
        problem = f"{pluralize(len(numbered), 'line')} of {count} begin with a number"
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


def _read_lines(path: Path, what: str) -> list[str]:
    try:
        return path.read_text(encoding="utf-8-sig").splitlines()
    except OSError as error:
        raise AssetError(f"{what} cannot be read ({error.strerror})", where=str(path)) from error
    except UnicodeDecodeError as error:
        raise AssetError(f"{what} are not UTF-8 text", where=str(path)) from error


def parse_comments(lines: Iterable[str]) -> dict[int, str]:
    """The names of classes in header lines: `comment label 3 drawer`, or `comment classes drawer, handle`."""
    names: dict[int, str] = {}
    for line in lines:
        if found := _COMMENT.fullmatch(line.strip()):
            names[int(found[1])] = found[2].strip()
        elif found := _LIST.fullmatch(line.strip()):
            names |= number_names([name.strip() for name in found[1].split(",")])
    return names


def number_names(names: Sequence[str]) -> dict[int, str]:
    """Names by their place; an empty one is none."""
    return {k: name for k, name in enumerate(names) if name}


@dataclass(frozen=True, slots=True)
class LinkSemantics:
    """What a link is; joint: the kind of the joint that carries it, as the file says it (`hinge`, `slider`, ...)."""

    link: str
    joint: str
    name: str


def read_semantics(path: Path) -> tuple[LinkSemantics, ...]:
    """The links that a file lists, in its order.

    Raises AssetError with the line: it cannot be read, a line of other than three words, a link listed twice.
    """
    found: dict[str, LinkSemantics] = {}
    for number, line in enumerate(_read_lines(path, "the semantics"), start=1):
        words = line.split()
        if not words:
            continue
        if len(words) != 3:
            problem = f"this line has {len(words)} words, not three: {line.strip()[:60]!r}"
            raise AssetError(problem, where=f"{path}:{number}", remedy=_REMEDY)
        if words[0] in found:
            problem = f"the link {words[0]!r} is listed twice"
            raise AssetError(problem, where=f"{path}:{number}", remedy="Keep one line.")
        found[words[0]] = LinkSemantics(*words)
    if not found:
        raise AssetError("it lists no link", where=str(path), remedy=_REMEDY)
    return tuple(found.values())
