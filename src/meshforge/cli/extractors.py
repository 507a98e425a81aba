"""Extractors as people type them, for one asset: what they select there, and labels that no asset has."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection
from itertools import chain
from typing import TYPE_CHECKING

from meshforge.common import UsageError, join_names, suggest_among
from meshforge.language import EXTREMITY, Extractor, labels_of, parse_extractor, show
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from meshforge.project import Project

_EXTRACTOR = re.compile(r"\s*(All\s*$|(Is|Attach|Geo|Union|Intersect|Diff)\s*\()", re.IGNORECASE)


def is_extractor(text: str, hulls: Collection[str]) -> bool:
    """Whether a text begins as an extractor does, right or wrong, in whatever case; none of its parts names a hull."""
    return _EXTRACTOR.match(text) is not None and not any(part.strip() in hulls for part in text.split(","))


def select_hulls(
    text: str, mesh: SymbolicMesh, known: Callable[[], Collection[str]], where: str, extremity: float | None = None
) -> frozenset[str]:
    """The names of the hulls that an extractor selects in a mesh; where: what an error is about.

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
    """The labels that an extractor asks for and only this mesh lacks, as an asset need not have all of its family's.

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
    """The labels that hulls of a project can have: its vocabulary, or, without one, those that its assets have."""
    every = (project.labels(asset).labels.values() for asset in project.layout.labels.ids)
    return project.vocabulary or {label.name for label in chain.from_iterable(every)}
