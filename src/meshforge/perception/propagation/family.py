"""A family of meshes as propagation sees it: comparable rows, what touches what, and which labels are known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.perception.propagation.describe import WIDTH

UNTOLD = -1
"""The code of a hull whose label nobody told."""
_LEAST = 1e-3  # spread of a column below which it counts as constant
_MOST = 3.0  # spreads from the median beyond which nothing is farther


@dataclass(frozen=True, eq=False, slots=True)
class Scale:
    """What brings columns to a common spread. middle, spread: (columns,)."""

    middle: Floats
    spread: Floats

    @staticmethod
    def of(rows: Floats) -> Scale:
        """The medians and spreads of some rows (n, columns)."""
        if not len(rows):
            return Scale(np.zeros(rows.shape[1]), np.ones(rows.shape[1]))
        return Scale(np.median(rows, axis=0), np.maximum(rows.std(axis=0), _LEAST))

    def of_columns(self, columns: slice) -> Scale:
        """That of some columns."""
        return Scale(self.middle[columns], self.spread[columns])

    def __call__(self, rows: Floats) -> Floats:
        """Rows about the middle in units of the spread, far values drawn in."""
        return np.clip((rows - self.middle) / self.spread, -_MOST, _MOST)


@dataclass(frozen=True, eq=False)
class Family:
    """Hulls of all meshes, in order.

    rows: (n, columns), described and brought to a common spread by `scale`; owner: (n,) the mesh of each; codes: (n,)
    the place of its label among `labels`, where that is told, else UNTOLD; touching: pairs (m, 2) of hulls of one mesh
    that are in contact.
    """

    rows: Floats
    scale: Scale
    owner: Ints
    codes: Ints
    labels: tuple[str, ...]
    touching: Ints

    @cached_property
    def labelled(self) -> Ints:
        """The hulls whose label is told."""
        return np.flatnonzero(self.codes != UNTOLD)

    def with_labels(self, told: Sequence[str | None]) -> Family:
        """The same with other labels told; told: that of each hull, None where it is not known."""
        labels = tuple(sorted({label for label in told if label is not None}))
        places = {label: place for place, label in enumerate(labels)}
        codes = np.array([UNTOLD if label is None else places[label] for label in told], dtype=np.int64)
        return replace(self, codes=codes, labels=labels)


def family_of(seen: Sequence[tuple[Floats, Ints]]) -> Family:
    """A family of which no label is told yet; seen: `rows` and `touching` of the sketch of each mesh."""
    rows = np.concatenate([np.zeros((0, WIDTH)), *(own for own, _ in seen)])
    sizes = np.array([len(own) for own, _ in seen], dtype=np.int64)
    starts = np.cumsum(sizes) - sizes
    pairs = (touching + start for (_, touching), start in zip(seen, starts, strict=True))
    scale = Scale.of(rows)
    return Family(
        scale(rows),
        scale,
        np.repeat(np.arange(len(seen)), sizes),
        np.full(len(rows), UNTOLD),
        (),
        np.concatenate([np.zeros((0, 2), np.int64), *pairs]),
    )


def evenly(items: Ints, most: int) -> Ints:
    """Of very many some, evenly."""
    return items if len(items) <= most else items[np.arange(most) * len(items) // most]
