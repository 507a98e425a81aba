"""Makes new projects: of a folder of assets, of uploaded files, and of a bundled family."""

from __future__ import annotations

import shutil
from pathlib import Path

from meshforge.common import ProjectError
from meshforge.project import Project
from meshforge.samples import SampleFamily, family_of, write_family
from meshforge.studio.start.building import build_project
from meshforge.studio.start.folders import check_folder, is_project

ASSETS_FOLDER = "assets"
"""The folder of a project for assets of its own."""


def create_of_folder(assets: Path, project: Path, state: Path) -> None:
    """Make a project of the assets in a folder, which stay where they are. Raises UsageError for either folder."""
    check_folder(assets)
    if is_project(assets):
        raise ProjectError("this folder is a project itself", where=str(assets), remedy="Open it instead.")
    with build_project(project, state) as draft:
        # seen from the draft, everything lies where it lies from the project that it becomes
        Project.create(draft, [assets], name=project.name)


def create_of_upload(upload: Path, project: Path, state: Path) -> None:
    """Make a project of uploaded files, which come into its own folder. upload: the folder they lie in, which goes."""
    with build_project(project, state) as draft:
        home = draft / ASSETS_FOLDER
        shutil.move(upload, home)
        try:
            Project.create(draft, [_innermost_folder(home)], name=project.name)
        except BaseException:
            shutil.move(home, upload)
            raise


def create_of_family(name: str, project: Path, state: Path) -> SampleFamily:
    """Make a project of a bundled family. Raises UsageError for a name that no family has."""
    family = family_of(name)
    with build_project(project, state) as draft:
        home = draft / ASSETS_FOLDER
        write_family(family, home)
        Project.create(draft, [home / family.pattern], name=project.name, vocabulary=family.vocabulary)
    return family


def _innermost_folder(home: Path) -> Path:
    """The folder that ids count from: the one folder that was sent, where all files lie in it."""
    inside = list(home.iterdir())
    return inside[0] if len(inside) == 1 and inside[0].is_dir() else home
