"""Demonstrations made by running a program that the learner does not see."""

from __future__ import annotations

from collections.abc import Sequence

from meshforge.language import Program, Rule
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, Step
from tests.strategies import TEMPLATES


def demonstrated(program: Program, meshes: Sequence[SymbolicMesh]) -> tuple[list[Rule], list[Demonstration]]:
    """The rules that select something on one of the meshes at least, and the demonstrations of these rules."""
    traces = [program.run(mesh, TEMPLATES).trace for mesh in meshes]
    kept = [k for k in range(len(program.rules)) if any(trace[k].selected for trace in traces)]
    rules = [program.rules[k] for k in kept]
    demos = [
        Demonstration(
            mesh,
            [
                Step(number, trace[k].selected, program.rules[k].action, program.rules[k].label)
                for number, k in enumerate(kept, 1)
            ],
            f"mesh {place}",
        )
        for place, (mesh, trace) in enumerate(zip(meshes, traces, strict=True))
    ]
    return rules, demos
