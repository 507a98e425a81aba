"""The base of all edits, and versions of what pages edit as a whole, so that no page overwrites unseen changes."""

from abc import abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import ClassVar

from meshforge.common import file_digest
from meshforge.project import Project
from meshforge.store import History, HistoryEntry, ProjectFile
from meshforge.studio.wire import Wire

LabelsByAsset = Mapping[str, Mapping[str, str | None]]
"""Labels of hulls by their names, by asset; None where one is taken away."""


class Edit(Wire):
    """One change that a person makes to a project, as the page sends it and the history keeps it.

    touches: the files that `apply` may change: where the edit is of one `asset`, those of that asset, else of all; undo
    puts back what was in them. title: what it does, with its fields in braces, where `describe` says no more.
    """

    touches: ClassVar[tuple[ProjectFile, ...]] = ()
    title: ClassVar[str] = ""

    @abstractmethod
    def apply(self, project: Project) -> None:
        """Make the change; on disk when this returns. Raises MeshForgeError, with nothing changed."""

    def describe(self, project: Project) -> str:
        """Return what it does, in a few words: `label 3 hulls of table_04 as leg`."""
        return self.title.format_map(dict(self))

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        """Return the files and folders that `apply` may change."""
        asset: str | None = getattr(self, "asset", None)
        return tuple(file.path(project.folder, asset) for file in self.touches)

    def list_labels(self) -> LabelsByAsset:
        """Return the labels that `apply` gives, as far as they are known without reading anything."""
        return {}


def make_edit(history: History, project: Project, edit: Edit, by: str | None = None) -> HistoryEntry | None:
    """Make an edit; it is on disk with its entry when this returns. None where it changed nothing."""
    with project.lock():
        title, data, paths = edit.describe(project), edit.model_dump(mode="json"), edit.list_paths(project)
        with history.record(title, data, paths, by=by) as at:
            edit.apply(project)
        entries = history.entries
    return entries[-1] if len(entries) > at else None


def steps_version(project: Project, asset: str) -> str:
    """Return the version of the steps of an asset; empty where nothing is demonstrated."""
    return _digest_or_empty(project.layout.demonstration(asset))


def program_version(project: Project) -> str:
    """Return the version of the accepted program; empty where there is none."""
    return _digest_or_empty(project.layout.program)


def _digest_or_empty(path: Path) -> str:
    try:
        return file_digest(path)
    except FileNotFoundError:
        return ""
