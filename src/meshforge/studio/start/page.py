"""The start page of a studio: what it shows, and what can be asked there; and the projects that were open before, in a
small file of the user's state folder."""

import logging
import os
import shutil
from collections.abc import Mapping
from contextlib import ExitStack
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import assert_never

from meshforge.batch import SETTINGS, hold_lock
from meshforge.common import MeshForgeError, ProjectError, is_file
from meshforge.project import Project
from meshforge.samples import FAMILIES, family_of, write_family
from meshforge.store.layout import JsonFile, read_derived, write_json
from meshforge.studio.start import folders
from meshforge.studio.transfers import Uploads
from meshforge.studio.wire import start as wire
from meshforge.studio.wire.start import RecentProject
from meshforge.studio.workers import Workers

READERS = 2
"""Processes that look at assets before a project is made of them."""
ASSETS_FOLDER = "assets"
"""The folder of a project for assets of its own."""


class StartPage:
    """Lists projects and folders, takes uploads, and makes projects. state: the user's state folder."""

    def __init__(self, state: Path) -> None:
        self.recent = RecentProjects(state)
        self._workers = Workers(READERS)
        self._stack = ExitStack()
        self._uploads: Uploads | None = None

    def begin(self) -> None:
        """Get ready for people, as no project is open."""
        self._workers.start(folders.is_project, Path.home())  # so that the first look is quick

    @property
    def view(self) -> wire.StartView:
        """What the start page shows."""
        return wire.StartView(
            version=version("meshforge"),
            recent=self.recent.list(),
            families=tuple(
                wire.FamilyOffer(name=one.name, about=one.about, project=str(folders.suggest_project(one.name)))
                for one in FAMILIES
            ),
            places=tuple(dict.fromkeys(map(str, (Path.cwd(), Path.home())))),
        )

    @property
    def uploads(self) -> Uploads:
        """Files that were sent for a new project; in a folder that goes with this studio."""
        if self._uploads is None:
            home = self._stack.enter_context(TemporaryDirectory(prefix="meshforge-"))
            self._uploads = Uploads(Path(home) / "uploads")
        return self._uploads

    def look_at_folder(self, folder: str) -> wire.AssetsFound:
        """Return what a folder holds. Raises UsageError where there is no such folder, or no asset in it."""
        return folders.look_at_folder(self._workers, folders.parse_path(folder, "the folder of assets"))

    def look_at_upload(self) -> wire.AssetsFound:
        """Return what was sent; assets that cannot be read are left out. Raises ProjectError, and throws all away,
        where no project can be made of it."""
        home, files = self.uploads.list_files()
        try:
            sent = self.uploads.keep_readable(self._workers)
        except MeshForgeError:
            self.uploads.clear()
            raise
        tops = {name.split("/")[0] for name in files}
        first = min(tops, key=str.casefold)
        name = first if len(tops) == 1 and (home / first).is_dir() else Path(sent.names[0]).stem
        found = folders.look_at_assets(self._workers, home, [home / path for path in sent.names], name)
        if not sent.problems:
            return found
        return found.model_copy(update={"broken": len(sent.problems), "problem": sent.problems[0], "left_out": True})

    def create(self, request: wire.NewProject) -> Path:
        """Make a project, and give its folder. Raises MeshForgeError where that cannot be; then nothing is written."""
        project = folders.parse_path(request.project, "the folder of the project")
        match request:
            case wire.ProjectOfFolder():
                assets = folders.parse_path(request.folder, "the folder of assets")
                _create_of_folder(assets, project)
            case wire.ProjectOfUpload():
                home, _ = self.uploads.list_files()
                self.uploads.keep_readable(self._workers)  # raises ProjectError where nothing was sent
                _create_of_upload(home, project)
            case wire.ProjectOfFamily():
                _create_of_family(request.family, project)
            case _:
                assert_never(request)
        return project

    def rest(self) -> None:
        """Free what only the start page needs, as a project is open."""
        self._workers.close()
        self._workers = Workers(READERS)
        if self._uploads:
            self._uploads.clear()

    def close(self) -> None:
        """Stop all work, and remove what was sent."""
        self._workers.close()
        if self._uploads:
            self._uploads.clear()
        self._stack.close()


