"""Labels of hulls: what a hull is, how sure that is, and who says so."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

Source = Literal["vlm", "propagated", "name", "file", "user", "repair", "edit"]
SOURCES: tuple[str, ...] = get_args(Source)
HUMAN_SOURCES = frozenset({"user", "repair"})
GIVEN_SOURCES = HUMAN_SOURCES | {"file"}
"""Sources of labels that are not guessed: a person, or a file that somebody made."""


@dataclass(frozen=True, slots=True)
class Label:
    """A label with its confidence in 0..1 and its source."""

    name: str
    confidence: float = 1.0
    source: Source = "user"
