"""The meshes that labellers are tried on: drawn from all categories, none of which a person labelled for any of them.

A family is a category at one setting, so that no two of its meshes are of one asset.

    python -m benchmark.labels.families FOLDER [--sample N]

writes them as OBJ files with the labels that there are to choose from, for labellers that run elsewhere.
"""

from __future__ import annotations

import argparse
import atexit
from contextlib import ExitStack
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from benchmark.assets import CATEGORIES, SEPARATE, Sample, family
from benchmark.labels.project import LabelProject, open_label_project
from benchmark.tasks import task
from meshforge.common import UsageError, write_atomically
from meshforge.formats import save
from meshforge.label_model import FamilyModel
from meshforge.symbolic import Label, SymbolicMesh

LABELLED = 3
"""Meshes of each family that are labelled by hand at most, as advised."""
_SEED = 7


@dataclass(frozen=True, eq=False)
class Family:
    """A category at one setting, of which `count` meshes are drawn. vocabulary: what its hulls can be."""

    name: str
    setting: str
    count: int

    @property
    def samples(self) -> tuple[Sample, ...]:
        return family(self.name, self.setting)

    @property
    def vocabulary(self) -> tuple[str, ...]:
        return task(f"{self.name}-easy").program.labels

    @property
    def bare(self) -> tuple[SymbolicMesh, ...]:
        """The meshes without labels, as a labeller gets them."""
        return _bare(self.name, self.setting)

    @property
    def project(self) -> LabelProject:
        """A project of the meshes on disk, the same each time, that is gone when the process ends."""
        return _open(self.name, self.setting)

    @property
    def advised(self) -> tuple[int, ...]:
        """The meshes that a person labels who always takes the one that is advised, in this order."""
        return _advise(self.name, self.setting)

    @property
    def drawn(self) -> tuple[int, ...]:
        """The sample, without those that are advised; other assets at other settings, as far as there are."""
        every = np.random.default_rng([_SEED, *self.name.encode()]).permutation(len(self.samples))
        begin = SEPARATE.index(self.setting) * len(every) // len(SEPARATE)
        left = [place for place in np.roll(every, -begin).tolist() if place not in self.advised]
        return tuple(sorted(left[: self.count]))


def families(count: int, names: tuple[str, ...] = CATEGORIES, settings: tuple[str, ...] = SEPARATE) -> list[Family]:
    """The families of which as many meshes are drawn, evenly. Raises UsageError for more than there are, or none."""
    every = [(name, setting) for setting in settings for name in names]
    most = sum(len(family(*one)) - LABELLED for one in every)
    if not 1 <= count <= most:
        raise UsageError(f"a sample of {count} meshes cannot be drawn", remedy=f"Say 1 to {most}.")
    shares = [count // len(every) + (place < count % len(every)) for place in range(len(every))]
    return [Family(*one, share) for one, share in zip(every, shares, strict=True) if share]


@cache
def _bare(name: str, setting: str) -> tuple[SymbolicMesh, ...]:
    return tuple(sample.mesh.with_labels(dict.fromkeys(sample.mesh.index)) for sample in family(name, setting))


@cache
def _open(name: str, setting: str) -> LabelProject:
    rows, stack = family(name, setting), ExitStack()
    atexit.register(stack.close)
    meshes = [row.mesh for row in rows]
    project = stack.enter_context(open_label_project(name, [row.name for row in rows], meshes))
    project.propagate()  # which describes the meshes, and no more: there is no label yet
    return project


@cache
def _advise(name: str, setting: str) -> tuple[int, ...]:
    """By the model in memory, so that the sample, which is without them, stays what it was."""
    chosen, rows = list[int](), list(enumerate(family(name, setting)))
    model = FamilyModel(_bare(name, setting))
    while len(chosen) < LABELLED:
        said = [Label(str(hull.label)) if k in chosen else None for k, row in rows for hull in row.mesh.hulls]
        chosen += model.infer(said).next_to_label()
    return tuple(chosen)


def main(arguments: list[str] | None = None) -> None:
    """Write the sample."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.labels.families", description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--sample", type=int, default=200, metavar="N")
    given = parser.parse_args(arguments)
    for one in families(given.sample):
        for place in one.drawn:
            save(one.bare[place], given.folder / one.name / f"{one.samples[place].name}.obj", overwrite=True)
        write_atomically(given.folder / one.name / "vocabulary.txt", "\n".join(one.vocabulary) + "\n")


if __name__ == "__main__":
    main()
