"""Programs that are nearly the reference of a task: what a criterion must tell from it."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from benchmark.assets import Sample
from benchmark.tasks.task import EditResult, Task, task
from meshforge.geometry import Floats
from meshforge.language import (
    DIRECTIONS,
    Attach,
    Diff,
    Extractor,
    Geo,
    Intersect,
    Is,
    Program,
    Rule,
    Union,
    select_mask,
    size_of,
)
from meshforge.language.print import show

ACTIONS = ("Delete", "Merge", "Each(Merge)", "Replace(box)", "Each(Replace(box))", "Scale(all, 0.8)")
EXTRACTORS = 3
"""Wrong extractors of a rule."""
_LEAST = 0.2  # of the meshes, on which a wrong extractor must select other hulls than the right one
_DRAWS = 2000
_SAME = 1e-4  # of the diagonal: hulls differ from there on


@dataclass(frozen=True, slots=True)
class Mutant:
    """rule: the number of the rule that differs, None for `All => Delete`; change: how, in words."""

    rule: int | None
    change: str
    program: Program

    @property
    def name(self) -> str:
        """As `task.toml` names it, where it does the same job as the reference."""
        return self.change if self.rule is None else f"{self.rule}: {self.change}"


def mutants(task: Task) -> list[Mutant]:
    """Every rule dropped, deleting, with other actions, with wrong extractors of its size; and `All => Delete`."""
    one = task.program
    everything = replace(one, rules=Program.parse(f"{_labels(one)}\n\nAll => Delete").rules)
    found = [
        Mutant(None, "All => Delete", everything),
        *(mutant for place in range(len(one.rules)) for mutant in _of_rule(task, place)),
    ]
    unknown = task.equivalents.keys() - {mutant.name for mutant in found}
    assert not unknown, f"{task.name} has no mutants {sorted(unknown)}"
    return found


def judge_mutants(name: str, calibration: bool = False) -> list[dict[str, Any]]:
    """Every mutant of a task: on how many meshes its edit differs from the reference's, and which of them pass."""
    one = task(name)
    return judge_mutants_on(one, one.samples(calibration))


def judge_mutants_on(one: Task, samples: Sequence[Sample]) -> list[dict[str, Any]]:
    """Every mutant of a task: on how many of some meshes its edit differs from the reference's, and which pass."""
    programs = mutants(one)
    rows: list[dict[str, Any]] = [
        {"mutant": mutant.name, "differs": 0, "pass": [], "reason": one.equivalents.get(mutant.name)}
        for mutant in programs
    ]
    for sample in samples:
        right = one.run(one.program, sample.mesh)
        seen: list[tuple[EditResult, bool]] = []
        for mutant, row in zip(programs, rows, strict=True):
            edited = one.run(mutant.program, sample.mesh)
            least = _SAME * sample.mesh.diagonal
            if have_same_shapes(edited, right, least):
                continue
            row["differs"] += 1
            known = next((passes for other, passes in seen if have_same_shapes(edited, other, least)), None)
            if known is None:
                known = one.failure(sample, edited) is None
                seen.append((edited, known))
            if known:
                row["pass"].append(sample.name)
    return rows


def have_same_shapes(one: EditResult, other: EditResult, least: float) -> bool:
    """Whether two edits have the same shapes, each to within a distance [m], whatever they are called."""
    if one.mesh is None or other.mesh is None:
        return one.mesh is other.mesh
    if len(one.mesh.hulls) != len(other.mesh.hulls):
        return False
    names = one.mesh.index.keys() & other.mesh.index.keys()
    same = {name for name in names if one.mesh.hull_of(name).shape is other.mesh.hull_of(name).shape}
    a, b = _extents(one, same), _extents(other, same)
    if not len(a) or not len(b):
        return len(a) == len(b)
    apart = np.abs(a[:, None] - b[None]).max(axis=2)
    return bool((apart.min(axis=0) <= least).all() and (apart.min(axis=1) <= least).all())


def _extents(edited: EditResult, without: set[str]) -> Floats:
    """Of each hull its box, its centroid and the side of a cube of its volume (n, 10) [m]."""
    assert edited.mesh
    hulls = [hull for hull in edited.mesh.hulls if hull.name not in without]
    return np.array([[*h.aabb.min, *h.aabb.max, *h.shape.centroid, h.volume ** (1 / 3)] for h in hulls])


def _labels(program: Program) -> str:
    return f"labels {', '.join(program.labels)}"


def _of_rule(task: Task, place: int) -> Iterator[Mutant]:
    program, rule = task.program, task.program.rules[place]
    without = tuple(other for k, other in enumerate(program.rules) if k != place)
    yield Mutant(place + 1, "dropped", replace(program, rules=without))
    for text in ACTIONS:
        action = Program.parse(f"{_labels(program)}\n\nAll => {text}").rules[0].action
        if action != rule.action:
            yield Mutant(place + 1, text, _with(program, place, replace(rule, action=action, label=None)))
    for extractor in _wrong(task, place):
        yield Mutant(place + 1, f"on {show(extractor)}", _with(program, place, replace(rule, extractor=extractor)))


def _with(program: Program, place: int, rule: Rule) -> Program:
    rules = (rule if k == place else other for k, other in enumerate(program.rules))
    return replace(program, rules=tuple(rules))


def _wrong(task: Task, place: int) -> list[Extractor]:
    """Extractors of the same size that select other hulls on a fifth of the meshes or more, the same every time."""
    right = task.program.rules[place].extractor
    rng = random.Random(f"{task.name} {place}")
    meshes = [sample.mesh for sample in task.samples(calibration=True) or task.samples()]
    asked = [select_mask(right, mesh) for mesh in meshes]
    found: list[Extractor] = []
    for _ in range(_DRAWS):
        drawn = _draw(size_of(right), task.program.labels, rng)
        differs = sum(select_mask(drawn, mesh) != mask for mesh, mask in zip(meshes, asked, strict=True))
        if drawn not in found and differs >= _LEAST * len(meshes):
            found.append(drawn)
            if len(found) == EXTRACTORS:
                break
    return found


def _draw(size: int, labels: Sequence[str], rng: random.Random) -> Extractor:
    """Any extractor of that size."""
    if size == 1:
        return Is(rng.choice(labels))
    if size == 2:
        return Geo(Is(rng.choice(labels)), rng.choice(DIRECTIONS))
    nodes = [(node, left) for left in range(1, size - 1) for node in (Union, Intersect, Diff)]
    chosen = rng.choice([*nodes, None] if size == 3 else nodes)
    if chosen is None:
        return Attach(Is(rng.choice(labels)), Is(rng.choice(labels)))
    node, left = chosen
    return node(_draw(left, labels, rng), _draw(size - 1 - left, labels, rng))
