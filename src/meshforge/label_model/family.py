"""A family of hulls as a table: comparable rows, which hulls touch, and which labels are known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.rendering import UNSURE
from meshforge.symbolic import GIVEN_SOURCES, HUMAN_SOURCES, Label

NO_LABEL = -1
"""The code of a hull whose label is not known."""
_LEAST_SPREAD = 1e-3  # spread of a column below which it counts as constant
_MOST_SPREADS = 3.0  # spreads from the median beyond which nothing is farther


@dataclass(frozen=True, eq=False, slots=True)
class ColumnScale:
    """What brings columns to a common spread. middle, spread: (columns,)."""

    middle: Floats
    spread: Floats

    @staticmethod
    def of(rows: Floats) -> ColumnScale:
        """The medians and spreads of some rows (n, columns)."""
        if not len(rows):
            return ColumnScale(np.zeros(rows.shape[1]), np.ones(rows.shape[1]))
        return ColumnScale(np.median(rows, axis=0), np.maximum(rows.std(axis=0), _LEAST_SPREAD))

    def of_columns(self, columns: slice) -> ColumnScale:
        """That of some columns."""
        return ColumnScale(self.middle[columns], self.spread[columns])

    def __call__(self, rows: Floats) -> Floats:
        """Rows about the middle in units of the spread, far values drawn in."""
        return np.clip((rows - self.middle) / self.spread, -_MOST_SPREADS, _MOST_SPREADS)


@dataclass(frozen=True, eq=False)
class FamilyTable:
    """Hulls of all meshes, in order.

    rows: (n, columns), described and brought to a common spread by `scale`; owner: (n,) the mesh of each; codes: (n,)
    the place of its label among `labels`, NO_LABEL where it is not known; touching: pairs (m, 2) of hulls of one mesh
    that are in contact.
    """

    rows: Floats
    scale: ColumnScale
    owner: Ints
    codes: Ints
    labels: tuple[str, ...]
    touching: Ints

    @cached_property
    def labelled(self) -> Ints:
        """The hulls whose label is known."""
        return np.flatnonzero(self.codes != NO_LABEL)

    def with_labels(self, known: Sequence[str | None]) -> FamilyTable:
        """The table with other known labels; known: that of each hull, None where it is not."""
        labels = tuple(sorted({label for label in known if label is not None}))
        places = {label: place for place, label in enumerate(labels)}
        codes = np.array([NO_LABEL if label is None else places[label] for label in known], dtype=np.int64)
        return replace(self, codes=codes, labels=labels)


def pick_evenly(items: Ints, most: int) -> Ints:
    """Of very many some, evenly."""
    return items if len(items) <= most else items[np.arange(most) * len(items) // most]


def reference_label(label: Label | None) -> str | None:
    """The label that others may be taken from: one that a person gave, or that came in a file and is not unsure."""
    if label is None or label.source not in GIVEN_SOURCES:
        return None
    return label.name if label.source in HUMAN_SOURCES or label.confidence >= UNSURE else None
