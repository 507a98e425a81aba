"""Hulls that look like some hulls, of the same meshes and of others, in steps from alike to hardly alike; what it costs
a person to label hulls so; and a few hulls of a family that all others look like."""

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats, Ints
from meshforge.label_model.lookalikes import MOST_MESHES
from meshforge.label_model.table import FamilyTable
from meshforge.label_model.ties import first_greatest, pick_evenly

Bools = npt.NDArray[np.bool_]

OWN_STEPS = (5.0, 7.0, 9.0, 11.0)
"""Distances within which hulls of one mesh count as alike. Of hulls within the first, 99 of 100 pairs have one label on
the bundled chairs, cups and tables; beyond the last, hardly any has."""
OTHER_STEPS = (8.0, 10.0, 12.0, np.inf)
"""The same of hulls of other meshes, which differ more; each must be nearer to the hulls than to what they are not."""

RADIUS = 6.0
"""The distance within which hulls are of one cluster. With truthful answers on exemplars (of 21 meshes, 12 hulls each
at most) 0.983 of the labels of the bundled tables are right after propagation, and 0.956 to 1 on 24 families of the
benchmark. One exemplar for each of 20 clusters makes at most 0.93 right on the tables."""
THINK, CLICK, KEY, LOOK = 1.35, 1.3, 0.28, 0.5
"""Seconds of a person for a thought, for pointing and clicking, for a key (keystroke-level model, Card, Moran and
Newell 1980), and for a look at one hull of a group of look-alikes."""
ROUND = 8.0
"""What each asset costs besides [s], to propagate its labels and look what became of the others. Of 0, 8, 15 and 30 s
with this real families of 5 to 13 assets take least, and on generated ones two assets as advised make 0.94 right."""
_MOST_CLUSTERS = 252  # of more, those that hulls are farthest from are found first


def find_similar(table: FamilyTable, hulls: Ints, excluded: Bools, others: Ints | None, step: int) -> tuple[Ints, int]:
    """Return the hulls that look like some of them, these included, in ascending order; and the step that this took.

    A hull of the same mesh is taken where a chain of hulls leads to it, each near to the next. One of another mesh is
    taken where it is nearer to what was taken of the first meshes than to the rest of these, and within the step.

    hulls: places in the table; excluded: (n,) which are never taken; others: meshes to look in besides those of the
    hulls, None for none; step: from 0 on, a place in `OWN_STEPS`, or in `OTHER_STEPS` where there are other meshes.
    Steps that add nothing to the one before are passed over.
    """
    steps = range(len(OWN_STEPS if others is None else OTHER_STEPS))
    step = min(max(step, 0), len(steps) - 1)
    before = hulls if step == 0 else _find(table, hulls, excluded, others, step - 1)
    found = _find(table, hulls, excluded, others, step)
    while len(found) == len(before) and step + 1 < len(steps):
        step += 1
        found = _find(table, hulls, excluded, others, step)
    return found, step


def _find(table: FamilyTable, hulls: Ints, excluded: Bools, others: Ints | None, step: int) -> Ints:
    own = _chain(table, hulls, excluded, OWN_STEPS[step if others is None else 0])
    if others is None:
        return own
    homes = np.unique(table.owner[hulls])
    taken = np.zeros(len(table.owner), dtype=np.bool_)
    taken[own] = True
    rest = np.flatnonzero((np.isin(table.owner, homes) & ~taken) | excluded)
    some = np.flatnonzero(np.isin(table.owner, np.setdiff1d(others, homes)) & ~excluded)
    near = _least(table, some, own)
    found = some[(near < _least(table, some, rest)) & (near <= OTHER_STEPS[step])]
    return np.union1d(own, _chain(table, found, excluded, OWN_STEPS[0]))


