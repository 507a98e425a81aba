"""Under what labels and by which people families are signed off, and the families."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from benchmark.assets import SEPARATE
from benchmark.assets.storage import read, stem_of
from benchmark.study import CONDITIONS, FLAT, TRUE, Bench, open_bench
from benchmark.study.condition import PROPAGATED, SYSTEMATIC, TELLING
from benchmark.tasks import task

ERRS = CONDITIONS[f"{FLAT.name}: errs in 5%"]
"""The person errs in 5% of all acts."""
NONE = PROPAGATED[0]
ASKED = (TRUE, TELLING, FLAT, SYSTEMATIC, PROPAGATED[3], PROPAGATED[2], PROPAGATED[1], NONE, ERRS)
"""All conditions, in the order of the tables."""
MAKE = "script/make-benchmark --calibration --count 25 --settings separate --out FOLDER"
"""Makes families of 25 that anything may be tuned on."""


@lru_cache(maxsize=2 * len(SEPARATE))
def open_family(name: str, setting: str, folder: str | None = None) -> Bench:
    """A task with the reported family at one decomposition; or with one of those in a folder, to tune on."""
    if folder is None:
        return open_bench(name, setting)
    one = task(name)
    return Bench(one, [row for row in read(Path(folder), stem_of(one.category, True)) if row.setting == setting])
