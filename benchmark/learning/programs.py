"""Whole programs that people want for a family, which the learner does not see, and how they are shown to it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from benchmark.learning.cases import FAMILY, name_of, read_family
from benchmark.learning.families import FAMILIES, VOCABULARIES
from benchmark.learning.tables import DEMONSTRATED, PROGRAM, stretch_tables, templates
from meshforge.language import Program, Rule, Template, select
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, LearningOutcome, Step, memoize

_TEXTS: dict[str, tuple[str, ...]] = {
    "table": (
        "Is(misc) => Delete; Geo(Is(panel), +Z) => Merge; Is(leg) => Each(Merge)",
        "Is(misc) => Delete; Diff(Is(panel), Geo(Is(panel), +Z)) => Delete; "
        "Diff(Is(handle), Attach(Is(handle), Is(drawer))) => Delete; Is(handle) => Each(Replace(capsule))",
        "Union(Is(leg), Is(pad)) => Each(Merge); Geo(Is(panel), +Z) => Replace(box); "
        "Diff(Is(drawer), Attach(Is(drawer), Is(handle))) => Delete; "
        "Attach(Is(handle), Is(drawer)) => Each(Merge); Is(misc) => Delete",
    ),
    "cabinet": (
        "Is(shelf) => Delete; Is(door) => Each(Merge); Attach(Is(handle), Is(door)) => Each(Replace(capsule))",
        "Diff(Is(door), Attach(Is(door), Is(handle))) => Delete; Geo(Is(frame), +Z) => Merge; "
        "Attach(Is(handle), Is(drawer)) => Scale(all, 1.2); Is(foot) => Each(Replace(cylinder))",
        "Union(Is(foot), Is(plate)) => Delete; Diff(Is(frame), Geo(Is(frame), -Z)) => Merge; "
        "Union(Is(door), Is(drawer)) => Each(Scale(Y, 1.5)); Is(shelf) => Each(Merge)",
    ),
    "lamp": (
        "Is(cord) => Delete; Geo(Is(base), -Z) => Merge; Is(pole) => Merge",
        "Union(Is(cord), Is(switch)) => Delete; Diff(Is(shade), Geo(Is(shade), -Z)) => Delete; "
        "Union(Is(base), Is(pole)) => Merge",
        "Is(bulb) => Delete; Attach(Is(pole), Is(base)) => Scale(X, 1.5); "
        "Diff(Is(base), Attach(Is(base), Is(pole))) => Delete; Is(shade) => Each(Merge); Is(cord) => Merge",
    ),
    "cup": (
        "Is(misc) => Delete; Is(handle) => Each(Merge); Geo(Is(base), -Z) => Merge",
        "Union(Is(lid), Is(misc)) => Delete; Diff(Is(handle), Attach(Is(handle), Is(wall))) => Merge; "
        "Union(Is(base), Is(saucer)) => Merge",
        "Is(misc) => Delete; Diff(Is(wall), Geo(Is(wall), +Z)) => Delete; "
        "Diff(Is(wall), Attach(Is(wall), Is(handle))) => Scale(all, 1.1); Is(handle) => Each(Replace(capsule))",
    ),
}


@dataclass(frozen=True, eq=False)
class TargetProgram:
    """A program, with the meshes it is meant for by their names."""

    name: str
    program: Program
    meshes: Mapping[str, SymbolicMesh]
    templates: Mapping[str, Template]

    def demonstration(self, asset: str) -> Demonstration:
        """The program done by hand on one mesh."""
        rows = zip(self.program.rules, self.select(self.program, asset), strict=True)
        steps = [Step(k, chosen, rule.action, rule.label) for k, (rule, chosen) in enumerate(rows, 1)]
        return Demonstration(self.meshes[asset], steps, asset)

    def select(self, program: Program, asset: str) -> list[frozenset[str]]:
        """The hulls that each rule of a program selects on a mesh, by name."""
        return [frozenset(done.selected) for done in program.run(self.meshes[asset], self.templates).trace]

    def mesh_before(self, asset: str, rules: Sequence[Rule]) -> SymbolicMesh:
        """A mesh after some rules, as the next one meets it."""
        program = replace(self.program, rules=tuple(rules))
        *_, last = program.replay(self.meshes[asset], self.templates, name=asset, memo=memoize)
        return last.mesh

    def intend(self, asset: str, number: int, outcome: LearningOutcome) -> frozenset[str]:
        """What a person wants a rule to select, on the mesh that the learned rules before it make."""
        mesh = self.mesh_before(asset, outcome.rules[: number - 1])
        chosen = select(self.program.rules[number - 1].extractor, mesh)
        return frozenset(mesh.hulls[index].name for index in chosen)

    def find_examples(self) -> list[str]:
        """The names of the meshes on which every rule selects something."""
        return [asset for asset, right in self.right.items() if all(right)]

    @cached_property
    def right(self) -> dict[str, list[frozenset[str]]]:
        """What the program selects on each mesh."""
        return {asset: self.select(self.program, asset) for asset in self.meshes}


def target_programs(seed: int, only: Iterable[str] = tuple(FAMILIES), count: int = FAMILY) -> list[TargetProgram]:
    """The programs of the families."""
    found = []
    for family in only:
        meshes = {name_of(k): mesh for k, mesh in enumerate(read_family(family, seed, count))}
        for number, text in enumerate(_TEXTS[family], 1):
            rules = Program.parse("\n".join(text.split("; "))).rules
            program = Program(VOCABULARIES[family], None, rules)
            found.append(TargetProgram(f"{family} {number}", program, meshes, {}))
    return found


def target_of_tables(count: int) -> tuple[TargetProgram, tuple[str, ...]]:
    """The program of the bundled tables, for so many of them, and the names of those that are demonstrated."""
    return TargetProgram(f"tables, {count}", PROGRAM, stretch_tables(count), templates()), DEMONSTRATED
