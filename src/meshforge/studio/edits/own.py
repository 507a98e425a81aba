"""Edits that the studio makes of itself: what came of a job, of an upload, or of a lesson; no page can send them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from meshforge.studio.edits.base import Edit
from meshforge.studio.edits.learning import program_files
from meshforge.words import counted, listed

if TYPE_CHECKING:
    from meshforge.project import Project


class Decompose(Edit):
    """Hulls were made of what an asset has none for; the job makes the change itself."""

    asset: str

    def apply(self, project: Project) -> None:
        raise AssertionError("the job of decomposing makes this change")

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.preparation(self.asset), project.layout.labels(self.asset))

    def describe(self, project: Project) -> str:
        return f"{self.asset} decomposed"


class Propagate(Edit):
    """Labels were carried over to all other hulls; the job makes the change itself. next: the asset that would help
    most if it were labelled; used: how many entries the history had when labels were read."""

    kind: Literal["propagate"] = "propagate"
    used: int
    next: str | None

    def apply(self, project: Project) -> None:
        raise AssertionError("the job of carrying labels over makes this change")

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.folder / "labels",)

    def describe(self, project: Project) -> str:
        return "labels carried over"

    def assets(self, project: Project) -> tuple[str, ...]:
        return project.assets()


class LabelFromModel(Edit):
    """A model was asked for labels; the job makes the change itself."""

    kind: Literal["label-vlm"] = "label-vlm"
    model: str

    def apply(self, project: Project) -> None:
        raise AssertionError("the job of asking makes this change")

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.folder / "labels",)

    def describe(self, project: Project) -> str:
        return f"labels from {self.model}"

    def assets(self, project: Project) -> tuple[str, ...]:
        return project.assets()


class AddTemplate(Edit):
    """Keep an uploaded file as a template. file: where it lies."""

    name: str
    file: str

    def apply(self, project: Project) -> None:
        project.add_template(self.name, Path(self.file).read_bytes())

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.templates[1] / self.name,)

    def describe(self, project: Project) -> str:
        return f"template {self.name} added"


class AddAssets(Edit):
    """Take uploaded files into the project. staged: the folder they lie in; files: their paths there; assets: of those
    files the ones that are assets, the others being their parts; home: the folder they come to."""

    staged: str
    files: tuple[str, ...]
    added: tuple[str, ...]
    home: str

    def apply(self, project: Project) -> None:
        home = Path(self.home)
        for name in self.files:
            (home / name).parent.mkdir(parents=True, exist_ok=True)
            (Path(self.staged) / name).replace(home / name)
        project.add_assets([home / name for name in self.added])

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.settings, *(Path(self.home) / name for name in self.files))

    def describe(self, project: Project) -> str:
        return f"{counted(len(self.added), 'asset')} added: {listed(self.added, most=2)}"


class TakeLearned(Edit):
    """Give up the program that was written by hand, so that the learned one takes its place."""

    def apply(self, project: Project) -> None:
        for path in program_files(project)[::2]:
            path.unlink(missing_ok=True)

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return program_files(project)

    def describe(self, project: Project) -> str:
        return "the learned program taken in place of the one by hand"
