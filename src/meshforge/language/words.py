"""The words of the language: operators, directions and labels, and which labels are written in quotes."""

import json
import math
import re
from typing import Literal, get_args

from meshforge.common import ProgramError, suggest_among

OPERATORS = ("All", "Is", "Attach", "Geo", "Union", "Intersect", "Diff")
Direction = Literal["+X", "-X", "+Y", "-Y", "+Z", "-Z"]
DIRECTIONS: tuple[Direction, ...] = get_args(Direction)
WORD = re.compile(r"[^\W\d]\w*")
RESERVED = frozenset((*OPERATORS, "Delete", "Replace", "Add", "Merge", "Scale", "Shrink", "Each"))
"""Words that labels are quoted for, whatever plug-ins are installed. A new operation need not be among them."""


def check_direction(direction: str) -> None:
    """Raise ProgramError for what is no direction."""
    if direction not in DIRECTIONS:
        raise ProgramError(f"unknown direction {direction!r}", remedy=f"Directions are {', '.join(DIRECTIONS)}.")


def check_label(label: str) -> None:
    """Raise ProgramError for what cannot be a label."""
    if not isinstance(label, str) or not label:
        raise ProgramError(f"a label is a text of at least one character, not {label!r}")


def check_declared(label: str, declared: tuple[str, ...]) -> None:
    """Raise ProgramError for a label that is not among those declared."""
    if label not in declared:
        raise ProgramError(f"unknown label {label!r}", remedy=suggest_among(label, declared, "Declared labels:"))


def show_label(label: str) -> str:
    """Return a label as it is written: bare where it is a word and no operator, else quoted."""
    plain = WORD.fullmatch(label) and label not in RESERVED
    return label if plain else json.dumps(label, ensure_ascii=False)


def quote_label(label: str) -> str:
    """Return a label in a sentence: bare where it is a word."""
    return label if WORD.fullmatch(label) else f"“{label}”"


def check_threshold(name: str, value: float | None) -> None:
    """Raise ProgramError for a threshold that is not a number above 0 and at most 1."""
    if value is not None and not (math.isfinite(value) and 0 < value <= 1):
        raise ProgramError(f"{name} is a share of a diagonal, above 0 and at most 1, not {value:g}")
