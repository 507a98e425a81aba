"""Labels of a few meshes propagated to all others: meshes that lie on their side are set upright, hulls compared,
and the mesh to label next is chosen."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from importlib.resources import files

import numpy as np
from scipy.spatial.distance import cdist

from meshforge import label_model
from meshforge.geometry import Floats, Ints
from meshforge.label_model import NO_LABEL, FamilyTable, first_greatest, greatest_first, pick_evenly
from meshforge.labels.propagation.describe import ROW_WIDTH, SHAPE_COLUMNS, MeshDescriber
from meshforge.symbolic import Label, SymbolicMesh

METRIC_FILE = "metric.json"

_CLOSE = 2  # of the sides of a mesh that are looked at closely, those under which the hulls themselves are most like
_BETTER = 0.9  # of the distance as it seems to lie, under which another side must be
_MOST_ROWS = 3000  # hulls at most, evenly chosen

_HULLS, _MESHES = 3000, 2000  # that are compared at most, evenly chosen of more
_NEAR = 0.35  # of the median distance of hulls, within which they stand for each other
_AT_LEAST = 0.1  # what a hull counts whose label is certain; one about which nothing is known counts so much and one

_DIGITS = 3
_REMEMBERED = 2000  # meshes whose other sides are not described again


@cache
def metric_weights() -> Floats:
    """The weights (columns,) of the distance between two rows, which is the weighted sum of their differences."""
    read = json.loads(files("meshforge.labels.propagation").joinpath(METRIC_FILE).read_text("utf-8"))
    found = np.array(read["weights"], dtype=float)
    found.flags.writeable = False
    return found


def find_doubtful_sides(
    family: FamilyTable, sides: Callable[[int], Floats], metric: Floats
) -> Iterator[tuple[int, tuple[int, ...]]]:
    """Each mesh without a labelled hull, and on which other sides it has to be looked at closely, none or some.

    sides: `ShapeDescriptor.sides` of the mesh of that number; metric: the weight of each column of a row.
    """
    if not len(family.labelled):
        return
    labelled_rows, scale = _rows_with_labels(family, metric)[:, SHAPE_COLUMNS], family.scale.of_columns(SHAPE_COLUMNS)

    def apart(shapes: Floats) -> float:
        return _mean_distance(shapes * metric[SHAPE_COLUMNS], labelled_rows)

    for mesh, span in _spans_of(family):
        if (family.codes[span] != NO_LABEL).any():
            continue
        likeness = [apart(scale(found)) for found in sides(mesh)]
        seems = apart(family.rows[span, SHAPE_COLUMNS])
        order = greatest_first(-np.array(likeness))
        yield mesh, tuple([side for side in order if likeness[side] < seems - label_model.EQUAL][:_CLOSE])


def correct_upright(family: FamilyTable, closer: Iterable[tuple[int, Sequence[Floats]]], metric: Floats) -> FamilyTable:
    """The family with those meshes turned whose hulls are then clearly more like the labelled hulls.

    closer: meshes, each with its rows on those sides that `find_doubtful_sides` names.
    """
    labelled_rows, rows, spans = _rows_with_labels(family, metric), family.rows, dict(_spans_of(family))
    turned = rows.copy()

    def apart(found: Floats) -> float:
        """The mean distance of hulls from the labelled ones."""
        return _mean_distance(found * metric, labelled_rows)

    for mesh, sides in closer:
        span = spans[mesh]
        found = [family.scale(side) for side in sides]
        order = greatest_first(np.array([-apart(side) for side in found]))
        if order and apart(found[order[0]]) < _BETTER * apart(rows[span]):
            turned[span] = found[order[0]]
    return replace(family, rows=turned)


def _rows_with_labels(family: FamilyTable, metric: Floats) -> Floats:
    return family.rows[pick_evenly(family.labelled, _MOST_ROWS)] * metric


def _spans_of(family: FamilyTable) -> Iterator[tuple[int, slice]]:
    """Each mesh that has hulls, and which of all hulls these are."""
    meshes, starts = np.unique(family.owner, return_index=True)
    ends = np.searchsorted(family.owner, meshes, side="right")
    for mesh, start, end in zip(meshes.tolist(), starts.tolist(), ends.tolist(), strict=True):
        yield mesh, slice(start, end)


def _mean_distance(rows: Floats, labelled_rows: Floats) -> float:
    return float(cdist(rows, labelled_rows, "cityblock").min(axis=1).mean())


def choose_next(family: FamilyTable, chances: Floats, count: int) -> list[int]:
    """The meshes to label next, the best first; those whose hulls all have labels are not among them.

    chances: of the labels of each hull (hulls, labels).
    """
    open_meshes = pick_evenly(np.unique(family.owner[family.codes == NO_LABEL]), _MESHES)
    rows = family.rows[:, SHAPE_COLUMNS]
    compared = pick_evenly(np.arange(len(rows)), _HULLS)
    some, doubt = rows[compared], 1 + _AT_LEAST - chances[compared].max(axis=1, initial=0.0)
    if not len(open_meshes):
        return []
    near = max(float(np.median(cdist(some, some))) * _NEAR, 1e-9)

    def alike(hulls: Ints) -> Floats:
        """How much the best of some hulls is like each that is compared."""
        found: Floats = np.exp(-((cdist(rows[hulls], some) / near) ** 2) / 2).max(axis=0, initial=0.0)
        return found

    covered = alike(pick_evenly(family.labelled, _HULLS))
    starts = np.searchsorted(family.owner, open_meshes)
    ends = np.searchsorted(family.owner, open_meshes, side="right")
    stands = np.stack([alike(np.arange(start, end)) for start, end in zip(starts, ends, strict=True)])
    found: list[int] = []
    for _ in range(min(count, len(open_meshes))):
        gains = (np.maximum(stands - covered, 0.0) * doubt).sum(axis=1)
        gains[found] = -1.0
        found.append(int(first_greatest(gains)))
        covered = np.maximum(covered, stands[found[-1]])
    return [int(open_meshes[place]) for place in found]


@dataclass(frozen=True, eq=False)
class FamilyPosterior:
    """What some labels say about all hulls. chances: (hulls of all meshes, labels of the family)."""

    family: FamilyTable
    chances: Floats

    def labels(self, mesh: int) -> list[Label | None]:
        """The likeliest label of each hull of a mesh, with its chance; None where no label is known at all."""
        rows = self.chances[slice(*np.searchsorted(self.family.owner, (mesh, mesh + 1)))]
        if not self.family.labels:
            return [None] * len(rows)
        found = zip(first_greatest(rows).tolist(), rows, strict=True)
        return [
            Label(self.family.labels[place], round(float(row[place]), _DIGITS), "propagated") for place, row in found
        ]

    def next_to_label(self, count: int = 1) -> list[int]:
        """The meshes to label next, the most helpful first; none whose hulls all have labels."""
        return choose_next(self.family, self.chances, count)


class Propagator:
    """Meshes of one kind, described once; labels can then be propagated again and again."""

    def __init__(self, meshes: Sequence[SymbolicMesh]) -> None:
        descriptors = [MeshDescriber(mesh).describe() for mesh in meshes]
        self.family = build_family([(descriptor.rows, descriptor.touching) for descriptor in descriptors])
        self._sides = [descriptor.sides for descriptor in descriptors]
        self._closely = lru_cache(_REMEMBERED)(lambda mesh: cache(MeshDescriber(meshes[mesh]).describe_side))

    def propagate(self, labels: Sequence[str | None], metric: Floats | None = None) -> FamilyPosterior:
        """What some labels say about all hulls, these included.

        labels: of each hull of all meshes, None where it is not known; metric: the weight of each column of a
        description, None for the one that ships.
        """
        metric = metric_weights() if metric is None else metric
        family = self.family.with_labels(labels)
        doubtful = find_doubtful_sides(family, self._sides.__getitem__, metric)
        closer = ((mesh, [self._closely(mesh)(side) for side in sides]) for mesh, sides in doubtful)
        return compute_posterior(correct_upright(family, closer, metric), metric)


def compute_posterior(family: FamilyTable, metric: Floats | None = None) -> FamilyPosterior:
    """What known labels say about all hulls of a family whose meshes stand upright."""
    if not family.labels:
        return FamilyPosterior(family, np.zeros((len(family.codes), 0)))
    votes = label_model.vote_by_similarity(family, metric_weights() if metric is None else metric)
    return FamilyPosterior(family, label_model.refine_by_neighbors(family, votes))


def propagate(meshes: Sequence[SymbolicMesh]) -> FamilyPosterior:
    """What the labels that people gave, or that came in files, say about all hulls of a family, these included.

    The same family in the same order gives the same, bit for bit, on any processor. Meshes may lie anyhow about the
    upright axis of their files, at any size and place, tilted by up to some 40 degrees, or on their side.
    """
    return Propagator(meshes).propagate(
        [label_model.reference_label(hull.annotation) for mesh in meshes for hull in mesh.hulls]
    )


def build_family(seen: Sequence[tuple[Floats, Ints]]) -> FamilyTable:
    """A family without any label yet; seen: `rows` and `touching` of the descriptor of each mesh."""
    rows = np.concatenate([np.zeros((0, ROW_WIDTH)), *(own for own, _ in seen)])
    sizes = np.array([len(own) for own, _ in seen], dtype=np.int64)
    pairs = (touching + start for (_, touching), start in zip(seen, np.cumsum(sizes) - sizes, strict=True))
    scale = label_model.ColumnScale.of(rows)
    return FamilyTable(
        scale(rows),
        scale,
        np.repeat(np.arange(len(seen)), sizes),
        np.full(len(rows), NO_LABEL),
        (),
        np.concatenate([np.zeros((0, 2), np.int64), *pairs]),
    )
