"""Writing shapes as the text of an OBJ, in full precision."""

from __future__ import annotations

import re
from collections.abc import Sequence

from meshforge.formats.parts import Part


def parts_text(parts: Sequence[Part], start: int = 0, end: bytes = b"\n", colors: int = 0) -> bytes:
    """Parts as text, an object each.

    start: the vertices ahead of them in the file; end: the line end; colors: values behind the coordinates of each
    vertex, where the file has colours there (some readers want them for all).
    """
    lines: list[bytes] = []
    tail = " 1.0" * colors
    for part in parts:
        surface = part.surface
        lines.append(named(b"o", part.name))
        lines += [f"v {x!r} {y!r} {z!r}{tail}".encode() for x, y, z in (surface.vertices + 0.0).tolist()]
        lines += [f"f {a} {b} {c}".encode() for a, b, c in (surface.faces + 1 + start).tolist()]
        start += len(surface.vertices)
    return b"".join(line + end for line in lines)


def named(word: bytes, name: str) -> bytes:
    """An `o` or `g` statement without its line end; a line break in the name becomes a blank, a last backslash goes."""
    clean = re.sub(r"[\r\n]+", " ", name).rstrip("\\")
    return word + b" " + clean.encode("utf-8", "surrogateescape")


def line_end(statements: Sequence[bytes]) -> bytes:
    """The line end that a text uses."""
    first = statements[0] if statements else b"\n"
    return first[len(first.rstrip(b"\r\n")) :] or b"\n"
