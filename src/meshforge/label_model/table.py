"""The hulls of a family as a table of comparable rows, and what is said of their labels."""

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from importlib.resources import files

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats, Ints
from meshforge.label_model.describe import ROW_WIDTH
from meshforge.label_model.lookalikes import Lookalikes, LookalikeSearch
from meshforge.rendering import UNSURE
from meshforge.symbolic import CERTAIN_SOURCES, GIVEN_SOURCES, INFERRED_SOURCES, LABEL_SOURCES, Label

Bools = npt.NDArray[np.bool_]

METRIC_FILE = "metric.json"
NO_LABEL = -1
"""The code of a hull of whose label nothing is said."""
_LEAST_SPREAD = 1e-3  # spread of a column below which it counts as constant
_AT_ONCE = 16  # columns that are copied at a time
_MOST_SPREADS = 3.0  # spreads from the median beyond which nothing is farther


@cache
def read_weights(file: str) -> Floats:
    """Return fitted numbers, of which a file here each has some: of METRIC_FILE the weights (columns,) of the distance
    between rows, the weighted sum of their differences."""
    found = np.array(
        json.loads(files("meshforge.label_model").joinpath(file).read_text("utf-8"))["weights"], dtype=float
    )
    found.flags.writeable = False
    return found


@dataclass(frozen=True, eq=False, slots=True)
class ColumnScale:
    """What brings columns to a common spread. middle, spread: (columns,)."""

    middle: Floats
    spread: Floats

    @staticmethod
    def of(rows: Floats) -> "ColumnScale":
        """Return the medians and spreads of some rows (n, columns)."""
        if not len(rows):
            return ColumnScale(np.zeros(rows.shape[1]), np.ones(rows.shape[1]))
        some = [rows[:, start : start + _AT_ONCE] for start in range(0, rows.shape[1], _AT_ONCE)]
        middle = np.concatenate([np.median(columns, axis=0) for columns in some])
        return ColumnScale(middle, np.maximum(np.concatenate([one.std(axis=0) for one in some]), _LEAST_SPREAD))

    def __call__(self, rows: Floats, out: Floats | None = None) -> Floats:
        """Rows about the middle in units of the spread, far values drawn in; out: where they go, which may be rows."""
        found: Floats = np.subtract(rows, self.middle, out=out)
        found /= self.spread
        return np.clip(found, -_MOST_SPREADS, _MOST_SPREADS, out=found)


@dataclass(frozen=True, eq=False)
class FamilyTable:
    """Hulls of all meshes, in order.

    rows: (n, columns), described and brought to a common spread by `scale`; owner: (n,) the mesh of each, ascending;
    touching: pairs (m, 2) of hulls of one mesh that are in contact; metric: the weight of each column.
    """

    rows: Floats
    scale: ColumnScale
    owner: Ints
    touching: Ints
    metric: Floats

    @staticmethod
    def of(described: Sequence[tuple[Floats, Ints]], metric: Floats | None = None) -> "FamilyTable":
        """Return the table of `rows` and `touching` of each mesh; metric: None for the one that ships."""
        rows = np.concatenate([np.zeros((0, ROW_WIDTH)), *(own for own, _ in described)])
        sizes = np.array([len(own) for own, _ in described], dtype=np.int64)
        pairs = (touching + start for (_, touching), start in zip(described, np.cumsum(sizes) - sizes, strict=True))
        scale = ColumnScale.of(rows)
        return FamilyTable(
            scale(rows, out=rows),
            scale,
            np.repeat(np.arange(len(described)), sizes),
            np.concatenate([np.zeros((0, 2), np.int64), *pairs]),
            read_weights(METRIC_FILE) if metric is None else metric,
        )

    @cached_property
    def spans(self) -> dict[int, slice]:
        """Each mesh that has hulls, and which of all hulls these are."""
        meshes, starts = np.unique(self.owner, return_index=True)
        ends = np.searchsorted(self.owner, meshes, side="right")
        rows = zip(meshes.tolist(), starts.tolist(), ends.tolist(), strict=True)
        return {mesh: slice(start, end) for mesh, start, end in rows}

    @cached_property
    def _search(self) -> LookalikeSearch:
        return LookalikeSearch(self.rows, self.metric, self.owner)

    def find_lookalikes(self, seen: "Observations") -> Lookalikes:
        """Return the nearest hulls of each; of too many meshes, those with given labels are looked at."""
        which = seen.given if seen.given.any() else seen.known
        return self._search.find(np.unique(self.owner[which]).tolist())

    def turn(self, turned: Iterator[tuple[slice, Floats]]) -> "FamilyTable":
        """Return the table with other rows for some meshes."""
        rows = self.rows.copy()
        for span, found in turned:
            rows[span] = found
        return replace(self, rows=rows)


@dataclass(frozen=True, eq=False)
class Observations:
    """What is said of the labels of n hulls.

    labels: that anything says, and those of a vocabulary, sorted; codes: (n,) the place of what is said among these,
    NO_LABEL where nothing is; confidence: (n,); sources: (n,) the place of the source among LABEL_SOURCES; fixed: (n,)
    whether a person said or showed it; given: (n,) whether others may be taken from it.
    """

    labels: tuple[str, ...]
    codes: Ints
    confidence: Floats
    sources: Ints
    fixed: Bools
    given: Bools

    @staticmethod
    def of(observed: Sequence[Label | None], vocabulary: Sequence[str] = ()) -> "Observations":
        """Return what annotations of hulls say; a label that was inferred says nothing but what it was inferred over.

        vocabulary: labels that hulls may have though nothing says so yet.
        """
        evidence = [evidence_of(label) for label in observed]
        if not any(evidence):
            evidence = list(observed)
        given = {one.name for one in evidence if one}
        labels = tuple(sorted(given.union(vocabulary) if given else given))
        places = {label: place for place, label in enumerate(labels)}
        return Observations(
            labels,
            np.array([places[one.name] if one else NO_LABEL for one in evidence], dtype=np.int64),
            np.array([one.confidence if one else 0.0 for one in evidence]),
            np.array([LABEL_SOURCES.index(one.source) if one else 0 for one in evidence], dtype=np.int64),
            np.array([one is not None and one.source in CERTAIN_SOURCES for one in evidence], dtype=np.bool_),
            np.array([reference_label(one) is not None for one in evidence], dtype=np.bool_),
        )

    @property
    def known(self) -> Bools:
        """Whether anything is said (n,)."""
        found: Bools = self.codes != NO_LABEL
        return found

    @property
    def rebuilt(self) -> Bools:
        """Whether what is said follows from the rebuild of a body (n,)."""
        found: Bools = self.known & (self.sources == LABEL_SOURCES.index("rebuild"))
        return found


def evidence_of(label: Label | None) -> Label | None:
    """Return what a label says that was not inferred from other labels: that which it replaced, where it was."""
    if label is not None and label.source in INFERRED_SOURCES:
        return label.given
    return label


def evidence_beside_rebuilt(label: Label | None) -> Label | None:
    """Return the same but for labels of rebuilt bodies, which follow from others by the surface."""
    known = evidence_of(label)
    return None if known is None or known.source == "rebuild" else known


def reference_label(label: Label | None) -> str | None:
    """Return the label that others may be taken from: a person's, that of a step, or one of a file, if not unsure."""
    if label is None or label.source not in GIVEN_SOURCES | CERTAIN_SOURCES:
        return None
    return label.name if label.source in CERTAIN_SOURCES or label.confidence >= UNSURE else None
