"""The numbers of many OBJ statements at once, where these are plain; one by one takes ten times as long.

What is not plain (comments behind numbers, continued lines, words that are no numbers) is left to the careful way,
which knows where it stands and what to say about it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from meshforge.geometry import Floats, Ints

_UNUSUAL = (b"#", b"\\", b"_", b" /", b"\t/", b"\x0b/", b"\x0c/")
_BEHIND = re.compile(rb"/\S*")  # texture and normal numbers behind a vertex number
_QUICK = {word + blank: word for word in (b"v", b"f", b"vn", b"vt") for blank in (b" ", b"\t")}


def keywords(statements: Sequence[bytes]) -> list[bytes]:
    """The first word of each statement, none where it is empty."""
    return [_QUICK.get(s[:2]) or _QUICK.get(s[:3]) or keyword(s) for s in statements]


def keyword(statement: bytes) -> bytes:
    """The first word of a statement, none where it is empty."""
    words = statement.split(None, 1)
    return words[0] if words else b""


def plain_vertices(rows: Sequence[bytes]) -> Floats | None:
    """The vertices (n, 3) of `v` statements; None where these are not plain, or not of the same length."""
    text = b"".join(rows)
    if not rows or any(mark in text for mark in _UNUSUAL):
        return None
    words = text.split()
    width = len(words) // len(rows)
    if width < 4 or len(words) != width * len(rows) or not _only_at_starts(words, b"v", width, len(rows)):
        return None
    try:
        return np.column_stack([np.array(list(map(float, words[k::width]))) for k in (1, 2, 3)])
    except ValueError:
        return None


def plain_faces(rows: Sequence[bytes], before: Ints, total: int) -> tuple[Ints, Ints] | None:
    """The statement (m,) of each triangle of `f` statements, and the triangles (m, 3), polygons cut into fans.

    before: (n,) the vertices ahead of each statement, from which negative numbers count; total: those of the file.
    None where the statements are not plain, or name a vertex that is not there.
    """
    text = b"".join(rows)
    if not rows or any(mark in text for mark in _UNUSUAL):
        return None
    words = (_BEHIND.sub(b"", text) if b"/" in text else text).split()
    width = len(words) // len(rows)
    if len(words) == width * len(rows) and _only_at_starts(words, b"f", width, len(rows)):
        del words[::width]
        counts = np.full(len(rows), width - 1)
    else:
        words = [word for word in words if word != b"f"]
        counts = np.array([len(row.split()) - 1 for row in rows])
    try:
        corners = np.array(list(map(int, words)), dtype=np.int64)
    except (ValueError, OverflowError):
        return None
    if counts.sum() != len(corners):
        return None
    corners = np.where(corners > 0, corners - 1, np.where(corners < 0, corners + np.repeat(before, counts), -1))
    if corners.min(initial=0) < 0 or corners.max(initial=-1) >= total:
        return None
    return _fans(corners, counts)


def _only_at_starts(words: list[bytes], word: bytes, width: int, count: int) -> bool:
    """Whether a word is every width-th one of others, and none besides."""
    return words[::width].count(word) == count == words.count(word)


def _fans(corners: Ints, counts: Ints) -> tuple[Ints, Ints]:
    """Polygons of so many corners (n,), one after the other, as triangles (m, 3); first the polygon (m,) of each."""
    triangles = np.maximum(counts - 2, 0)
    polygon = np.repeat(np.arange(len(counts)), triangles)
    first = np.repeat(np.cumsum(counts) - counts, triangles)
    second = first + 1 + np.arange(len(first)) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    return polygon, corners[np.column_stack([first, second, second + 1])]
