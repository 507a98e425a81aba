"""What every edit has in common, and versions of what pages edit as a whole, so that none overwrites what it has not
seen."""

from __future__ import annotations

from abc import abstractmethod
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.batch import file_digest
from meshforge.studio.wire import Wire

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


def steps_version(project: Project, asset: str) -> str:
    """The version of the steps that are demonstrated on an asset; empty where nothing is."""
    return _digest_or_empty(project.layout.demonstration(asset))


def program_version(project: Project) -> str:
    """The version of the accepted program; empty where there is none."""
    return _digest_or_empty(project.layout.program)


def _digest_or_empty(path: Path) -> str:
    try:
        return file_digest(path)
    except FileNotFoundError:
        return ""


def program_files(project: Project) -> tuple[Path, ...]:
    """The files that accepting a program writes."""
    program = project.layout.program
    return program, program.with_name("program.previous.mf"), project.layout.learned
