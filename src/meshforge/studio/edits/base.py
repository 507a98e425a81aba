"""The base of all edits, and versions of what pages edit as a whole, so that no page overwrites unseen changes."""

from __future__ import annotations

from abc import abstractmethod
from pathlib import Path

from meshforge.batch import file_digest
from meshforge.project import Project
from meshforge.studio.wire import Wire


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


def program_files(project: Project) -> tuple[Path, ...]:
    """The files that accepting a program writes."""
    program = project.layout.program
    return program, program.with_name("program.previous.mf"), project.layout.learned
