"""How long whole programs take to learn: search and readings on given meshes, and everything, replay included."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from statistics import median

from benchmark.clock import in_turns
from benchmark.learning.cases import learn
from benchmark.learning.programs import TargetProgram, target_of_tables, target_programs
from benchmark.report import Cell, Tell
from meshforge.language import select_mask
from meshforge.synthesis import Demonstration, synthesize
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.search.smallest import Search

_SEED, _ROUNDS = 100, 3


@dataclass(frozen=True, slots=True)
class Times:
    """One program [s]: search and readings of all its rules on meshes given with their contacts; what `synthesize`
    says that it took to search, contacts and label repair included, and to replay; and all once more, as after an
    answer.
    """

    name: str
    rules: int
    meshes: int
    hulls: int
    readings: float
    search: float
    replay: float
    again: float

    def cells(self) -> tuple[Cell, ...]:
        times = (1e3 * self.readings, 1e3 * self.search, 1e3 * self.replay, 1e3 * self.again)
        return (self.name, self.rules, self.meshes, self.hulls, *times)


def programs_timed(tell: Tell, quick: bool) -> list[Times]:
    """The program of the bundled tables, for 14 and for 75 of them, and those of the families."""
    rows = []
    for task, shown in _tasks(quick):
        rows.append(_time(task, shown, 1 if quick else _ROUNDS))
        tell(f"search: {len(rows)} programs")
    return rows


def _tasks(quick: bool) -> Iterator[tuple[TargetProgram, Sequence[str]]]:
    yield target_of_tables(14)
    if quick:
        return
    yield target_of_tables(75)
    for task in target_programs(_SEED):
        if telling := task.find_examples():
            yield task, [telling[0], next(name for name in task.meshes if name != telling[0])]


def _time(task: TargetProgram, shown: Sequence[str], rounds: int) -> Times:
    first, again = zip(*(_time_learning(task, shown) for _ in range(rounds)), strict=True)
    return Times(
        task.name,
        len(task.program.rules),
        len(task.meshes),
        sum(len(mesh.hulls) for mesh in task.meshes.values()),
        sum(_readings(task, shown, number, rounds) for number in range(len(task.program.rules))),
        median(seconds["search"] for seconds in first),
        median(seconds["replay"] for seconds in first),
        median(sum(seconds.values()) for seconds in again),
    )


def _time_learning(task: TargetProgram, shown: Sequence[str]) -> tuple[Mapping[str, float], Mapping[str, float]]:
    """What learning takes on meshes that are new to it, and once more on the same."""
    meshes = {name: replace(mesh) for name, mesh in task.meshes.items()}
    demos = [Demonstration(meshes[name], task.demonstration(name).steps, name) for name in shown]
    program = task.program

    def learn_once() -> Mapping[str, float]:
        rest = (meshes, program.orient, task.templates, program.labels)
        return synthesize(demos, *rest, confirm=lambda _: False).seconds

    return learn_once(), learn_once()


def _readings(task: TargetProgram, shown: Sequence[str], number: int, rounds: int) -> float:
    """Search and readings of one rule on the meshes that the right rules before it make."""
    rules, extractor = task.program.rules[:number], task.program.rules[number].extractor
    met = {name: task.mesh_before(name, rules) for name in task.meshes}
    assert all(mesh.contacts is not None for mesh in met.values())
    examples = [Example(name, met[name], select_mask(extractor, met[name])) for name in shown]
    rest = [mesh for name, mesh in met.items() if name not in shown]

    def run() -> object:
        return learn(Search(examples, task.program.labels, TimeBudget(120.0), Options(), rest))

    return median(in_turns({"ours": lambda: run}, rounds)["ours"])
