"""Words for messages: counts, lists of names, the name that was probably meant."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence


def pluralize(number: int, one: str, many: str | None = None) -> str:
    """`1 hull`, `2 hulls`, `2 bodies`."""
    return f"{number:,} {one if number == 1 else many or one + 's'}"


def join_names(names: Sequence[str], most: int = 5) -> str:
    """Names in a row, of many the first ones: `a, b, c, d, e and 7 more`."""
    more = len(names) - most
    return ", ".join(names) if more <= 0 else f"{', '.join(names[:most])} and {more} more"


def nearest_name(name: str, available: Iterable[str]) -> str | None:
    """The available name most like `name`, or None where nothing is alike."""
    found = difflib.get_close_matches(name, sorted(available), n=1, cutoff=0.5)
    return found[0] if found else None
