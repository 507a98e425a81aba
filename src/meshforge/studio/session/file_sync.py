"""Keeping what pages are shown in step with the files of a project, whoever changes them: this studio, a command, an
editor."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from stat import S_ISDIR
from threading import Event, Thread
from typing import TYPE_CHECKING

from meshforge.batch import SETTINGS, STATE, source_files
from meshforge.common import MeshForgeError, relative_name
from meshforge.project import Project
from meshforge.store import Review
from meshforge.studio.queries.programs import read_program_view
from meshforge.studio.queries.project import vocabulary_view
from meshforge.studio.wire.program import ProgramView

if TYPE_CHECKING:
    from meshforge.studio.session.session import Session


_LOG = logging.getLogger(__name__)

PROGRAM_FILE, PREVIOUS_FILE, LEARNED_FILE = "program.mf", "program.previous.mf", f"{STATE}/learned.json"
_STAMPS = f"edited/{STATE}/stamps/"
_ASSET_FOLDERS = ("labels/", "demonstrations/", "corrections/", _STAMPS)
_LEARNING_FOLDERS = ("labels/", "demonstrations/", "prepared/", "templates/")
_LEARNING_FILES = frozenset(("answers.json", "review.json", PROGRAM_FILE))

POLL_SECONDS = 1.5
"""Seconds between two looks."""
_WATCH_FOLDERS = ("labels", "demonstrations", "corrections", "prepared", "templates", f"edited/{STATE}/stamps")
_WATCH_FILES = (SETTINGS, "answers.json", "program.mf", "review.json", f"{STATE}/learned.json")

FileStamps = dict[str, tuple[int, int]]
"""Modification time [ns] and size of each file, by its path from the project's folder."""


class FileSync:
    """Looks anew at what depends on files that changed. All is called by who has the desk for himself."""

    def __init__(self, desk: Session) -> None:
        self._desk = desk
        self._stamps = read_stamps(desk.project)
        self._reviews = desk.project.reviews()

    def update(self, names: Iterable[str]) -> None:
        """Files are other now; names: paths from the project's folder."""
        desk, names = self._desk, frozenset(names)
        self._note_stamps(names)
        changes = changes_of(desk.project, names)
        if changes.settings:
            self.reopen()
        other = self.show_program() if changes.settings or changes.program else False
        if changes.learning:  # before the rest, as it takes longest
            desk.learning.restart()
        desk.pages.announce_assets(sorted(changes.assets), bool(changes.shapes))
        desk.refresh_queue.add(changes.assets, later=changes.settings)
        if changes.reviews:
            desk.refresh_queue.add(self._update_reviews())
        if other and not changes.learning:
            desk.learning.measure_reach()

    def show_program(self) -> bool:
        """Show the accepted program; whether it is another one, so that outputs may be stale."""
        desk = self._desk
        self._note_stamps((PROGRAM_FILE, LEARNED_FILE))
        other = desk.pages.set_program(_view_program(desk.project, desk.pages.program))
        if other:
            desk.refresh_queue.add([card.asset for card in desk.pages.cards if card.output != "none"], later=True)
            desk.pages.announce_assets(desk.project.layout.ids_with("demonstrations"), shapes=False)
        return other

    def reopen(self) -> None:
        """Look for assets that came or went; the vocabulary is shown at once, as keys have a meaning by it."""
        desk = self._desk
        desk.project = desk.project.with_assets(Project.open(desk.project.folder).found)
        desk.pages.set_vocabulary(vocabulary_view(desk.project.settings.vocabulary, desk.pages.cards))
        desk.refresh_queue.add(desk.pages.set_assets(desk.project.assets()), later=True)

    def poll(self) -> None:
        """See whether others changed something. Never raises: what cannot be read is told, and looked at again."""
        desk = self._desk
        now = read_stamps(desk.project)
        other = diff_stamps(self._stamps, now)
        self._stamps = now
        try:
            if any((desk.project.folder / name).is_dir() for name in other):
                self.reopen()
            if other:
                self.update(other)
        except MeshForgeError as error:
            desk.pages.set_problem(error.message)
        except Exception:  # the next look may succeed; the watch itself must go on
            _LOG.debug("looking at what others changed failed", exc_info=True)

    def _note_stamps(self, names: Iterable[str]) -> None:
        names = frozenset(names)
        kept = {name: at for name, at in self._stamps.items() if name not in names}
        self._stamps = kept | read_stamps_of(self._desk.project.folder, names)

    def _update_reviews(self) -> list[str]:
        """The assets of which something else is said now."""
        before: dict[str, Review] = self._reviews
        self._reviews = now = self._desk.project.reviews()
        return [asset for asset in before | now if before.get(asset) != now.get(asset)]


