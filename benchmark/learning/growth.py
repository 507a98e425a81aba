"""How the time of a search grows with labels, meshes, hulls and the size of the extractor, one varied at a time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import log
from statistics import median

import numpy as np

from benchmark.clock import in_turns
from benchmark.learning.boxes import SIZED, boxes_case
from benchmark.report import Cell, Goal, Result, Table, Tell
from meshforge.synthesis.candidates.rank import RankedCandidates, enumerate_consistent
from meshforge.synthesis.search.smallest import Hit, Search

_ROUNDS = 3
_SLOW = 0.5  # seconds of a turn that is not taken again
_COLUMNS = ("nodes found", "groups", "candidates", "all of them", "search, ms", "readings, ms")


@dataclass(frozen=True, slots=True)
class Setting:
    """What is varied; nodes: of the hidden extractor; shown: demonstrated meshes, None for all."""

    labels: int = 8
    meshes: int = 100
    hulls: int = 40
    nodes: int = 5
    shown: int | None = 3

    @property
    def demonstrated(self) -> int:
        """How many meshes are demonstrated."""
        return self.meshes if self.shown is None else self.shown


@dataclass(frozen=True, slots=True)
class Point:
    """What was found in a setting, and the seconds it took."""

    setting: Setting
    found: int
    groups: int
    readings: int
    complete: bool
    search: float
    weighing: float

    def cells(self) -> tuple[Cell, ...]:
        whole = "yes" if self.complete else "no"
        return (self.found, self.groups, self.readings, whole, 1e3 * self.search, 1e3 * self.weighing)


_VARIED: dict[str, tuple[int, ...]] = {
    "labels": (3, 4, 6, 8, 10, 12),
    "meshes": (25, 50, 100, 200, 400, 800, 1600),
    "hulls": (10, 20, 40, 80, 160),
    "nodes": tuple(SIZED),
}
_TITLES = {
    "labels": "Labels",
    "meshes": "Meshes of the batch",
    "hulls": "Hulls of a mesh",
    "nodes": "Nodes of the hidden extractor",
}
_LARGEST = Setting(nodes=11)


def measure(tell: Tell, quick: bool) -> Result:
    """Time the default strategy in all settings."""
    tables, notes = [], []
    for name, values in _VARIED.items():
        points = []
        for value in values[:2] if quick else values:
            points.append(_point(_vary(name, value, quick), 1 if quick else _ROUNDS))
            tell(f"growth: {value} {name}")
        rows = tuple((value, *point.cells()) for value, point in zip(values, points, strict=False))
        tables.append(Table(_TITLES[name], (name, *_COLUMNS), rows))
        notes += list(_growth(name, values, points))
    largest = list(_largest(tell, quick))
    tables.append(_table_of_largest(largest))
    return Result(
        "growth", "How search and readings grow", tuple(tables), tuple(_goals(largest)), (*_write_notes(), *notes)
    )


def _vary(name: str, value: int, quick: bool) -> Setting:
    base = Setting(meshes=10) if quick else Setting()
    return replace(base, **{name: value})


def _largest(tell: Tell, quick: bool) -> Iterator[Point]:
    """Three `Attach` under two operators, demonstrated on few meshes and on all."""
    for shown in (3, None):
        setting = replace(_LARGEST, shown=shown, **({"meshes": 10, "nodes": 7} if quick else {}))
        yield _point(setting, 1)
        tell(f"growth: {setting.nodes} nodes, {setting.demonstrated} meshes demonstrated")


def _point(setting: Setting, rounds: int) -> Point:
    case = boxes_case(setting.nodes, setting.meshes, setting.demonstrated, setting.hulls, setting.labels)
    found: list[RankedCandidates] = []
    searches: list[tuple[Search, Hit]] = []

    def search() -> None:
        searching = case.search()
        answer = searching.run()
        assert isinstance(answer, Hit)
        searches.append((searching, answer))

    def weigh() -> None:
        searching, answer = searches[-1]
        found.append(
            RankedCandidates(searching, enumerate_consistent(searching, answer.extractor, searching.options.above))
        )

    times = in_turns({"search": lambda: search, "candidates": lambda: weigh}, rounds, slow=_SLOW)
    field, consistent = found[-1].field, found[-1].consistent
    return Point(
        setting,
        consistent.terms[0].size,
        field.width,
        len(consistent.terms),
        consistent.complete,
        median(times["search"]),
        median(times["candidates"]),
    )


def _growth(name: str, values: Sequence[int], points: Sequence[Point]) -> Iterator[str]:
    """A sentence on how the times grow from the first value to the last."""
    if len(points) < 3:
        return
    search, weighing = [point.search for point in points], [point.weighing for point in points]
    if name == "nodes":
        by = f"{_step(values, search):.2g} times with each node, readings {_step(values, weighing):.2g} times"
    else:
        by = f"as the power {_power(values, search):.2g} of the number, readings as {_power(values, weighing):.2g}"
    yield f"{_TITLES[name]}, {values[0]} to {values[len(points) - 1]}: search grows {by}."


def _power(values: Sequence[int], seconds: Sequence[float]) -> float:
    """The exponent that fits best."""
    return float(np.polyfit([log(v) for v in values[: len(seconds)]], [log(s) for s in seconds], 1)[0])


def _step(values: Sequence[int], seconds: Sequence[float]) -> float:
    """The factor of one more that fits best."""
    return float(np.exp(np.polyfit(values[: len(seconds)], [log(s) for s in seconds], 1)[0]))


def _table_of_largest(points: Sequence[Point]) -> Table:
    title = "Three `Attach` under two operators, 8 labels, 100 meshes of 40 hulls"
    rows = tuple((point.setting.demonstrated, *point.cells()) for point in points)
    return Table(title, ("demonstrated", *_COLUMNS), rows)


def _goals(points: Sequence[Point]) -> Iterator[Goal]:
    for point in points:
        what = f"three `Attach`, {point.setting.demonstrated} meshes demonstrated: search and readings, s"
        yield Goal(what, "at most", 1.0, point.search + point.weighing)


def _write_notes() -> tuple[str, ...]:
    base = Setting()
    return (
        f"Boxes at random: {base.meshes} meshes of {base.hulls} hulls, {base.labels} labels, an extractor of "
        f"{base.nodes} nodes, demonstrated on {base.shown} meshes, where nothing else is said; contacts known.",
        "*Groups*: hulls of all meshes that some extractor tells apart; *all of them*: whether every reading up to "
        "four nodes larger was found within the effort that is allowed.",
    )
