"""Mending labels where neither choice of a question is right."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from meshforge.symbolic import SymbolicMesh
    from meshforge.synthesis import Question

_MOST = 20  # hulls that are listed


def doubtful_hulls(question: Question) -> tuple[str, ...]:
    """The hulls that some choices select and others do not, in order of name."""
    sets = [frozenset(choice.select) for choice in question.choices]
    return tuple(sorted(frozenset.union(*sets) - frozenset.intersection(*sets)))


def labels_card(hulls: Sequence[str], mesh: SymbolicMesh) -> str:
    """The labels that some hulls have; of many the first ones."""
    rows = [f"  {name}  {mesh.hull_of(name).label or 'no label'}" for name in hulls if name in mesh.index]
    more = len(rows) - _MOST
    return "\n".join([*rows[:_MOST], f"  and {more} more"] if more > 1 else rows)


def mended(text: str, mesh: SymbolicMesh, vocabulary: Sequence[str]) -> dict[str, str]:
    """The labels that a line of HULL=LABEL, with commas between, gives. Raises UsageError for what cannot be."""
    from meshforge.errors import UsageError, nearest

    given: dict[str, str] = {}
    for part in (part.strip() for part in text.split(",") if part.strip()):
        hull, equals, label = (word.strip() for word in part.rpartition("="))
        if not equals:
            raise UsageError(f"{part!r} is not of the form HULL=LABEL")
        for name, known, what in ((hull, mesh.index, "hull"), (label, vocabulary, "label")):
            if name not in known:
                like = nearest(name, known)
                raise UsageError(f"there is no {what} {name!r}" + (f"; did you mean {like!r}?" if like else ""))
        given[hull] = label
    return given
