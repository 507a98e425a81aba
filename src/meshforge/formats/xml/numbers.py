"""Numbers as text in attributes, without a loss."""

from __future__ import annotations

from collections.abc import Iterable


def shown(values: Iterable[float]) -> str:
    """Numbers as text that reads back as the same numbers; no negative zeros."""
    return " ".join(repr(float(value) + 0.0).removesuffix(".0") for value in values)
