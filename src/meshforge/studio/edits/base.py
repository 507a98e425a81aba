"""The base of all edits, and versions of what pages edit as a whole, so that no page overwrites unseen changes."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import ClassVar

from meshforge.batch import STATE
from meshforge.common import file_digest
from meshforge.project import Project
from meshforge.studio.wire import Wire

PROGRAM_FILE, PREVIOUS_FILE = "program.mf", "program.previous.mf"
EVENTS_FILE = "events.jsonl"
LEARNED_FILE, LEARNED_BEFORE = "learned.json", f"{STATE}/learned.json"
"""What the program was learned from, and where that was kept before (`Layout.learned_before`)."""
PROGRAM_FILES = (PROGRAM_FILE, PREVIOUS_FILE, LEARNED_FILE, LEARNED_BEFORE)
"""The files that accepting a program writes, from the project's folder."""

PREPARED_FILES = (
    "prepared/{asset}",
    "labels/{asset}.json",
    "demonstrations/{asset}.json",
    "corrections/{asset}.json",
    EVENTS_FILE,
)
"""The files that preparing an asset writes."""

LABELS = ("labels", "label_sources.json")
"""The files that labels from files and names write."""

LabelsByAsset = Mapping[str, Mapping[str, str | None]]
"""Labels of hulls by their names, by asset; None where one is taken away."""


class Edit(Wire):
    """One change that a person makes to a project, as the page sends it and the history keeps it.

    touches: the files and folders that `apply` may change, from the project's folder, `{asset}` standing for the field;
    the history puts back what they held before.
    """

    touches: ClassVar[tuple[str, ...]]

    @abstractmethod
    def apply(self, project: Project) -> None:
        """Make the change; on disk when this returns. Raises MeshForgeError, with nothing changed."""

    @abstractmethod
    def describe(self, project: Project) -> str:
        """What it does, in a few words: `label 3 hulls of table_04 as leg`."""

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        """The files and folders that `apply` may change."""
        return tuple(project.folder / name.format(**dict(self)) for name in self.touches)

    def list_labels(self) -> LabelsByAsset:
        """The labels that `apply` gives, as far as they are known without reading anything."""
        return {}


class JobEdit(Edit):
    """An edit that a job makes: the job itself changes the files, and the history records it."""

    def apply(self, project: Project) -> None:
        raise AssertionError("a job makes this change")


def steps_version(project: Project, asset: str) -> str:
    """The version of the steps of an asset; empty where nothing is demonstrated."""
    return _digest_or_empty(project.layout.demonstration(asset))


def program_version(project: Project) -> str:
    """The version of the accepted program; empty where there is none."""
    return _digest_or_empty(project.layout.program)


def _digest_or_empty(path: Path) -> str:
    try:
        return file_digest(path)
    except FileNotFoundError:
        return ""