def _create_of_folder(assets: Path, project: Path) -> None:
    """Make a project of the assets in a folder, which stay where they are. Raises UsageError for either folder."""
    folders.check_folder(assets)
    if folders.is_project(assets):
        raise ProjectError("this folder is a project itself", where=str(assets), remedy="Open it instead.")
    with folders.build_project(project) as draft:
        # seen from the draft, everything lies where it lies from the project that it becomes
        Project.create(draft, [assets], name=project.name)


def _create_of_upload(upload: Path, project: Path) -> None:
    """Make a project of uploaded files, which come into its own folder. upload: the folder they lie in, which goes."""
    with folders.build_project(project) as draft:
        home = draft / ASSETS_FOLDER
        shutil.move(upload, home)
        try:
            Project.create(draft, [_innermost_folder(home)], name=project.name)
        except BaseException:
            shutil.move(home, upload)
            raise


def _create_of_family(name: str, project: Path) -> None:
    """Make a project of a bundled family. Raises UsageError for a name that no family has."""
    family = family_of(name)
    with folders.build_project(project) as draft:
        home = draft / ASSETS_FOLDER
        write_family(family, home)
        Project.create(draft, [home / family.pattern], name=project.name, vocabulary=family.vocabulary)


def _innermost_folder(home: Path) -> Path:
    """The folder that ids count from: the one folder that was sent, where all files lie in it."""
    inside = list(home.iterdir())
    return inside[0] if len(inside) == 1 and inside[0].is_dir() else home


_LOG = logging.getLogger(__name__)

MOST_RECENT = 30
"""Projects that are remembered."""


def state_folder(environment: Mapping[str, str] = os.environ) -> Path:
    """Return where the studio remembers things: `MESHFORGE_STATE`, else `XDG_STATE_HOME/meshforge`, else
    `~/.local/state/meshforge`."""
    if own := environment.get("MESHFORGE_STATE"):
        return Path(own)
    base = environment.get("XDG_STATE_HOME")
    return (Path(base) if base else Path.home() / ".local" / "state") / "meshforge"


class _Entry(JsonFile):
    folder: str
    name: str
    assets: int = 0
    opened: str = ""


class _RecentFile(JsonFile):
    projects: tuple[_Entry, ...] = ()


class RecentProjects:
    """The projects that were open before, the last one first. state: the user's state folder.

    A list that cannot be read is an empty one, and one that cannot be written stays as it was: neither keeps anybody
    from opening a project.
    """

    def __init__(self, state: Path) -> None:
        self._path, self._lock = state / "recent.json", state / "recent.lock"

    def list(self) -> tuple[RecentProject, ...]:
        """Return all of them, those that are gone too."""
        return tuple(
            RecentProject(
                folder=entry.folder,
                name=entry.name,
                assets=entry.assets,
                opened=entry.opened,
                gone=not is_file(Path(entry.folder) / SETTINGS),
            )
            for entry in self._read().projects
        )

    def add(self, folder: Path, name: str, assets: int) -> None:
        """Put a project first."""
        now = datetime.now(UTC).isoformat(timespec="seconds")
        self._change(str(folder), _Entry(folder=str(folder), name=name, assets=assets, opened=now))

    def forget(self, folder: str) -> None:
        """Take a project off the list; its files stay."""
        self._change(folder, None)

    def _change(self, folder: str, first: _Entry | None) -> None:
        try:
            with hold_lock(self._lock, str(self._path)):
                kept = self._read()
                rest = [entry for entry in kept.projects if entry.folder != folder]
                projects = tuple([*([first] if first else []), *rest][:MOST_RECENT])
                write_json(self._path, kept.model_copy(update={"projects": projects}))
        except (OSError, MeshForgeError):
            _LOG.debug("the list of recent projects cannot be written", exc_info=True)

    def _read(self) -> _RecentFile:
        return read_derived(self._path, _RecentFile) or _RecentFile()
