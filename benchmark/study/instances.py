"""The repair study: fixed instances in which wrong labels stand in the way, and three ways to deal with them."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from time import perf_counter
from typing import Any, Literal

from benchmark.assets import SEPARATE
from benchmark.study.client import TaskClient
from benchmark.study.condition import FLAT, MOST, SEEN
from benchmark.study.desk import Bench, Desk, open_bench
from benchmark.study.keystrokes import CONFIRMATION, DEMONSTRATION, GLANCE, HULL, INSPECTION, PAINT, RULE, STROKE
from benchmark.study.person import Person
from benchmark.study.project import name_by_files, open_project
from meshforge.common import MeshForgeError
from meshforge.language import Program
from meshforge.synthesis import Options, Repair

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
        bench = name_by_files(open_bench(name, SEPARATE[draw % len(SEPARATE)]))
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
    with open_project(one.desk) as project:
        client = TaskClient(project)
        _show(one, client, shown)
        without = _learn(client, Options(repair=False))
        _inspect(client, one.desk, shown)
        return not _right(one, without, one.desk) and _right(one, _learn(client, Options(repair=False)), one.desk)


def mend(one: Instance, way: Way, *, takes_labels: bool = False) -> InstanceResult:
    """One way on one instance, in a new project: from two demonstrations on, as many of the pool as it takes.

    takes_labels: whether the labels are first taken as all sources together speak for them.
    """
    person, log = (
        Person(one.desk, one.seed, FLAT),
        InstanceResult(one.bench.task.name, way, False, 0, 0, 0, 0, 0, 0.0, 0.0),
    )

    def confirm(repair: Repair) -> bool:
        said = person.confirms(repair)
        log.confirmed += said
        log.refused += not said
        return said

    with open_project(one.desk) as project:
        client = TaskClient(project)
        if takes_labels:
            client.take_labels()
        for count in range(_FIRST, MOST + 1):
            shown = one.pool[:count]
            _show(one, client, shown)
            if way.startswith("all labels"):
                log.inspected = sum(len(one.desk.meshes[name].hulls) for name in shown)
                log.typed = sum(len(_find_wrong(one.desk, name)) for name in shown)
                _inspect(client, one.desk, shown)
            start = perf_counter()
            program = _learn(client, Options(repair=way == "ABI"), confirm)
            log.seconds, log.demonstrations = log.seconds + perf_counter() - start, count
            if _right(one, program, one.desk.with_labels_of(client.read_meshes())):
                log.right = True
                break
    log.person = _person(one, log)
    return log


def _show(one: Instance, client: TaskClient, shown: Sequence[str]) -> None:
    person = Person(one.desk, one.seed, FLAT)
    for name in shown:
        client.demonstrate(name, person.shows(one.desk, name).steps)


def _learn(client: TaskClient, options: Options, confirm: Callable[[Repair], bool] | None = None) -> Program | None:
    try:
        return client.synthesize(options, confirm).program
    except MeshForgeError:
        return None


def _right(one: Instance, program: Program | None, desk: Desk) -> bool:
    """Whether a program behaves as the reference on all meshes outside the pool."""
    rest = [name for name, done in one.bench.truth.reference.items() if done is not None and name not in one.pool]
    return not desk.find_differences(program, rest)


def _find_wrong(desk: Desk, name: str) -> dict[str, str]:
    """The hulls of a mesh that have a wrong label, with the right one."""
    pairs = zip(desk.meshes[name].hulls, desk.bench.truth.meshes[name].hulls, strict=True)
    return {hull.name: true.label for hull, true in pairs if true.label and hull.label != true.label}


def _inspect(client: TaskClient, desk: Desk, names: Sequence[str]) -> None:
    for name in names:
        client.set_labels(name, _find_wrong(desk, name))


def _person(one: Instance, log: InstanceResult) -> float:
    """The keystroke-level model: demonstrations, looks at the result, and what the way asks besides."""
    rules, truth = len(one.bench.task.program.rules), one.bench.truth
    hulls = sum(len(s) for name in one.pool[: log.demonstrations] for s in truth.reference[name] or ())
    shown = log.demonstrations * (DEMONSTRATION + rules * RULE) + hulls * HULL
    asked = (log.confirmed + log.refused) * CONFIRMATION + log.inspected * INSPECTION + log.typed * (STROKE + PAINT)
    return shown + asked + (log.demonstrations - _FIRST + 1) * SEEN * GLANCE
