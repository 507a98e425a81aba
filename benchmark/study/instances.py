"""The repair study: fixed instances in which wrong labels stand in the way, and three ways to deal with them."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from time import perf_counter
from typing import Any, Literal

from benchmark.assets import SEPARATE
from benchmark.study.condition import FLAT, MOST, SEEN
from benchmark.study.desk import Bench, Desk, open_bench
from benchmark.study.keystrokes import CONFIRMATION, DEMONSTRATION, GLANCE, HULL, INSPECTION, PAINT, RULE, STROKE
from benchmark.study.person import Person
from meshforge.common import MeshForgeError
from meshforge.language import Program
from meshforge.synthesis import LabelCorrection, Options, Repair

Way = Literal["no correction", "all labels inspected (Standard PBE)", "ABI"]
_SEED, _DRAWS = 300, 12
_FIRST = 2  # demonstrations that are there from the start


@dataclass(slots=True)
class InstanceResult:
    """How one way did on one instance; seconds: of the tool, measured; person: modelled by keystrokes [s]."""

    task: str
    way: str
    right: bool
    demonstrations: int
    inspected: int
    typed: int
    confirmed: int
    refused: int
    seconds: float
    person: float

    def to_json(self) -> dict[str, Any]:
        return asdict(self)


@dataclass(frozen=True, eq=False)
class Instance:
    """A task under noisy labels of a seed, and the meshes that are demonstrated, in order."""

    bench: Bench
    seed: int
    pool: tuple[str, ...]

    @cached_property
    def desk(self) -> Desk:
        return self.bench.desk("flat", self.seed)


def instance(name: str) -> Instance | None:
    """The first draw of a task in which two demonstrations do not suffice without repair, though they would if all
    their labels were right; None where a dozen draws have none."""
    for draw in range(_DRAWS):
        bench = open_bench(name, SEPARATE[draw % len(SEPARATE)])
        able = [mesh for mesh, done in bench.truth.reference.items() if done is not None and all(done)]
        if len(able) < MOST:
            continue
        pool = tuple(random.Random(f"{_SEED + draw} {name}").sample(able, MOST))
        found = Instance(bench, _SEED + draw, pool)
        if _near_miss(found):
            return found
    return None


def _near_miss(one: Instance) -> bool:
    shown = one.pool[:_FIRST]
    without = _learn(one, one.desk, shown, Options(repair=False))
    inspected = _learn(one, _inspect(one.desk, shown), shown, Options(repair=False))
    return not _right(one, without) and _right(one, inspected)


def mend(one: Instance, way: Way, desk: Desk | None = None) -> InstanceResult:
    """One way on one instance: from two demonstrations on, as many of the pool as it takes. desk: with other labels."""
    person = Person(one.desk, one.seed, FLAT)
    desk, log = desk or one.desk, InstanceResult(one.bench.task.name, way, False, 0, 0, 0, 0, 0, 0.0, 0.0)
    rejected: list[LabelCorrection] = []
    for count in range(_FIRST, MOST + 1):
        shown = one.pool[:count]
        if way.startswith("all labels"):
            hulls = sum(len(desk.meshes[name].hulls) for name in shown)
            log.inspected, log.typed = hulls, len(list(_wrong(one.desk, shown)))
            desk = _inspect(desk, shown)
        agreed: list[LabelCorrection] = []

        def confirm(repair: Repair, agreed: list[LabelCorrection] = agreed) -> bool:
            if said := person.confirms(repair):
                log.confirmed += 1
                agreed.append(repair.correction)
            else:
                log.refused += 1
                rejected.append(repair.correction)
            return said

        start = perf_counter()
        outcome = _learn(one, desk, shown, Options(repair=way == "ABI"), confirm, rejected)
        log.seconds += perf_counter() - start
        desk, log.demonstrations = desk.correct(agreed), count
        if _right(one, outcome, desk):
            log.right = True
            break
    log.person = _person(one, log)
    return log


def _learn(
    one: Instance,
    desk: Desk,
    shown: Sequence[str],
    options: Options,
    confirm: Callable[[Repair], bool] | None = None,
    rejected: Sequence[LabelCorrection] = (),
) -> Program | None:
    person = Person(one.desk, one.seed, FLAT)
    try:
        return desk.learn([person.shows(desk, name) for name in shown], options, confirm, (), rejected).program
    except MeshForgeError:
        return None


def _right(one: Instance, program: Program | None, desk: Desk | None = None) -> bool:
    """Whether a program behaves as the reference on all meshes outside the pool."""
    rest = [name for name, done in one.bench.truth.reference.items() if done is not None and name not in one.pool]
    return not (desk or one.desk).find_differences(program, rest)


def _wrong(desk: Desk, names: Sequence[str]) -> Iterator[LabelCorrection]:
    for name in names:
        true = desk.bench.truth.meshes[name]
        for hull in desk.meshes[name].hulls:
            right = true.hull_of(hull.name).label
            if right and hull.label != right:
                yield LabelCorrection(name, hull.name, hull.label, right)


def _inspect(desk: Desk, names: Sequence[str]) -> Desk:
    return desk.correct(_wrong(desk, names))


def _person(one: Instance, log: InstanceResult) -> float:
    """The keystroke-level model: demonstrations, looks at the result, and what the way asks besides."""
    rules, truth = len(one.bench.task.program.rules), one.bench.truth
    hulls = sum(len(s) for name in one.pool[: log.demonstrations] for s in truth.reference[name] or ())
    shown = log.demonstrations * (DEMONSTRATION + rules * RULE) + hulls * HULL
    asked = (log.confirmed + log.refused) * CONFIRMATION + log.inspected * INSPECTION + log.typed * (STROKE + PAINT)
    return shown + asked + (log.demonstrations - _FIRST + 1) * SEEN * GLANCE
