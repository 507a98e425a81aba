"""Runs a learned program on every demonstration: nothing is returned that does not do what was shown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from meshforge.errors import MeshForgeError
from meshforge.language import Program, Template
from meshforge.synthesis.demonstration import Demonstration, named


def verify(program: Program, demos: Sequence[Demonstration], templates: Mapping[str, Template]) -> None:
    """Raises AssertionError, an error of ours, where the program selects something else than was shown.

    Raises ProgramError where it cannot run: it asks for labels, and a demonstrated mesh has none.
    """
    for name, demo in named(demos):
        try:
            trace = program.run(demo.mesh, templates).trace
        except MeshForgeError as error:
            raise error.at(name) from None
        for done in trace:
            step = demo.step(done.rule)
            if step and step.select != frozenset(done.selected):
                raise AssertionError(
                    f"the learned rule {done.rule} selects {sorted(done.selected)} on {name}, "
                    f"not {sorted(step.select or ())} as was shown"
                )
