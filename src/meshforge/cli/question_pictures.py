"""Pictures of what a person is asked about, in the project, for as long as it is asked."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.cli.lessons import Lessons

if TYPE_CHECKING:
    from meshforge.language import Program
    from meshforge.symbolic import SymbolicMesh
    from meshforge.synthesis import Question, Repair
    from meshforge.views import Up

SIZE = (720, 560)


class QuestionPictures:
    """Draws into `.meshforge/questions` of a project; every new card takes away the pictures of the one before."""

    def __init__(self, lessons: Lessons) -> None:
        self._session = lessons
        self._folder = lessons.project.layout.questions

    def of_question(self, question: Question, program: Program) -> list[Path]:
        """A picture of each choice, on the asset as the rule meets it; none where it cannot be drawn."""
        from meshforge.errors import MeshForgeError

        self.clear()
        name = f"rule-{question.rule}-{Path(question.asset).stem}"
        try:
            mesh = self._session.project.mesh_before_rule(question.asset, question.rule, program, self._session.meshes())
            return [
                self._draw(mesh, frozenset(choice.select), f"{name}-choice-{k}", f"choice {k} on {question.asset}")
                for k, choice in enumerate(question.choices, 1)
            ]
        except MeshForgeError:
            return []

    def of_repair(self, repair: Repair) -> Path | None:
        """A picture of the hull that may have a wrong label; None where it cannot be drawn."""
        from meshforge.cli.cards import change
        from meshforge.errors import MeshForgeError

        self.clear()
        wrong = repair.correction
        try:
            mesh = self._upright_mesh(wrong.asset)
            return self._draw(mesh, frozenset({wrong.hull}), f"label-{Path(wrong.asset).stem}", change(repair))
        except MeshForgeError:
            return None

    def clear(self) -> None:
        """Take all pictures away."""
        shutil.rmtree(self._folder, ignore_errors=True)

    def _upright_mesh(self, asset: str) -> SymbolicMesh:
        from meshforge.language import Program

        return self._session.project.mesh_before_rule(
            asset, 1, Program(orient=self._session.project.orientation), self._session.meshes()
        )

    def _draw(self, mesh: SymbolicMesh, chosen: frozenset[str], name: str, title: str) -> Path:
        from meshforge.views import render, write_png

        path, here = self._folder / f"{name}.png", Path.cwd()
        up: Up | None = "Z" if self._has_upright_axis else None
        write_png(path, render(mesh, highlight=chosen, size=SIZE, title=title, up=up))
        return path.relative_to(here) if path.is_relative_to(here) else path

    @property
    def _has_upright_axis(self) -> bool:
        """Whether the orientation says what +Z is, so that Z points up whatever the files say."""
        orient = self._session.project.orientation
        return orient is not None and any(pair.axis.endswith("Z") for pair in orient.pairs)
