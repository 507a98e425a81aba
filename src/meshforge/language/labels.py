"""Labels in program text: what can be one, and which are written in quotes."""

from __future__ import annotations

import json
import re

from meshforge.common import ProgramError, suggest_among
from meshforge.language.actions.registry import ACTIONS
from meshforge.language.words import OPERATORS

WORD = re.compile(r"[^\W\d]\w*")
RESERVED = frozenset(OPERATORS) | frozenset(ACTIONS.built_in)
"""Words that labels are quoted for, whatever plug-ins are installed."""


def check_label(label: str) -> None:
    """Raises ProgramError for what cannot be a label."""
    if not isinstance(label, str) or not label:
        raise ProgramError(f"a label is a text of at least one character, not {label!r}")


def check_declared(label: str, declared: tuple[str, ...]) -> None:
    """Raises ProgramError for a label that is not among those declared."""
    if label not in declared:
        raise ProgramError(f"unknown label {label!r}", remedy=suggest_among(label, declared, "Declared labels:"))


def show_label(label: str) -> str:
    """A label as it is written: bare where it is a word and no operator, else quoted."""
    plain = WORD.fullmatch(label) and label not in RESERVED
    return label if plain else json.dumps(label, ensure_ascii=False)
