"""Patterns by which a person says what names mean: globs, and regular expressions between slashes."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from fnmatch import translate

from meshforge.errors import UsageError


@dataclass(frozen=True, slots=True)
class Pattern:
    """text: a glob `*drawer*` for whole names, or `/^d\\d+$/` for a part of one; cases are not told apart.

    label: what such names mean, empty for what is to be left without a label.
    """

    text: str
    label: str
    expression: re.Pattern[str]

    def matches(self, name: str) -> bool:
        return self.expression.search(name) is not None


def pattern_of(text: str, label: str) -> Pattern:
    """A pattern. Raises UsageError for a regular expression that is none."""
    is_expression = len(text) > 1 and text.startswith("/") and text.endswith("/")
    try:
        expression = re.compile(text[1:-1] if is_expression else rf"\A{translate(text)}", re.IGNORECASE)
    except re.error as error:
        raise UsageError(f"the pattern {text} is no regular expression: {error}", remedy="Mend it.") from None
    return Pattern(text, label, expression)


def fitting(name: str, patterns: Iterable[Pattern]) -> Pattern | None:
    """The first pattern that fits a name."""
    return next((pattern for pattern in patterns if pattern.matches(name)), None)
