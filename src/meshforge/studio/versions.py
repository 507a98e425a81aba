"""Versions of what pages edit as a whole, so that no page overwrites what it has not seen."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.batch import file_digest

if TYPE_CHECKING:
    from meshforge.project import Project


def steps_version(project: Project, asset: str) -> str:
    """The version of the steps that are demonstrated on an asset; empty where nothing is."""
    return _version(project.layout.demonstration(asset))


def program_version(project: Project) -> str:
    """The version of the accepted program; empty where there is none."""
    return _version(project.layout.program)


def _version(path: Path) -> str:
    try:
        return file_digest(path)
    except FileNotFoundError:
        return ""
