"""Cupboards of boxes, some with a door, for tests of what demonstrations leave open."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from meshforge.language import Program, select
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, Step
from tests.synthesis_boxes import Piece, boxes


def cupboard(door: bool = False, feet: int = 0) -> SymbolicMesh:
    """A body, a drawer with a handle (pull), at times a door with a handle (knob), and feet."""
    pieces: list[Piece] = [
        ("case", "body", (0, 0, 0), (4, 4, 4)),
        ("drawer", "drawer", (0, -1, 0), (4, 1, 2)),
        ("pull", "handle", (1, -2, 0), (1, 1, 0.5)),
    ]
    if door:
        pieces += [("door", "door", (4, 0, 0), (1, 4, 4)), ("knob", "handle", (5, 1, 1), (1, 1, 1))]
    pieces += [(f"foot{k}", "foot", (k, 0, -1), (0.5, 0.5, 1)) for k in range(feet)]
    return boxes(*pieces)


def cupboards(count: int = 8, every: int = 2) -> dict[str, SymbolicMesh]:
    """So many by name, c0 and c1 and on; c1 and every so many after it have a door; 0, 1, 2, 0, ... feet."""
    return {f"c{k}": cupboard(k % every == 1, k % 3) for k in range(count)}


def with_rare_doors() -> dict[str, SymbolicMesh]:
    """Thirty cupboards of which two have a door: few enough that what differs on them may well not be seen."""
    return cupboards(30, every=15)


def shown(meshes: Mapping[str, SymbolicMesh], names: Sequence[str], program: str) -> list[Demonstration]:
    """Demonstrations of a program on some meshes."""
    meant = Program.parse(program)
    return [
        Demonstration(
            meshes[name],
            [
                Step(done.rule, done.selected, rule.action, rule.label)
                for done, rule in zip(meant.run(meshes[name]).trace, meant.rules, strict=True)
            ],
            name,
        )
        for name in names
    ]


def selected(program: Program, rule: int, mesh: SymbolicMesh) -> frozenset[str]:
    """The names of the hulls that a rule selects."""
    return frozenset(program.run(mesh).trace[rule - 1].selected)


def meant(extractor: str, mesh: SymbolicMesh) -> frozenset[str]:
    """The names of the hulls that an extractor selects."""
    (rule,) = Program.parse(f"{extractor} => Delete").rules
    return frozenset(mesh.hulls[k].name for k in select(rule.extractor, mesh))
