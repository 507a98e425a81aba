"""How long the posterior of a family takes, at first and after one more answer, and how much memory."""

from __future__ import annotations

import os
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from benchmark.assets import samples
from benchmark.report import Goal, Result, Table, Tell
from benchmark.speed.watch import look
from meshforge.batch import ExecutionOptions, WorkerFailure, run_isolated
from meshforge.common import MeshForgeError
from meshforge.geometry import Floats, Ints
from meshforge.label_model import FamilyModel, FamilyPosterior, FamilyTable, Observations
from meshforge.label_model.describe import describe_mesh
from meshforge.symbolic import Label

_KIND = "table"
_MESHES, _MADE, _LARGEST = 75, 1000, 10_000
_HULLS = 24  # of each mesh that is made
_DESCRIBED = 50  # meshes that others are made from
_NOISE = 0.05  # of each number of a row, as a share
_WRONG, _SILENT = 0.08, 0.1  # shares of hulls with a wrong label, and of those of which nothing is said
_ANSWERS = 9
_GIB = 2.0**30
_NOTES = (
    f"{_MESHES} meshes are those of the benchmark's category *{_KIND}*; of more, each takes {_HULLS} rows of one of "
    f"{_DESCRIBED} described meshes of it, every number {_NOISE:.0%} off or so. {_WRONG:.0%} of the labels are wrong, "
    f"{_SILENT:.0%} of the hulls have none. Describing meshes is not counted.",
    f"Each answer is a person's, on a hull of a mesh of which no person said anything; of {_MESHES} meshes *one more* "
    f"is the median of {_ANSWERS}. Those that are made are not compared as they would lie on another side, and get one "
    "answer, after which all look-alikes are looked for again, since the mesh that got it is among those looked at. "
    "Memory is the peak of the process, all libraries and the descriptions included.",
)


@dataclass(frozen=True, slots=True)
class Cost:
    """meshes, hulls: of the family; start: seconds at first; cpu: those of all processors; first, again: after the
    first answer, and one more; memory: peak of the process [bytes]."""

    meshes: int
    hulls: int
    start: float
    cpu: float
    first: float
    again: float
    memory: int


def measure(tell: Tell, quick: bool) -> Result:
    """Infer families of three sizes, each in a process of its own."""
    found = list[Cost]()
    alone = ExecutionOptions(1, None)
    for count in (_MESHES,) if quick else (_MESHES, _MADE, _LARGEST):
        (cost,) = run_isolated(_measure_real if count == _MESHES else _measure_made, [count], alone)
        if isinstance(cost, WorkerFailure):
            raise MeshForgeError(f"the posterior of {count:,} meshes: {cost.why}")
        tell(f"{cost.meshes:,} meshes: {cost.start:.2f} s, after one more answer {cost.again:.2f} s")
        found.append(cost)
    columns = (
        "meshes",
        "hulls",
        "at first [s]",
        "of all processors [s]",
        "a first answer [s]",
        "one more [s]",
        "memory [GiB]",
    )
    rows = [(one.meshes, one.hulls, one.start, one.cpu, one.first, one.again, one.memory / _GIB) for one in found]
    goals = [Goal(f"{_MESHES} meshes, after one more answer [s]", "at most", 0.2, found[0].again)]
    if not quick:
        goals.append(Goal(f"{_LARGEST:,} meshes [s]", "at most", 60.0, found[-1].start))
        goals.append(Goal(f"{_LARGEST:,} meshes, after one more answer [s]", "at most", 1.0, found[-1].again))
        goals.append(Goal(f"{_LARGEST:,} meshes, memory [GiB]", "at most", 1.0, found[-1].memory / _GIB))
    table = Table("The posterior of a family", columns, tuple(rows))
    return Result("posterior", "How long the posterior takes", (table,), tuple(goals), _NOTES)


def _measure_real(count: int) -> Cost:
    """What so many meshes of the benchmark cost."""
    meshes, rng = [row.mesh for row in samples(_KIND)[:count]], np.random.default_rng(0)
    said = _say([hull.label or "" for mesh in meshes for hull in mesh.hulls], rng)
    return _measure(FamilyModel(meshes).infer, said, len(meshes), _ANSWERS)


def _measure_made(count: int) -> Cost:
    """What so many meshes that are made from described ones cost."""
    rng = np.random.default_rng(0)
    chosen = [row.mesh for row in samples(_KIND)[:_DESCRIBED]]
    known = [(describe_mesh(mesh).rows, [hull.label or "" for hull in mesh.hulls]) for mesh in chosen]
    in_a_row = np.stack([np.arange(_HULLS - 1), np.arange(1, _HULLS)], axis=1)
    described, labels = list[tuple[Floats, Ints]](), list[str]()
    for mesh in range(count):
        rows, names = known[mesh % len(known)]
        taken = rng.integers(0, len(rows), _HULLS)
        described.append((rows[taken] * (1 + _NOISE * rng.standard_normal((_HULLS, rows.shape[1]))), in_a_row))
        labels += [names[place] for place in taken]
    table = FamilyTable.of(described)
    del described
    return _measure(partial(_infer, table), _say(labels, rng), count, 1)


def _say(labels: list[str], rng: np.random.Generator) -> list[Label | None]:
    """What a model says of hulls whose right labels these are."""
    words, draws = sorted(set(labels)), rng.random((len(labels), 2))
    others = rng.integers(0, len(words), len(labels))
    names = [
        words[other] if draw[0] < _WRONG else name for name, draw, other in zip(labels, draws, others, strict=True)
    ]
    return [None if draw[1] < _SILENT else Label(name, 0.9, "vlm") for name, draw in zip(names, draws, strict=True)]


def _infer(table: FamilyTable, said: list[Label | None]) -> FamilyPosterior:
    return FamilyPosterior.of(table, Observations.of(said))


def _measure(
    infer: Callable[[list[Label | None]], FamilyPosterior], said: list[Label | None], meshes: int, answers: int
) -> Cost:
    began, began_cpu = time.perf_counter(), time.process_time()
    found = infer(said)
    start, cpu, times, peaks = (
        time.perf_counter() - began,
        time.process_time() - began_cpu,
        list[float](),
        dict[int, int](),
    )
    for mesh in range(answers):
        label = found.labels(mesh)[0]
        assert label
        said[found.table.spans[mesh].start] = Label(label.name)
        began = time.perf_counter()
        infer(said)
        times.append(time.perf_counter() - began)
    look(os.getpid(), peaks)
    return Cost(meshes, len(said), start, cpu, times[0], statistics.median(times), peaks[os.getpid()])
