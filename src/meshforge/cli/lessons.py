"""Lessons in a row from one project: learning, and learning again after each thing that a person said."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from meshforge.cli.interruption import interruptible

if TYPE_CHECKING:
    from meshforge.language import Program
    from meshforge.project import Family, Project
    from meshforge.symbolic import SymbolicMesh
    from meshforge.synthesis import Answer, Options, Outcome, Repair


@dataclass
class Lessons:
    """Learns as often as it is asked to.

    keep: whether programs, answers and repairs are kept in the project. stopped: whether a person ended the last
    lesson; answers: how many it took into account; given: answers that are not kept; follow: a program to tell
    about.
    """

    project: Project
    options: Options
    keep: bool = True
    stopped: bool = False
    follow: Program | None = None
    given: dict[tuple[int, str], Answer] = field(default_factory=dict)

    def learn(self, confirm: Callable[[Repair], bool] | None = None) -> Outcome:
        """What is learned from all that is known by now."""
        meshes = self.family.meshes()
        with interruptible() as stop:
            outcome = self.project.synthesize(
                accept=self.keep,
                options=self.options,
                confirm=confirm,
                stop=stop,
                answers=tuple(self.given.values()),
                meshes=meshes,
                follow=self.follow,
            )
            self.stopped = stop()
        return outcome

    def answer(self, answer: Answer) -> None:
        """Take an answer into account from now on. Raises ProjectError: no such asset or rule."""
        if self.keep:
            self.project.add_answer(answer)
        else:
            self.given[answer.rule, answer.asset] = answer

    @cached_property
    def family(self) -> Family:
        from meshforge.project import Family

        return Family(self.project)

    @property
    def ids_in_use(self) -> tuple[str, ...]:
        """The ids of the assets to learn from."""
        from meshforge.project import looked_at

        return looked_at(self.project)

    def meshes(self) -> dict[str, SymbolicMesh]:
        """The assets that can be read."""
        return self.family.meshes()
