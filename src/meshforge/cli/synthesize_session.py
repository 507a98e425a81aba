"""Learning again after each thing that a person said, and pictures of what is asked, in the project while it is
asked."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from meshforge.cli.synthesize_text import describe_change
from meshforge.cli.terminal import catch_interrupt
from meshforge.common import MeshForgeError
from meshforge.language import Program
from meshforge.project import FamilyMeshes, Project, select_assets
from meshforge.rendering import Up, render, write_png
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Answer, LearningOutcome, Options, Question, Repair

PICTURE_SIZE = (720, 560)


@dataclass
class LearningSession:
    """Learns as often as it is asked to.

    keep: whether programs, answers and repairs are kept in the project. stopped: whether a person ended the last
    search; given: answers that are not kept.
    """

    project: Project
    options: Options
    keep: bool = True
    stopped: bool = False
    given: dict[tuple[int, str], Answer] = field(default_factory=dict)

    def learn(self, confirm: Callable[[Repair], bool] | None = None) -> LearningOutcome:
        """What is learned from all that is known by now."""
        meshes = self.family.meshes()
        with catch_interrupt() as stop:
            outcome = self.project.synthesize(
                accept=self.keep,
                options=self.options,
                confirm=confirm,
                stop=stop,
                answers=tuple(self.given.values()),
                meshes=meshes,
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
    def family(self) -> FamilyMeshes:
        return FamilyMeshes(self.project)

    @property
    def ids_in_use(self) -> tuple[str, ...]:
        """The ids of the assets to learn from."""
        return select_assets(self.project)

    def meshes(self) -> dict[str, SymbolicMesh]:
        """The assets that can be read."""
        return self.family.meshes()


class QuestionPictures:
    """Draws into `.meshforge/questions` of a project; every new card takes away the pictures of the one before."""

    def __init__(self, session: LearningSession) -> None:
        self._session = session
        self._folder = session.project.layout.questions

    def of_question(self, question: Question, program: Program) -> list[Path]:
        """A picture of each choice, on the asset as the rule meets it; none where it cannot be drawn."""
        self.clear()
        name = f"rule-{question.rule}-{Path(question.asset).stem}"
        try:
            mesh = self._session.project.mesh_before_rule(
                question.asset, question.rule, program, self._session.meshes()
            )
            return [
                self._draw(mesh, frozenset(choice.select), f"{name}-choice-{k}", f"choice {k} on {question.asset}")
                for k, choice in enumerate(question.choices, 1)
            ]
        except MeshForgeError:
            return []

    def of_repair(self, repair: Repair) -> Path | None:
        """A picture of the hull that may have a wrong label; None where it cannot be drawn."""
        self.clear()
        wrong = repair.correction
        try:
            mesh = self._upright_mesh(wrong.asset)
            return self._draw(mesh, frozenset({wrong.hull}), f"label-{Path(wrong.asset).stem}", describe_change(repair))
        except MeshForgeError:
            return None

    def clear(self) -> None:
        """Take all pictures away."""
        shutil.rmtree(self._folder, ignore_errors=True)

    def _upright_mesh(self, asset: str) -> SymbolicMesh:
        return self._session.project.mesh_before_rule(
            asset, 1, Program(orient=self._session.project.orientation), self._session.meshes()
        )

    def _draw(self, mesh: SymbolicMesh, chosen: frozenset[str], name: str, title: str) -> Path:
        path, here = self._folder / f"{name}.png", Path.cwd()
        up: Up | None = "Z" if self._has_upright_axis else None
        write_png(path, render(mesh, highlight=chosen, size=PICTURE_SIZE, title=title, up=up))
        return path.relative_to(here) if path.is_relative_to(here) else path

    @property
    def _has_upright_axis(self) -> bool:
        """Whether the orientation says what +Z is, so that Z points up whatever the files say."""
        orient = self._session.project.orientation
        return orient is not None and any(pair.axis.endswith("Z") for pair in orient.pairs)
