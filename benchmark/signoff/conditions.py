"""Under what labels and by which people families are signed off, and the families."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import Path

from benchmark.assets import SEPARATE
from benchmark.assets.storage import read, stem_of
from benchmark.evaluation.real_sessions import LEAST, TAUGHT
from benchmark.real.family import families
from benchmark.real.samples import ALL_SETTINGS, family_samples
from benchmark.real.tasks import real_task
from benchmark.study import CONDITIONS, FLAT, REPORTED, TRUE, TUNING, Bench, Condition, open_bench
from benchmark.study.condition import PROPAGATED, SYSTEMATIC, TELLING
from benchmark.tasks import DIFFICULTIES, task, tasks

ERRS = CONDITIONS[f"{FLAT.name}: errs in 5%"]
"""The person errs in 5% of all acts."""
NONE = PROPAGATED[0]
ASKED = (TRUE, TELLING, FLAT, SYSTEMATIC, PROPAGATED[2], NONE, ERRS)
"""All conditions, in the order of the tables."""
PEOPLE = len(SEPARATE)
"""Who signs generated families off: one for each decomposition."""
ON_REAL = (*TAUGHT, NONE)
"""Those under which real families are signed off."""
MAKE = "script/make-benchmark --calibration --count 25 --settings separate --out FOLDER"
"""Makes families of 25 that anything may be tuned on."""
_REAL = "real-"


def list_tasks() -> list[str]:
    """The tasks on generated families."""
    return [one.name for one in tasks()]


def list_real_tasks() -> list[str]:
    """The tasks on real families."""
    return [f"{_REAL}{name}-{level}" for name in families() for level in DIFFICULTIES]


def list_benches(
    name: str, condition: Condition, folder: str | None = None, few: bool = False
) -> Iterator[tuple[int, Bench]]:
    """The families of a task, each with its person. few: one of them; folder: of families to tune on.

    Of a real family one for each decomposition at which there are enough meshes.
    """
    for seed in list_people(name, condition, folder)[: 1 if few else None]:
        bench = open_bench_of(name, condition, seed, folder)
        if not name.startswith(_REAL) or len(bench.samples) >= LEAST:
            yield seed, bench


def list_people(name: str, condition: Condition, folder: str | None = None) -> Sequence[int]:
    """The seeds of those who sign a task's families off, one for each decomposition."""
    if name.startswith(_REAL):
        return REPORTED[: len(ALL_SETTINGS)]
    return condition.seeds(REPORTED if folder is None else TUNING)[:PEOPLE]


def open_bench_of(name: str, condition: Condition, seed: int, folder: str | None = None) -> Bench:
    """A task with the family that a person gets."""
    if name.startswith(_REAL):
        return open_real_family(name, ALL_SETTINGS[REPORTED.index(seed)])
    return open_family(name, condition.setting(seed), folder)


@lru_cache(maxsize=2 * len(SEPARATE))
def open_family(name: str, setting: str, folder: str | None = None) -> Bench:
    """A task with the reported family at one decomposition; or with one of those in a folder, to tune on."""
    if folder is None:
        return open_bench(name, setting)
    one = task(name)
    return Bench(one, [row for row in read(Path(folder), stem_of(one.category, True)) if row.setting == setting])


@lru_cache(maxsize=2 * len(ALL_SETTINGS))
def open_real_family(name: str, setting: str) -> Bench:
    """A task with a real family at one decomposition."""
    family_name, _, level = name.removeprefix(_REAL).rpartition("-")
    return Bench(real_task(family_name, level), family_samples(family_name, setting))
