"""The start page of a studio: what it shows, and what can be asked there; and the projects that were open before, in a
small file of the user's state folder."""

import logging
import os
import shutil
from collections.abc import Mapping
from contextlib import suppress
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory
from time import time
from typing import assert_never

from meshforge.batch import SETTINGS, hold_lock
from meshforge.common import MeshForgeError, ProjectError, file_state, is_file
from meshforge.project import Project, create_tour_project
from meshforge.samples import FAMILIES, family_of, write_family
from meshforge.store.layout import JsonFile, Layout, read_derived, write_json
from meshforge.store.settings import read_settings
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
        self._home = TemporaryDirectory(prefix="meshforge-")
        self.uploads = Uploads(Path(self._home.name) / "uploads")  # files that were sent for a new project

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
            tour=str(folders.suggest_project("tables-tour")),
        )

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
                family = family_of(request.family)
                with folders.build_project(project) as draft:
                    home = draft / ASSETS_FOLDER
                    write_family(family, home)
                    Project.create(draft, [home / family.pattern], name=project.name, vocabulary=family.vocabulary)
            case wire.ProjectOfTour():
                with folders.build_project(project) as draft:
                    create_tour_project(draft, draft / ASSETS_FOLDER, project.name)
            case _:
                assert_never(request)
        return project

    def rest(self) -> None:
        """Free what only the start page needs, as a project is open."""
        self._workers.close()
        self._workers = Workers(READERS)
        self.uploads.clear()

    def close(self) -> None:
        """Stop all work, and remove what was sent."""
        self._workers.close()
        self._home.cleanup()


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
            inside = list(home.iterdir())  # ids count from the one folder that was sent, where all files lie in it
            one = inside[0] if len(inside) == 1 and inside[0].is_dir() else home
            Project.create(draft, [one], name=project.name)
        except BaseException:
            shutil.move(home, upload)
            raise


_LOG = logging.getLogger(__name__)

MOST_RECENT = 100
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
    state: str = ""
    seen: float = 0.0


def _describe_state(entry: _Entry) -> str:
    """How far a project was when it was seen last, as far as its files are as they were; or why it cannot be read."""
    folder = Path(entry.folder)
    try:
        read_settings(folder)
        files = [folder / name for name in (SETTINGS, "program.mf", "events.jsonl", "signoffs.jsonl", "labels")]
        changed = max(found[1] / 1e9 for file in files if (found := file_state(file)))
    except MeshForgeError as error:
        return error.message.split("\n")[0]
    return entry.state if changed <= entry.seen else "changed since it was left"


def _newest_picture(folder: Path) -> Path | None:
    """The thumbnail of a project that was drawn last."""
    with suppress(OSError):
        found = os.scandir(Layout(folder).studio / "thumbnails")
        rows = [entry for entry in found if entry.name.endswith(".png")]
        return Path(max(rows, key=lambda entry: entry.stat().st_mtime_ns)) if rows else None
    return None


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
                gone=(gone := not is_file(Path(entry.folder) / SETTINGS)),
                state="" if gone else _describe_state(entry),
                picture="" if gone else getattr(_newest_picture(Path(entry.folder)), "name", ""),
            )
            for entry in self._read().projects
        )

    def find_picture(self, folder: str) -> Path | None:
        """Return a thumbnail of a recent project, None where there is none."""
        known = any(entry.folder == folder for entry in self._read().projects)
        return _newest_picture(Path(folder)) if known else None

    def add(self, folder: Path, name: str, assets: int, state: str | None = None) -> None:
        """Put a project first. state: how far it is, in words; None leaves what was said before."""
        now = datetime.now(UTC).isoformat(timespec="seconds")
        before = next((entry for entry in self._read().projects if entry.folder == str(folder)), None)
        text, seen = (before.state, before.seen) if state is None and before else (state or "", time())
        row = _Entry(folder=str(folder), name=name, assets=assets, opened=now, state=text, seen=seen)
        self._change(row.folder, row)

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
