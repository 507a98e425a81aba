"""Edits of labels and of the vocabulary, by a person or by a job."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from meshforge.common import pluralize
from meshforge.studio.edits.base import Edit, program_files

if TYPE_CHECKING:
    from meshforge.project import Project


class LabelHulls(Edit):
    """Label some hulls of an asset; null takes their labels away."""

    kind: Literal["label"] = "label"
    asset: str
    hulls: tuple[str, ...]
    label: str | None

    def apply(self, project: Project) -> None:
        project.set_labels(self.asset, dict.fromkeys(self.hulls, self.label))

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.labels(self.asset),)

    def describe(self, project: Project) -> str:
        hulls = pluralize(len(self.hulls), "hull")
        done = f"{hulls} of {self.asset} labelled {self.label}"
        return done if self.label else f"label of {hulls} of {self.asset} taken away"

    def assets(self, project: Project) -> tuple[str, ...]:
        return (self.asset,)


class LabelFromFiles(Edit):
    """Take over the labels files beside the assets."""

    kind: Literal["label-files"] = "label-files"

    def apply(self, project: Project) -> None:
        project.label_from_files()

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.settings, project.layout.folder / "labels")

    def describe(self, project: Project) -> str:
        return "labels taken over from files"

    def assets(self, project: Project) -> tuple[str, ...]:
        return project.assets()


class LabelFromNames(Edit):
    """Label hulls without a label by the words in their names and in the names of their bodies."""

    kind: Literal["label-names"] = "label-names"

    def apply(self, project: Project) -> None:
        project.label_from_names()

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.folder / "labels",)

    def describe(self, project: Project) -> str:
        return "labels taken from names"

    def assets(self, project: Project) -> tuple[str, ...]:
        return project.assets()


class SetVocabulary(Edit):
    """Set the labels that hulls can have, in the order of their colours."""

    kind: Literal["vocabulary"] = "vocabulary"
    labels: tuple[str, ...]

    def apply(self, project: Project) -> None:
        project.set_vocabulary(self.labels)

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.settings,)

    def describe(self, project: Project) -> str:
        return f"vocabulary: {', '.join(self.labels) or 'empty'}"


class RenameLabel(Edit):
    """Give a label of the vocabulary another name, wherever it is used."""

    kind: Literal["rename-label"] = "rename-label"
    old: str
    new: str

    def apply(self, project: Project) -> None:
        project.rename_label(self.old, self.new)

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        layout = project.layout
        folders = (layout.folder / "labels", layout.folder / "demonstrations", layout.folder / "corrections")
        return (layout.settings, *folders, layout.answers, *program_files(project))

    def describe(self, project: Project) -> str:
        return f"{self.old} renamed {self.new}"

    def assets(self, project: Project) -> tuple[str, ...]:
        return project.assets()


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
