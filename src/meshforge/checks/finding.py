"""What a check finds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Severity = Literal["error", "warning"]


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
