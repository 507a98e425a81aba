"""Hulls as people type them: names, patterns and numbers with commas between, extractors; and unknown labels."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Sequence
from fnmatch import fnmatchcase
from functools import partial
from itertools import chain
from typing import TYPE_CHECKING

from meshforge.common import UsageError, join_names, suggest_among, suggest_name
from meshforge.language import EXTRACTORS, EXTREMITY, Extractor, labels_of, list_operators, parse_extractor, show
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from meshforge.project import Project


LISTING = "meshforge info ASSET"
"""The command that lists the names and numbers of hulls."""


def find_hulls(
    text: str, hulls: Collection[str], where: str, listing: str = LISTING, numbered: Sequence[str] | None = None
) -> frozenset[str]:
    """Return the hulls of names, numbers `#5`, ranges `#22-26` or `geom#22-26`, or patterns, with commas between.

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
    """Return whether a text is the number of a hull, `#5`; a hull may have that name."""
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
    place = int(part[1:])
    if place >= len(numbered):
        count = f"Hulls have the numbers #0 to #{len(numbered) - 1}" if numbered else "There are no hulls"
        raise UsageError(f"{where}: no hull has the number {part}", remedy=f"{count}: {listing}")
    if numbered[place] not in hulls:
        raise UsageError(f"{where}: {part} is {numbered[place]}, which an earlier step took away")
    return numbered[place]


def is_extractor(text: str, hulls: Collection[str]) -> bool:
    """Return whether a text begins as an extractor does, right or wrong, in any case; no part names a hull."""
    found = re.match(r"\s*(\w+)\s*(\(|$)", text)
    if found is None or any(part.strip() in hulls for part in text.split(",")):
        return False
    if found[2]:
        return found[1].lower() in map(str.lower, list_operators())
    return found[1].lower() == "all" or found[1] in EXTRACTORS.plugin_names


def select_hulls(
    text: str, mesh: SymbolicMesh, known: Callable[[], Collection[str]], where: str, extremity: float | None = None
) -> frozenset[str]:
    """Return the names of the hulls that an extractor selects in a mesh; where: what an error is about.

    known: as of `find_absent_labels`. Raises ProgramError where the text is no extractor; UsageError for a label that
    no asset has, and where nothing is selected.
    """
    extractor = parse_extractor(text, where)
    absent = find_absent_labels(extractor, mesh, known, where)
    chosen = extractor.select(mesh, EXTREMITY if extremity is None else extremity)
    if not chosen:
        why = f": no hull here is labelled {join_names(absent)}" if absent else ""
        remedy = "Name hulls, or write `nothing` where this asset has nothing to select."
        raise UsageError(f"{where}: {show(extractor)} selects nothing here{why}", remedy=remedy)
    return frozenset(mesh.hulls[k].name for k in chosen)


def find_absent_labels(
    extractor: Extractor, mesh: SymbolicMesh, known: Callable[[], Collection[str]], where: str
) -> list[str]:
    """Return the labels that an extractor asks for and only this mesh lacks, as an asset need not have all of its
    family's.

    known: the labels of the family, asked for where this mesh lacks one. Raises UsageError, naming the nearest one, for
    a label that no asset has.
    """
    here = {hull.label for hull in mesh.hulls if hull.label}
    absent = [label for label in labels_of(extractor) if label not in here]
    words = sorted({*here, *known()}) if absent else ()
    for label in absent:
        if label not in words:
            remedy = (
                suggest_among(label, words, "Labels are") if words else "Give labels: meshforge label, or --labels."
            )
            raise UsageError(f"{where}: no hull is labelled {label!r}", remedy=remedy)
    return absent


def labels_of_project(project: Project) -> Collection[str]:
    """Return the labels that hulls of a project can have: its vocabulary, else those that assets have; and classes."""
    every = (project.labels(asset).labels.values() for asset in project.layout.labels.ids)
    return project.words if project.vocabulary else {*project.words, *(one.name for one in chain.from_iterable(every))}
