"""What finding hulls that span costs: fine decompositions on one core, and inference."""

from __future__ import annotations

import os
import resource
import statistics
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import Any

from benchmark.assets import MERGED, Sample, samples
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.spanning.course import FamilyOutcome, judge_families
from benchmark.spanning.detection import categories_of
from benchmark.spanning.family import BY_PIECES, choose_known
from benchmark.spanning.sets import surface_of
from meshforge.geometry import decompose_finely

_DECOMPOSE = 3.0  # seconds to reach
_COLUMNS = ("set", "category", "asset", "triangles of its parts", "pieces", "s of the processor", "s")
_INFERENCE_COLUMNS = ("set", "a family's inference, median s", "slowest s")


def measure(tell: Tell, quick: bool) -> Result:
    """Decompose the labelled assets of each family finely, without a cache, one after the other on one core."""
    families = judge_families(tell, quick)
    assets = [
        sample for name in categories_of(families) for setting in MERGED for sample in _choose(name, setting, quick)
    ]
    rows = list[tuple[Cell, ...]]()
    with _one_core():
        for sample in assets:
            tell(f"costs: {sample.name}")
            pieces, spent, passed = _time(partial(decompose_finely, *surface_of(sample)))
            size = sum(part.solid.num_tri() for part in sample.asset.parts)
            rows.append((sample.setting, sample.asset.category, sample.asset.name, size, len(pieces), spent, passed))
    return Result(
        "costs",
        "Hulls that span parts: costs",
        (
            Table("Fine decomposition on one core, no cache", _COLUMNS, tuple(rows)),
            Table("Inference, on one core", _INFERENCE_COLUMNS, tuple(_list_inference(families))),
        ),
        (Goal("fine decomposition of an asset, median s", "at most", _DECOMPOSE, _median([row[-1] for row in rows])),),
        (
            "Decomposed are the assets of a family that a person labels, elsewhere all is read from a cache. *s*: from "
            "start to end, with one core, from a surface that is welded already; *s of the processor*: of this process "
            "and of CoACD's. Inference is in seconds of the processor, while other families take the other "
            "cores.",
        ),
    )


def _choose(category: str, setting: str, quick: bool) -> list[Sample]:
    rows = samples(category, False, (setting,))
    return [rows[place] for place in sorted(choose_known(len(rows)))[: 1 if quick else None]]


def _list_inference(families: Sequence[FamilyOutcome]) -> Iterator[tuple[Cell, ...]]:
    for setting in MERGED:
        inference = [one.seconds for one in families if (one.setting, one.labelled) == (setting, BY_PIECES)]
        yield setting, _median(inference), max(inference)


def _median(values: Sequence[Any]) -> float:
    return float(statistics.median(values))


def _time(run: Callable[[], Any]) -> tuple[Any, float, float]:
    """What a run gives, its seconds of the processor with those of the processes that it starts, and those of a
    clock."""
    started, spent = time.perf_counter(), _count_seconds()
    found = run()
    return found, _count_seconds() - spent, time.perf_counter() - started


def _count_seconds() -> float:
    return sum(
        usage.ru_utime + usage.ru_stime
        for usage in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    )


@contextmanager
def _one_core() -> Iterator[None]:
    """This process, and those that it starts, have one core alone; where the system cannot do that, all."""
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(before)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)
