"""Edits of an XML text at byte offsets, so that everything else stays as it was authored."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from meshforge.formats.xml.tree import Element

_ATTRIBUTE = re.compile(rb"\s+([^\s=/>\"']+)\s*=\s*(\"[^\"]*\"|'[^']*')")
_ESCAPES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&apos;"}
_ESCAPES |= {"\t": "&#9;", "\n": "&#10;", "\r": "&#13;"}
_COMMENT = re.compile(rb"\s*<!--.*?-->", re.S)


@dataclass(frozen=True, slots=True)
class Splice:
    """New bytes in place of [start, end)."""

    start: int
    end: int
    text: bytes


def spliced(data: bytes, splices: Iterable[Splice], start: int = 0, end: int | None = None) -> bytes:
    """The bytes [start, end) after splices within them, which do not overlap."""
    out, at = [], start
    for splice in sorted(splices, key=lambda s: (s.start, s.end)):
        out += [data[at : splice.start], splice.text]
        at = splice.end
    return b"".join([*out, data[at:end]])


def attribute(data: bytes, element: Element, name: str, value: str | None, *, last: bool = False) -> Splice:
    """The edit that sets an attribute of an element, in its place and quotes where it is there; None removes it.

    last: a new one goes after the others instead of before them.
    """
    at = element.start + 1 + len(element.tag.encode())
    for found in _ATTRIBUTE.finditer(data, at, element.inside):
        if found[1] == name.encode():
            if value is None:
                return Splice(found.start(), found.end(), b"")
            return Splice(found.start(2) + 1, found.end(2) - 1, escaped(value))
        at = found.end() if last else at
    return Splice(at, at, b"" if value is None else b' %s="%s"' % (name.encode(), escaped(value)))


def escaped(value: str) -> bytes:
    """A text as it stands between the quotes of an attribute."""
    return "".join(_ESCAPES.get(letter, letter) for letter in value).encode()


def without_comments(text: bytes) -> bytes:
    """An element's text without the comments in it, for a second copy of it."""
    return _COMMENT.sub(b"", text)


def newline(data: bytes) -> bytes:
    """The line end of a text."""
    return b"\r\n" if b"\r\n" in data else b"\n"


def indent(data: bytes, at: int) -> bytes | None:
    """The blanks between the start of the line and `at`, None where something else is there."""
    line = data.rfind(b"\n", 0, at) + 1
    blanks = data[line:at]
    return blanks if not blanks.strip() else None


def removed(data: bytes, element: Element) -> Splice:
    """The edit that removes an element, with its lines where it has them for itself."""
    end = data.find(b"\n", element.end) + 1 or len(data)
    before = indent(data, element.start)
    if before is None or data[element.end : end].strip():
        return Splice(element.start, element.end, b"")
    return Splice(element.start - len(before), end, b"")