def _chain(table: FamilyTable, hulls: Ints, excluded: Bools, most: float) -> Ints:
    """Hulls with those of the same meshes that a chain leads to whose links are at most so long."""
    from scipy.spatial.distance import cdist  # lazy: 0.5 s, half of all imports

    found = [np.zeros(0, dtype=np.int64)]
    for mesh in np.unique(table.owner[hulls]).tolist():
        span = table.spans[mesh]
        rows = table.rows[span] * table.metric
        linked = (cdist(rows, rows, "cityblock") <= most) & ~excluded[span][None, :]
        reached, wider = None, np.isin(np.arange(span.start, span.stop), hulls)
        while reached is None or (wider != reached).any():
            reached, wider = wider, wider | linked[wider].any(axis=0)
        found.append(np.flatnonzero(reached) + span.start)
    return np.concatenate(found)


def _least(table: FamilyTable, hulls: Ints, to: Ints) -> Floats:
    """The distance of each of some hulls to the nearest of others, infinite where there is none."""
    from scipy.spatial.distance import cdist  # lazy: as above

    if not len(to) or not len(hulls):
        return np.full(len(hulls), np.inf)
    gaps: Floats = cdist(table.rows[hulls] * table.metric, table.rows[to] * table.metric, "cityblock")
    nearest: Floats = gaps.min(axis=1)
    return nearest


def estimate_seconds(table: FamilyTable, hulls: Ints) -> float:
    """Return how long a person takes to open a mesh, label some of its hulls, and propagate that [s]: for each group
    that look alike a click, the key that selects them all and that of the label; and a look at each hull."""
    from scipy.sparse.csgraph import connected_components  # lazy: 0.5 s, half of all imports
    from scipy.spatial.distance import cdist  # lazy: as above

    rows = table.rows[hulls] * table.metric
    groups, _ = connected_components(cdist(rows, rows, "cityblock") <= OWN_STEPS[0], directed=False)
    return ROUND + THINK + CLICK + groups * (CLICK + 2 * KEY) + LOOK * len(hulls)


def choose_exemplars(table: FamilyTable, meshes: int, hulls: int) -> dict[int, list[int]]:
    """Return places of hulls that show as many clusters of hulls as possible, by mesh, those that show most first.

    meshes, hulls: at most so many meshes, and hulls of each. Of very many meshes those are looked at that always
    are when labels are propagated. Labels do not matter.
    """
    if not len(table.owner):
        return {}
    looked = np.flatnonzero(np.isin(table.owner, pick_evenly(np.unique(table.owner), MOST_MESHES)))
    apart = _measure_clusters(table.rows[looked] * table.metric)
    owner, cluster, found = table.owner[looked], apart.argmin(axis=1), dict[int, list[int]]()
    left = np.bincount(cluster, minlength=apart.shape[1])
    shows = np.zeros((int(owner.max()) + 1, len(left)), dtype=np.bool_)
    shows[owner, cluster] = True
    while (shows & (left > 0)).any() and len(found) < meshes:
        mesh = int(first_greatest((shows * np.sqrt(left)).sum(axis=1)))
        shown = [one for one in np.argsort(-left, kind="stable").tolist() if shows[mesh, one] and left[one]][:hulls]
        members = (np.flatnonzero((owner == mesh) & (cluster == one)) for one in shown)
        nearest = [own[first_greatest(-apart[own, one])] for own, one in zip(members, shown, strict=True)]
        found[mesh] = sorted(looked[nearest].tolist())
        left[shown], shows[mesh] = 0, False
    return found


def _measure_clusters(rows: Floats) -> Floats:
    """The distances (n, clusters) of hulls to the centres of clusters, each the hull that is farthest from those before
    (farthest-first traversal, Gonzalez 1985); the first is the one that is nearest the middle."""
    from scipy.spatial.distance import cdist  # lazy: as above

    found = np.zeros((len(rows), 0))
    farness = -np.abs(rows - np.median(rows, axis=0)).sum(axis=1)
    while found.shape[1] < min(_MOST_CLUSTERS, len(rows)) and not (found.size and farness.max() <= RADIUS):
        center = rows[[int(first_greatest(farness))]]
        found = np.concatenate([found, cdist(rows, center, "cityblock")], axis=1)
        farness = found.min(axis=1)
    return found
