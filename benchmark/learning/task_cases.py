"""The rules of the 24 tasks as problems of their own; the fit of beliefs has them on the calibration set only."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator
from functools import lru_cache
from itertools import product

from benchmark.assets import SEPARATE
from benchmark.learning.cases import Case
from benchmark.study import Bench
from benchmark.study.condition import KIND
from benchmark.study.person import Person
from benchmark.tasks import tasks
from meshforge.language import select_mask

QUICK = "cup"
"""The category of a quick run."""


def task_cases(
    seeds: Iterable[int], counts: Iterable[int], only: str | None = None, calibration: bool = True
) -> Iterator[Case]:
    """Each rule of each task, shown as demonstrators of these seeds do: first a mesh that shows most, then any.

    Each demonstrator has a family of its own, all assets at one setting: coarse, medium and fine by turns.
    calibration: on the calibration set, else on the 600 meshes.
    """
    for one in tasks():
        if only in (None, one.category):
            yield from _of_task(one.name, tuple(seeds), tuple(counts), calibration)


@lru_cache(maxsize=1)
def _of_task(name: str, seeds: tuple[int, ...], counts: tuple[int, ...], calibration: bool) -> tuple[Case, ...]:
    one = next(row for row in tasks() if row.name == name)
    desk = Bench(one, one.samples(calibration)).truth
    able = [mesh for mesh, done in desk.reference.items() if done is not None]
    found = []
    for (place, rule), seed in product(enumerate(one.program.rules), seeds):
        setting = SEPARATE[seed % len(SEPARATE)]
        names = [mesh for mesh in able if desk.bench.samples[mesh].setting == setting]
        meshes = tuple(desk.mesh_before(mesh, place) for mesh in names)
        assert all(mesh.contacts is not None for mesh in meshes)
        masks = tuple(select_mask(rule.extractor, mesh) for mesh in meshes)
        first = names.index(Person(desk, seed, KIND).begins_with(names, desk.propose))
        rest = [k for k in range(len(names)) if k != first]
        for count in counts:
            shown = (first, *random.Random(f"{seed} {name} {place}").sample(rest, count - 1))
            if any(masks[k] for k in shown):
                found.append(Case(name, rule.extractor, one.program.labels, meshes, masks, shown))
    return tuple(found)
