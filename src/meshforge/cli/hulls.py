"""Hulls as people type them: names and patterns with commas between."""

from __future__ import annotations

from collections.abc import Collection
from fnmatch import fnmatchcase

from meshforge.common import UsageError, suggest_name


def find_hulls(text: str, hulls: Collection[str], where: str, listing: str = "meshforge info ASSET") -> frozenset[str]:
    """The hulls that names, or patterns as in a shell, with commas between, stand for; names count before patterns.

    hulls: the names of all; where: the argument that an error is about; listing: the command that lists the names.
    Raises UsageError for a part that is no hull's name and matches none.
    """
    if text in hulls:  # names may have commas
        return frozenset((text,))
    found: set[str] = set()
    for pattern in (part.strip() for part in text.split(",")):
        hits = {pattern}.intersection(hulls) or {name for name in hulls if fnmatchcase(name, pattern)}
        if not hits:
            remedy = suggest_name(pattern, hulls, f"See the names with: {listing}")
            raise UsageError(f"{where}: no hull is named {pattern!r}", remedy=remedy)
        found |= hits
    return frozenset(found)
