"""Runs a learned program on every demonstration: nothing is returned that does not do what was shown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from meshforge.errors import MeshForgeError
from meshforge.language import Program, Template
from meshforge.synthesis.demonstration import Demonstration, named
from meshforge.synthesis.remember import remembered


def verify(program: Program, demos: Sequence[Demonstration], templates: Mapping[str, Template]) -> None:
    """Raises AssertionError, an error of ours, where the program selects something else than was shown.

    Raises ProgramError where it cannot run: it asks for labels, and a demonstrated mesh has none.
    """
    made_of = tuple(templates[name].digest for name in program.templates if name in templates)
    for name, demo in named(demos):
        key = ("verified", str(program), made_of, demo.steps)
        remembered(demo.mesh, key, bool, partial(_verified, program, demo, templates, name))


def _verified(program: Program, demo: Demonstration, templates: Mapping[str, Template], name: str) -> bool:
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
    return True
