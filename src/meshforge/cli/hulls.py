"""Hulls as people type them: names, patterns and numbers with commas between."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from fnmatch import fnmatchcase
from functools import partial

from meshforge.common import UsageError, suggest_name

LISTING = "meshforge info ASSET"
"""The command that lists the names and numbers of hulls."""


def find_hulls(
    text: str, hulls: Collection[str], where: str, listing: str = LISTING, numbered: Sequence[str] | None = None
) -> frozenset[str]:
    """The hulls of names, numbers `#5`, ranges `#22-26` or `geom#22-26`, or patterns, with commas between.

    A name counts before a number, and both before a pattern, which is compared with the whole name, `BODY/HULL`; `*`
    stands for slashes too. hulls: the names of all; where: the argument that an error is about; listing: the command
    that lists them; numbered: their names in the order of that list, where that is not the order of `hulls`.
    Raises UsageError for a part that is no hull's name or number and matches none.
    """
    if text in hulls:  # names may have commas
        return frozenset((text,))
    found: set[str] = set()
    for part in (part.strip() for part in text.split(",")):
        found |= _find_part(part, hulls, where, listing, tuple(hulls) if numbered is None else numbered)
    return frozenset(found)


def is_number(text: str) -> bool:
    """Whether a text is the number of a hull, `#5`; a hull may have that name."""
    return re.fullmatch("#[0-9]+", text) is not None


def _find_part(part: str, hulls: Collection[str], where: str, listing: str, numbered: Sequence[str]) -> set[str]:
    if part in hulls:
        return {part}
    if is_number(part):
        return {_find_number(part, hulls, where, listing, numbered)}
    if ends := re.fullmatch("(.*#)([0-9]+)-#?([0-9]+)", part):
        first, last = int(ends[2]), int(ends[3])
        if first > last:
            raise UsageError(f"{where}: {part} ends before it begins", remedy=f"Write it so: {ends[1]}{last}-{first}")
        find = partial(_find_part, hulls=hulls, where=where, listing=listing, numbered=numbered)
        found = find(f"{ends[1]}{last}")  # before the others, so that a far too high one is refused at once
        return found.union(*(find(f"{ends[1]}{place}") for place in range(first, last)))
    hits = {name for name in hulls if fnmatchcase(name, part)}
    if not hits:
        remedy = suggest_name(part, hulls, f"See the names with: {listing}")
        if "/" not in part and any(fnmatchcase(name, f"*/{part}") for name in hulls):
            remedy = f"A name begins with that of its body. Write it so: '*/{part}'"
        elif any(name.startswith(f"{part}/") for name in hulls):
            remedy = f"That is a body. For all of its hulls, write: '{part}/*'"
        elif re.fullmatch("[0-9]+(-[0-9]+)?", part):
            remedy = f"A number stands behind a #. Write it so: '#{part}'"
        raise UsageError(f"{where}: no hull is named {part!r}", remedy=remedy)
    return hits


def _find_number(part: str, hulls: Collection[str], where: str, listing: str, numbered: Sequence[str]) -> str:
    """The name of the hull of a number, which is its place in the list, from 0."""
    place = int(part[1:])
    if place >= len(numbered):
        count = f"Hulls have the numbers #0 to #{len(numbered) - 1}" if numbered else "There are no hulls"
        raise UsageError(f"{where}: no hull has the number {part}", remedy=f"{count}: {listing}")
    if numbered[place] not in hulls:
        raise UsageError(f"{where}: {part} is {numbered[place]}, which an earlier step took away")
    return numbered[place]
