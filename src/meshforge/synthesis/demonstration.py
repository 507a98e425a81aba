"""Demonstrations: what a person did, step by step, on one mesh."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from meshforge.errors import DemonstrationError
from meshforge.language import Action, Each
from meshforge.symbolic import SymbolicMesh


@dataclass(frozen=True, slots=True, init=False)
class Step:
    """What one mesh says about one rule.

    rule: its number, from 1. select: the names of the hulls the rule selects (shown); an empty set: the rule selects
    none here (nothing); None: this mesh says nothing about the rule (open).
    action, label: what was done, and the label given to what it makes; they count where the step is shown.
    """

    rule: int
    select: frozenset[str] | None
    action: Action
    label: str | None = None

    def __init__(self, rule: int, select: Iterable[str] | None, action: Action, label: str | None = None) -> None:
        if isinstance(select, str):
            raise DemonstrationError(
                f"rule {rule}: select is a set of hull names, not the text {select!r}", remedy=f"Write {{{select!r}}}."
            )
        object.__setattr__(self, "rule", rule)
        object.__setattr__(self, "select", None if select is None else frozenset(select))
        object.__setattr__(self, "action", action)
        object.__setattr__(self, "label", label)

    @property
    def shown(self) -> bool:
        """Whether hulls were selected."""
        return bool(self.select)

    @property
    def open(self) -> bool:
        """Whether the mesh says nothing about the rule."""
        return self.select is None


@dataclass(frozen=True, eq=False, slots=True, init=False)
class Demonstration:
    """The steps on one mesh, in order, one a rule; rules beyond the last step are open.

    mesh: as it came in, before the orientation; names in later steps may be those of hulls that earlier steps made.
    name: how messages call it; by default the file's path.
    Raises DemonstrationError where the rules are not numbered 1, 2, 3, ...
    """

    mesh: SymbolicMesh
    steps: tuple[Step, ...]
    name: str | None = None

    def __init__(self, mesh: SymbolicMesh, steps: Iterable[Step], name: str | None = None) -> None:
        object.__setattr__(self, "mesh", mesh)
        object.__setattr__(self, "steps", tuple(steps))
        object.__setattr__(self, "name", name or (str(mesh.asset.path) if mesh.asset else None))
        numbers = [step.rule for step in self.steps]
        if numbers != list(range(1, len(numbers) + 1)):
            raise DemonstrationError(
                f"the steps are numbered {', '.join(map(str, numbers))}",
                where=self.name,
                remedy=f"Number them 1 to {len(numbers)}, in the order in which they were done; "
                "a rule that this mesh says nothing about has the selection null.",
            )

    def step(self, rule: int) -> Step | None:
        """The step of that rule, None where the mesh says nothing about it."""
        step = self.steps[rule - 1] if rule <= len(self.steps) else None
        return None if step is None or step.open else step


def named(demos: Iterable[Demonstration]) -> tuple[tuple[str, Demonstration], ...]:
    """Each demonstration with the name that messages use; one without a name is `demonstration 1`, `2`, ..."""
    return tuple((demo.name or f"demonstration {k}", demo) for k, demo in enumerate(demos, 1))


def core(action: Action) -> Action:
    """The action without `Each` around it."""
    return action.action if isinstance(action, Each) else action
