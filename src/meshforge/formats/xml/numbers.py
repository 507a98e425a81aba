"""Numbers as text in attributes and elements: read, and written without a loss."""

from __future__ import annotations

import math
from collections.abc import Iterable


def shown(values: Iterable[float]) -> str:
    """Numbers as text that reads back as the same numbers; no negative zeros."""
    return " ".join(repr(float(value) + 0.0).removesuffix(".0") for value in values)


def numbers(text: str) -> list[float] | None:
    """The numbers of a text, apart by blanks or (as PyBullet reads) commas, None where one is none or not finite."""
    if "_" in text or not text.isascii():  # Python's own ways to write numbers, which no engine reads
        return None
    try:
        values = [float(word) for word in text.replace(",", " ").split()]
    except ValueError:
        return None
    return values if all(map(math.isfinite, values)) else None
