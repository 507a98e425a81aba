"""What the demonstrations together say is done by each rule."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from meshforge.errors import DemonstrationError
from meshforge.language import Action, Each
from meshforge.synthesis.demonstration import Demonstration, Step, core, named


@dataclass(frozen=True, slots=True)
class Agreed:
    """A rule without its extractor.

    each_in: where the action is `Each`, the name of a demonstration that says so. One that shows the action without
    `Each` agrees with it only where it selects one connected component.
    """

    number: int
    action: Action
    label: str | None
    each_in: str | None


def agreed_rules(demos: Sequence[Demonstration]) -> tuple[Agreed, ...]:
    """The rules in order. Raises DemonstrationError where actions differ, or where a rule is shown nowhere."""
    count = max((len(demo.steps) for demo in demos), default=0)
    if not count:
        raise DemonstrationError("there is no demonstrated step to learn from")
    return tuple(_agreed(number, demos) for number in range(1, count + 1))


def _agreed(number: int, demos: Sequence[Demonstration]) -> Agreed:
    steps = [(name, demo.step(number)) for name, demo in named(demos)]
    shown = [(name, step) for name, step in steps if step and step.shown]
    if not shown:
        raise DemonstrationError(
            f"rule {number} selects no hull in any demonstration",
            remedy="Show it on a mesh where it has something to do, or leave the step out.",
        )
    for other in shown[1:]:
        _check(number, shown[0], other)
    eaches = [(name, step) for name, step in shown if isinstance(step.action, Each)]
    name, step = (eaches or shown)[0]
    return Agreed(number, step.action, step.label, name if eaches else None)


def _check(number: int, one: tuple[str, Step], other: tuple[str, Step]) -> None:
    (one_name, a), (other_name, b) = one, other
    if (core(a.action), a.label) != (core(b.action), b.label):
        raise DemonstrationError(
            f"rule {number} does {_said(a)} in {one_name}, but {_said(b)} in {other_name}",
            remedy="A rule does the same on every mesh: change one of the steps, or make two rules of them.",
        )


def _said(step: Step) -> str:
    return f"{step.action} as {step.label}" if step.label else str(step.action)
