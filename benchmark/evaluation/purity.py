"""How many hulls span parts, set by set and category by category."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from benchmark.assets import SETS, samples
from benchmark.report import Cell, Table
from benchmark.tasks.task import PURE

_COLUMNS = ("set", "category", "meshes", "hulls a mesh", "hulls that span parts, %")


@dataclass(frozen=True, slots=True)
class Impurity:
    """Counts of meshes, of their hulls, and of those of these that span parts."""

    meshes: int
    hulls: int
    impure: int

    @property
    def share(self) -> float:
        """Of all hulls those that span parts, %."""
        return 100 * self.impure / max(self.hulls, 1)


def count_impure(categories: Sequence[str], group: str, calibration: bool = False) -> Impurity:
    """The counts over some categories of a set of `SETS`."""
    rows = [row for name in categories for row in samples(name, calibration, SETS[group])]
    purities = [purity for row in rows for purity in row.purities]
    return Impurity(len(rows), len(purities), sum(purity < PURE for purity in purities))


def tell_different(categories: Sequence[str]) -> Table:
    """How many meshes each set has, and how many different ones; assets are drawn until their separate ones differ."""
    return Table("Different meshes", ("set", "meshes", "different"), tuple(_count_different(categories)))


def _count_different(categories: Sequence[str]) -> Iterator[tuple[Cell, ...]]:
    for group, settings in SETS.items():
        rows = [row.mesh for name in categories for row in samples(name, False, settings)]
        seen = {tuple(sorted(h.vertices[np.lexsort(h.vertices.T)].tobytes() for h in mesh.hulls)) for mesh in rows}
        yield group, len(rows), len(seen)


def tell_purity(categories: Sequence[str], calibration: bool = False) -> Table:
    """The counts of every set, category by category and in all."""
    return Table("Hulls that span parts, set by set", _COLUMNS, tuple(_rows(categories, calibration)))


def _rows(categories: Sequence[str], calibration: bool) -> Iterator[tuple[Cell, ...]]:
    for group in SETS:
        for about, names in (*((name, (name,)) for name in categories), ("all", tuple(categories))):
            found = count_impure(names, group, calibration)
            yield group, about, found.meshes, found.hulls / max(found.meshes, 1), found.share
