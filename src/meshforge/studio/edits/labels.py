"""Edits of labels and of the vocabulary, by a person or by a job."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from meshforge.common import pluralize
from meshforge.project import Project
from meshforge.studio.edits.base import Edit, JobEdit, program_files


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
        hulls = f"{pluralize(len(self.hulls), 'hull')} of {self.asset}"
        return f"{hulls} labelled {self.label}" if self.label else f"label of {hulls} taken away"


class _LabelsEdit(Edit):
    """An edit of the labels of all assets."""

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.folder / "labels",)


class LabelFromFiles(Edit):
    """Take over the labels files beside the assets."""

    kind: Literal["label-files"] = "label-files"

    def apply(self, project: Project) -> None:
        project.label_from_files()

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.settings, project.layout.folder / "labels")

    def describe(self, project: Project) -> str:
        return "labels taken over from files"


class LabelFromNames(_LabelsEdit):
    """Label hulls without a label by the words in their names and in the names of their bodies."""

    kind: Literal["label-names"] = "label-names"

    def apply(self, project: Project) -> None:
        project.label_from_names()

    def describe(self, project: Project) -> str:
        return "labels taken from names"


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


class Propagate(JobEdit, _LabelsEdit):
    """A job propagated labels to all other hulls. next: the asset that would help most if it were labelled; used: how
    many entries the history had when labels were read."""

    kind: Literal["propagate"] = "propagate"
    used: int
    next: str | None

    def describe(self, project: Project) -> str:
        return "labels propagated"


class LabelFromModel(JobEdit, _LabelsEdit):
    """A job asked a model for labels."""

    kind: Literal["label-vlm"] = "label-vlm"
    model: str

    def describe(self, project: Project) -> str:
        return f"labels from {self.model}"
