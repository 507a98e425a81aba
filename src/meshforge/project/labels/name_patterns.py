"""The patterns by which a project says what names mean: the table `[names]` of meshforge.toml, and others given."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from meshforge.batch import SETTINGS
from meshforge.errors import MeshForgeError, UsageError, nearest
from meshforge.perception.names import Pattern, pattern_of
from meshforge.project.settings import Settings

Meanings = Sequence[tuple[str, str]]
"""Patterns of names, each with the label that such names mean, empty for none; the first that fits counts."""


def name_patterns(
    folder: Path, settings: Settings, vocabulary: Sequence[str], more: Meanings = ()
) -> tuple[Pattern, ...]:
    """The patterns of the project in a folder; more: others, which come first.

    Raises UsageError: a label that is not in the vocabulary, or a regular expression that is none.
    """
    where = str(folder / SETTINGS)
    given = tuple(_pattern(text, label, vocabulary) for text, label in more)
    try:
        return (*given, *(_pattern(text, label, vocabulary) for text, label in settings.names.items()))
    except MeshForgeError as error:
        raise error.at(where) from None


def _pattern(text: str, label: str, vocabulary: Sequence[str]) -> Pattern:
    if label and label not in vocabulary:
        like = nearest(label, vocabulary)
        remedy = f"Did you mean {like!r}?" if like else f"The vocabulary is: {', '.join(vocabulary) or 'empty'}."
        raise UsageError(f"the pattern {text} means {label!r}, which is not in the vocabulary", remedy=remedy)
    return pattern_of(text, label)
