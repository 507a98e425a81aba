"""How long whole programs take to learn: search and readings on given meshes, and everything, replay included."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from statistics import median

from benchmark.clock import in_turns
from benchmark.learning.cases import learned
from benchmark.learning.programs import Wanted, wanted, wanted_tables
from benchmark.report import Cell, Tell
from meshforge.language import EXTREMITY, select_mask
from meshforge.synthesis import synthesize
from meshforge.synthesis.example import Example
from meshforge.synthesis.options import Options
from meshforge.synthesis.search import Search
from meshforge.synthesis.watch import Watch

_SEED, _ROUNDS = 100, 3


@dataclass(frozen=True, slots=True)
class Timed:
    """One program [s]: search and readings of all its rules on meshes given with their contacts; what `synthesize`
    says that it took to search, contacts and label repair included, and to replay.
    """

    name: str
    rules: int
    meshes: int
    hulls: int
    readings: float
    search: float
    replay: float

    def cells(self) -> tuple[Cell, ...]:
        times = (1e3 * self.readings, 1e3 * self.search, 1e3 * self.replay)
        return (self.name, self.rules, self.meshes, self.hulls, *times)


def programs_timed(tell: Tell, quick: bool) -> list[Timed]:
    """The program of the bundled tables, for 14 and for 75 of them, and those of the families."""
    rows = []
    for task, shown in _tasks(quick):
        rows.append(_timed(task, shown, 1 if quick else _ROUNDS))
        tell(f"search: {len(rows)} programs")
    return rows


def _tasks(quick: bool) -> Iterator[tuple[Wanted, Sequence[str]]]:
    yield wanted_tables(14)
    if quick:
        return
    yield wanted_tables(75)
    for task in wanted(_SEED):
        if telling := task.telling():
            yield task, [telling[0], next(name for name in task.meshes if name != telling[0])]


def _timed(task: Wanted, shown: Sequence[str], rounds: int) -> Timed:
    demos = [task.demonstration(name) for name in shown]
    whole = [
        synthesize(
            demos, task.meshes, task.program.orient, task.templates, task.program.labels, confirm=lambda _: False
        ).seconds
        for _ in range(rounds)
    ]
    return Timed(
        task.name,
        len(task.program.rules),
        len(task.meshes),
        sum(len(mesh.hulls) for mesh in task.meshes.values()),
        sum(_readings(task, shown, number, rounds) for number in range(len(task.program.rules))),
        median(seconds["search"] for seconds in whole),
        median(seconds["replay"] for seconds in whole),
    )


def _readings(task: Wanted, shown: Sequence[str], number: int, rounds: int) -> float:
    """Search and readings of one rule on the meshes that the right rules before it make."""
    rules, extractor = task.program.rules[:number], task.program.rules[number].extractor
    met = {name: task.met(name, rules) for name in task.meshes}
    assert all(mesh.contacts is not None for mesh in met.values())
    examples = [Example(name, met[name], select_mask(extractor, met[name])) for name in shown]
    rest = [mesh for name, mesh in met.items() if name not in shown]

    def run() -> object:
        return learned(Search(examples, task.program.labels, Watch(120.0), Options(), EXTREMITY, rest))

    return median(in_turns({"ours": lambda: run}, rounds)["ours"])