def _view_program(project: Project, before: ProgramView) -> ProgramView:
    try:
        return read_program_view(project)
    except MeshForgeError as error:  # what it was learned from cannot be read
        return before.model_copy(update={"error": error.message})


@dataclass(frozen=True, slots=True)
class FileChanges:
    """assets: ids of which something changed; shapes: those of them whose hulls may be others.

    settings, program: whether these changed; reviews: what was said about outputs; lesson: whether there is other to
    learn from.
    """

    assets: frozenset[str] = field(default_factory=frozenset)
    shapes: frozenset[str] = field(default_factory=frozenset)
    settings: bool = False
    program: bool = False
    reviews: bool = False
    learning: bool = False


def changes_of(project: Project, names: Iterable[str]) -> FileChanges:
    """What a change of files means; names: paths from the project's folder."""
    names = frozenset(names)
    prepared = {name.removeprefix("prepared/").rpartition("/")[0] for name in names if name.startswith("prepared/")}
    files = {relative_name(path, project.folder): asset for asset, path in project.found.ids.items()}
    shapes = (prepared | {files[name] for name in names if name in files}) & project.found.ids.keys()
    kept = {name: kind for kind in _ASSET_FOLDERS for name in names if name.startswith(kind)}
    own = {name.removeprefix(kind).removesuffix(".json") for name, kind in kept.items()}
    settings = SETTINGS in names
    return FileChanges(
        assets=frozenset(project.assets()) if settings else frozenset((own & project.found.ids.keys()) | shapes),
        shapes=frozenset(shapes),
        settings=settings,
        program=bool(names & {PROGRAM_FILE, LEARNED_FILE}),
        reviews="review.json" in names,
        learning=settings
        or bool(shapes)
        or any(n.startswith(_LEARNING_FOLDERS) or n in _LEARNING_FILES for n in names),
    )


def read_stamps(project: Project) -> FileStamps:
    """How the files are that a project lives in, and those of its assets; folders of assets, where new ones come."""
    folder = project.folder
    assets = [file for path in project.found.paths for file in _source_files(path)]
    homes = {path.parent for path in project.found.paths}
    kept = (file for name in _WATCH_FOLDERS for file in (folder / name).rglob("*") if not file.name.startswith("."))
    files = dict(_stamp_files([*(folder / name for name in _WATCH_FILES), *kept, *assets], folder))
    return files | dict(_stamp_files(homes, folder, folders=True))


def diff_stamps(before: FileStamps, now: FileStamps) -> frozenset[str]:
    """The names of files that are other, new or gone."""
    return frozenset(name for name in before | now if before.get(name) != now.get(name))


def _source_files(path: Path) -> list[Path]:
    try:
        return source_files(path)
    except OSError:
        return []


def read_stamps_of(folder: Path, names: Iterable[str]) -> FileStamps:
    """The same for files by their names."""
    return dict(_stamp_files((folder / name for name in names), folder))


def _stamp_files(paths: Iterable[Path], root: Path, folders: bool = False) -> Iterator[tuple[str, tuple[int, int]]]:
    for path in paths:
        try:
            stat = path.stat()
        except OSError:
            continue
        if S_ISDIR(stat.st_mode) == folders:
            yield relative_name(path, root), (stat.st_mtime_ns, stat.st_size)


class FileWatcher:
    """A thread that looks every now and then."""

    def __init__(self, look_again: Callable[[], None]) -> None:
        self._look_again = look_again
        self._closed = Event()
        self._thread = Thread(target=self._run, name="watch", daemon=True)

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def close(self) -> None:
        """Stop, and wait for the end of a look."""
        self._closed.set()
        if self._thread.is_alive():
            self._thread.join()

    def _run(self) -> None:
        while not self._closed.wait(POLL_SECONDS):
            self._look_again()
