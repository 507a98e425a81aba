"""Edits of what a person says while a program is learned, and of the program itself."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from meshforge.language import Program
from meshforge.studio.edits.base import Edit
from meshforge.studio.errors import ConflictError
from meshforge.studio.versions import program_version
from meshforge.synthesis import Answer, Correction

if TYPE_CHECKING:
    from meshforge.project import Project


class AnswerQuestion(Edit):
    """Say which hulls a rule selects on an asset; null: neither of the choices, which are then in `refused`."""

    kind: Literal["answer"] = "answer"
    rule: int
    asset: str
    select: tuple[str, ...] | None
    refused: tuple[tuple[str, ...], ...] = ()

    def apply(self, project: Project) -> None:
        project.add_answer(Answer(self.rule, self.asset, self.select, self.refused))

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.answers,)

    def describe(self, project: Project) -> str:
        return f"rule {self.rule} on {self.asset} answered"


class SettleRepair(Edit):
    """Confirm or refuse a repair of a label."""

    kind: Literal["repair"] = "repair"
    asset: str
    hull: str
    was: str | None
    to: str
    accept: bool

    def apply(self, project: Project) -> None:
        settle = project.confirm if self.accept else project.reject
        settle(Correction(self.asset, self.hull, self.was, self.to))

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.answers, project.layout.labels(self.asset))

    def describe(self, project: Project) -> str:
        how = "is now labelled" if self.accept else "is not"
        return f"{self.hull} of {self.asset} {how} {self.to}"

    def assets(self, project: Project) -> tuple[str, ...]:
        return (self.asset,)


class TakeBack(Edit):
    """Take back an answer or a repair by its id."""

    kind: Literal["take-back"] = "take-back"
    id: str

    def apply(self, project: Project) -> None:
        project.take_back(self.id)

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.answers, project.layout.folder / "labels")

    def describe(self, project: Project) -> str:
        return f"{self.id} taken back"

    def assets(self, project: Project) -> tuple[str, ...]:
        asset = self.id.partition("#")[0]
        return (asset,) if asset in project.assets() else ()


class WriteProgram(Edit):
    """Make a text the project's program. version: of the program that was changed."""

    kind: Literal["program"] = "program"
    text: str
    version: str

    def apply(self, project: Project) -> None:
        if program_version(project) != self.version:
            raise ConflictError(
                "the program was changed elsewhere meanwhile",
                where="program.mf",
                remedy="Copy your text, look at the present one, and do it again.",
            )
        project.accept(Program.parse(self.text))

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return program_files(project)

    def describe(self, project: Project) -> str:
        return "program changed by hand"


def program_files(project: Project) -> tuple[Path, ...]:
    """The files that accepting a program writes."""
    program = project.layout.program
    return program, program.with_name("program.previous.mf"), project.layout.learned
