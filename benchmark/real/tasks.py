"""The tasks of families of real assets: `FAMILY/{easy,medium,hard}/task.toml`, in the format of `benchmark/tasks`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache

from benchmark.assets import Sample
from benchmark.real.family import FOLDER, families, family
from benchmark.real.samples import ALL_SETTINGS, family_samples
from benchmark.tasks import DIFFICULTIES, Task, read_task


@cache
def real_task(family_name: str, difficulty: str) -> Task:
    """A task of a family, about its meshes at all settings."""
    return read_task(
        family(family_name).folder / difficulty,
        f"real-{family_name}-{difficulty}",
        lambda: tuple(sample for setting in ALL_SETTINGS for sample in family_samples(family_name, setting)),
    )


def tasks_of(family_name: str) -> list[Task]:
    """The tasks of a family, the easy one first."""
    there = [level for level in DIFFICULTIES if (FOLDER / family_name / level / "task.toml").is_file()]
    return [real_task(family_name, level) for level in there]


def real_tasks(names: Sequence[str] | None = None) -> Iterator[tuple[Task, str, tuple[Sample, ...]]]:
    """Every task of families at every setting, with the meshes of that setting; names: of families, all by default.

    Raises AssetError where the corpus is not here.
    """
    for name in families() if names is None else names:
        for task in tasks_of(name):
            for setting in ALL_SETTINGS:
                if samples := family_samples(name, setting):
                    yield task, setting, samples
