"""Writing shapes as the text of an OBJ, in full precision."""

from __future__ import annotations

import re
from collections.abc import Sequence

from meshforge.formats.plain.parts import Part
from meshforge.geometry import Floats, Ints


def parts_text(
    parts: Sequence[Part], start: int = 0, end: bytes = b"\n", colors: int = 0, words: Sequence[bytes] = (b"o",)
) -> bytes:
    """Parts as text, an object each.

    start: the vertices ahead of them in the file; end: the line end; colors: values behind the coordinates of each
    vertex, where the file has colours there (some readers want them for all); words: the statements that name a part.
    """
    text: list[bytes] = []
    for part in parts:
        vertices, faces = part.surface.vertices, part.surface.faces
        text += [line for word in words for line in (named(word, part.name), end)]
        text.append(rows_text(vertices, faces + start, end, " 1.0" * colors))
        start += len(vertices)
    return b"".join(text)


def rows_text(vertices: Floats, faces: Ints, end: bytes = b"\n", tail: str = "") -> bytes:
    """The statements of vertices (n, 3) in full precision and of triangles (m, 3), whose numbers count from 0.

    end: the line end; tail: what follows the coordinates of each vertex.
    """
    last = end.decode()
    corners = f"v %r %r %r{tail}{last}" * len(vertices) % tuple((vertices + 0.0).ravel().tolist())
    return (corners + f"f %d %d %d{last}" * len(faces) % tuple((faces + 1).ravel().tolist())).encode()


def named(word: bytes, name: str) -> bytes:
    """An `o` or `g` statement without its line end; a line break in the name becomes a blank, a last backslash goes."""
    clean = re.sub(r"[\r\n]+", " ", name).rstrip("\\")
    return word + b" " + clean.encode("utf-8", "surrogateescape")


def line_end(statements: Sequence[bytes]) -> bytes:
    """The line end that a text uses."""
    first = statements[0] if statements else b"\n"
    return first[len(first.rstrip(b"\r\n")) :] or b"\n"
