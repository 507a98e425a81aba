"""Families that the posterior over labels is fitted on: 25 assets of one generator, and small ones whose assets differ
as much as those of real families do."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from pathlib import Path

import numpy as np
from scipy.spatial.distance import cdist

from benchmark.assets import SEPARATE, Sample, family
from benchmark.assets.storage import read, stem_of
from meshforge.label_model import FamilyModel

FOLDS = (("cup", "kettle", "chair", "table"), ("knife", "dispenser", "door", "lamp"))
"""The categories in two halves: what is fitted on one is tried on the other."""
FULL, SMALL, MIXED, CROSSED = "25 alike", "8 alike", "8 that differ", "10 of two categories"
"""Assets of one category at one decomposition; of one category, those chosen that differ most, each at any
decomposition; and so of two categories, which have some names of parts in common."""
_DRAWS = 2  # families of those that differ, from different beginnings
_FEW, _MORE = 8, 10


def draw_families(folder: Path, fold: Sequence[str]) -> Iterator[tuple[str, list[Sample]]]:
    """The kind of each family, and its meshes. folder: where the families of 25 are."""
    small = {name: [row for setting in SEPARATE for row in family(name, setting, True)] for name in fold}
    for name in fold:
        every = list(read(folder, stem_of(name, True)))
        for setting in SEPARATE:
            yield FULL, [row for row in every if row.setting == setting]
            yield SMALL, [row for row in small[name] if row.setting == setting]
        for draw in range(_DRAWS):
            yield MIXED, choose_differing(small[name], _FEW, draw)
    for one, other in combinations(fold, 2):
        for draw in range(_DRAWS):
            yield CROSSED, choose_differing(small[one] + small[other], _MORE, draw)


def choose_differing(rows: Sequence[Sample], count: int, seed: int) -> list[Sample]:
    """Meshes of different assets, each as unlike those before it as can be; the first is drawn."""
    table = FamilyModel([row.mesh for row in rows]).table
    hulls = [table.rows[table.spans[place]] * table.metric for place in range(len(rows))]
    gaps = np.zeros((len(rows), len(rows)))
    for one, other in combinations(range(len(rows)), 2):
        apart = cdist(hulls[one], hulls[other], "cityblock")
        gaps[one, other] = gaps[other, one] = (apart.min(axis=0).mean() + apart.min(axis=1).mean()) / 2
    chosen = [int(np.random.default_rng(seed).integers(len(rows)))]
    while len(chosen) < count:
        taken = {rows[place].asset.name for place in chosen}
        left = [place for place, row in enumerate(rows) if row.asset.name not in taken]
        chosen.append(max(left, key=lambda place: float(gaps[place, chosen].min())))
    return [rows[place] for place in sorted(chosen)]
