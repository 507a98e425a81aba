"""What every edit has in common."""

from __future__ import annotations

from abc import abstractmethod
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.studio.wire.base import Wire

if TYPE_CHECKING:
    from meshforge.project import Project


class Edit(Wire):
    """One change that a person makes to a project, as the page sends it and the history keeps it.

    It names the files that it changes, so that the history can put back what they held before.
    """

    @abstractmethod
    def apply(self, project: Project) -> None:
        """Make the change; on disk when this returns. Raises MeshForgeError, with nothing changed."""

    @abstractmethod
    def list_paths(self, project: Project) -> tuple[Path, ...]:
        """The files and folders that `apply` may change."""

    @abstractmethod
    def describe(self, project: Project) -> str:
        """What it does, in a few words: `label 3 hulls of table_04 as leg`."""

    def assets(self, project: Project) -> tuple[str, ...]:
        """The ids of the assets that it changes."""
        return ()
