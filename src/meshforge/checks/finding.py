"""What a check finds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

Severity = Literal["error", "warning"]
_SHOWN = 5  # names written out in a message; all of them are in `hulls`


@dataclass(frozen=True, slots=True)
class Finding:
    """A rule that does not hold, for the hulls it names.

    error: engines or this program will refuse or misread the hulls; warning: allowed, but worth a look.
    """

    rule: str
    severity: Severity
    hulls: tuple[str, ...]
    message: str
    remedy: str


def listed(names: Sequence[str]) -> str:
    """Names in a row, many of them cut short: `a, b, c, d, e and 7 more`."""
    more = len(names) - _SHOWN
    return ", ".join(names) if more <= 1 else f"{', '.join(names[:_SHOWN])} and {more} more"


def counted(count: int, noun: str) -> str:
    """`1 hull`, `2 hulls`."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
