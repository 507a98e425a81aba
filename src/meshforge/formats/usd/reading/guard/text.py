"""Layers of text: brackets and paths that lie too deep."""

from __future__ import annotations

import re

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.usd.reading.guard.remedy import DEEPEST, NEEDLESS

TEXT = b"#usda"
_QUIET = re.compile(rb'"""(?:[^\\]|\\.)*?"""|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)*\'|@[^@\n]*@|#[^\n]*', re.S)
_PATH = re.compile(rb"<[^<>\n]*>")


def refuse_deep_text(data: bytes, where: str) -> None:
    """Raise AssetError where brackets lie in brackets too often, in strings as well, or a path has too many steps."""
    quiet = _QUIET.findall(data)
    plain = _QUIET.sub(b"", data)
    if any(depth(part) > DEEPEST for part in (plain, *quiet)) or any(
        path.count(b"/") > DEEPEST for path in _PATH.findall(plain)
    ):
        raise AssetError(f"it is nested more than {DEEPEST} deep", where=where, remedy=NEEDLESS)


def depth(text: bytes) -> int:
    """How often brackets lie within brackets, at most. Expressions in strings are parsed like any others."""
    if sum(map(text.count, (b"(", b"[", b"{"))) <= DEEPEST:
        return 0  # not deep, however they lie
    letters = np.frombuffer(text, dtype=np.uint8)
    steps = np.isin(letters, list(b"([{")).astype(np.int64) - np.isin(letters, list(b")]}"))
    return int(steps.cumsum().max(initial=0))
