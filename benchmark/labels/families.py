"""The meshes that labellers are tried on: drawn from all categories, none of which a person labelled for any of them.

    python -m benchmark.labels.families FOLDER [--sample N]

writes them as OBJ files with the labels that there are to choose from, for labellers that run elsewhere.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

import numpy as np

from benchmark.assets import CATEGORIES, Sample, samples
from benchmark.tasks import task
from meshforge.common import UsageError, write_atomically
from meshforge.formats import save
from meshforge.labels import Propagator
from meshforge.symbolic import SymbolicMesh

LABELLED = 3
"""Meshes of each category that are labelled by hand at most, as advised."""
_SEED = 7


@dataclass(frozen=True, eq=False)
class Family:
    """A category of which `count` meshes are drawn. vocabulary: what its hulls can be."""

    name: str
    count: int

    @property
    def samples(self) -> tuple[Sample, ...]:
        return samples(self.name)

    @property
    def vocabulary(self) -> tuple[str, ...]:
        return task(f"{self.name}-easy").program.labels

    @property
    def bare(self) -> tuple[SymbolicMesh, ...]:
        """The meshes without labels, as a labeller gets them."""
        return _bare(self.name)

    @property
    def relatives(self) -> Propagator:
        """The meshes as propagation sees them."""
        return _relatives(self.name)

    @property
    def advised(self) -> tuple[int, ...]:
        """The meshes that a person labels who always takes the one that is advised, in this order."""
        return _advise(self.name)

    def labels_of(self, meshes: Sequence[int]) -> list[str | None]:
        """The labels of all hulls of some meshes, None for all others."""
        return _labels_of(self.name, meshes)

    @cached_property
    def drawn(self) -> tuple[int, ...]:
        """The sample: a mesh of each asset before a second one of any; those that are advised are left out."""
        draw = np.random.default_rng([_SEED, *self.name.encode()])
        seen, order = dict[str, int](), list[tuple[int, int]]()
        for place in draw.permutation(len(self.samples)).tolist():
            if place not in self.advised:
                asset = self.samples[place].asset.name
                seen[asset] = seen.get(asset, 0) + 1
                order.append((seen[asset], place))
        order.sort(key=lambda row: row[0])
        return tuple(sorted(place for _, place in order[: self.count]))


def families(count: int, names: tuple[str, ...] = CATEGORIES) -> list[Family]:
    """The categories of which as many meshes are drawn, evenly. Raises UsageError for more than there are, or none."""
    most = sum(len(samples(name)) - LABELLED for name in names)
    if not 1 <= count <= most:
        raise UsageError(f"a sample of {count} meshes cannot be drawn", remedy=f"Say 1 to {most}.")
    shares = [count // len(names) + (place < count % len(names)) for place in range(len(names))]
    return [Family(name, share) for name, share in zip(names, shares, strict=True) if share]


@cache
def _bare(name: str) -> tuple[SymbolicMesh, ...]:
    return tuple(sample.mesh.with_labels(dict.fromkeys(sample.mesh.index)) for sample in samples(name))


@cache
def _relatives(name: str) -> Propagator:
    return Propagator(_bare(name))


@cache
def _advise(name: str) -> tuple[int, ...]:
    chosen = list[int]()
    while len(chosen) < LABELLED:
        chosen += _relatives(name).propagate(_labels_of(name, chosen)).next_to_label()
    return tuple(chosen)


def _labels_of(name: str, meshes: Sequence[int]) -> list[str | None]:
    rows = enumerate(sample.mesh for sample in samples(name))
    return [hull.label if place in meshes else None for place, mesh in rows for hull in mesh.hulls]


def main(arguments: list[str] | None = None) -> None:
    """Write the sample."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.labels.families", description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--sample", type=int, default=200, metavar="N")
    given = parser.parse_args(arguments)
    for family in families(given.sample):
        for place in family.drawn:
            save(family.bare[place], given.folder / family.name / f"{family.samples[place].name}.obj", overwrite=True)
        write_atomically(given.folder / family.name / "vocabulary.txt", "\n".join(family.vocabulary) + "\n")


if __name__ == "__main__":
    main()
