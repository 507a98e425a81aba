"""Keeps what pages show in step with the files of a project: this studio, a command or an editor may change them."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from stat import S_ISDIR
from threading import Event, Thread
from time import monotonic

from meshforge.batch import SETTINGS, STATE, source_files
from meshforge.common import MeshForgeError, relative_name
from meshforge.project import Project
from meshforge.store import Feedback
from meshforge.studio.edits.base import EVENTS_FILE, LEARNED_FILE, PROGRAM_FILE
from meshforge.studio.learning.scheduler import LearningScheduler
from meshforge.studio.pages import PageState
from meshforge.studio.queries.programs import read_program_view
from meshforge.studio.queries.project import vocabulary_view
from meshforge.studio.session.refresh import RefreshQueue
from meshforge.studio.wire.program import ProgramView

_LOG = logging.getLogger(__name__)

_STAMPS = f"edited/{STATE}/stamps/"
_ASSET_FOLDERS = ("labels/", "demonstrations/", "corrections/", _STAMPS)
_LEARNING_FOLDERS = ("labels/", "demonstrations/", "prepared/", "templates/")
_LEARNING_FILES = frozenset((PROGRAM_FILE,))

PREPARATION_PLAN_FILE = "preparation.json"

POLL_SECONDS = 1.5
"""Seconds between two polls; more where a poll itself takes long, so that it takes a small share of the time."""
_SHARE = 10
_WATCH_FOLDERS = ("labels", "demonstrations", "corrections", "prepared", "templates", f"edited/{STATE}/stamps")
_WATCH_FILES = (
    SETTINGS, PROGRAM_FILE, EVENTS_FILE, LEARNED_FILE, PREPARATION_PLAN_FILE,
)  # fmt: skip

FileStamps = dict[str, tuple[int, int]]
"""Modification time [ns] and size of each file, by its path from the project's folder."""


class FileSync:
    """Refreshes what depends on files that changed. Whoever calls it holds the lock of the session.

    project: the project with the assets that it has now.
    """

    def __init__(self, project: Project, pages: PageState, learning: LearningScheduler, queue: RefreshQueue) -> None:
        self.project = project
        self._pages, self._learning, self._queue = pages, learning, queue
        self._stamps = read_stamps(project)
        self._said = _read_feedback(project)

    def update(self, names: Iterable[str]) -> None:
        """Refresh what depends on files that changed; names: paths from the project's folder."""
        names = frozenset(names)
        self._note_stamps(names)
        changes = changes_of(self.project, names)
        if EVENTS_FILE in names:
            changes = self._add_feedback(changes)
        if changes.settings:
            self.reopen()
        is_other = self.show_program() if changes.settings or changes.program else False
        if changes.learning:  # before the rest, as it takes longest
            self._learning.restart()
        self._pages.announce_assets(sorted(changes.assets), bool(changes.shapes))
        self._queue.add(changes.assets, later=changes.settings)
        if is_other and not changes.learning:
            self._learning.measure_reach()
        if changes.questions and not changes.learning:
            self._learning.assess()

    def show_program(self) -> bool:
        """Show the accepted program; whether it is another one, so that outputs may be stale."""
        self._note_stamps((PROGRAM_FILE, LEARNED_FILE))
        is_other = self._pages.set_program(_view_program(self.project, self._pages.program))
        if is_other:
            self._queue.add([card.asset for card in self._pages.cards if card.output != "none"], later=True)
            self._pages.announce_assets(self.project.layout.ids_with("demonstrations"), shapes=False)
        return is_other

    def reopen(self) -> None:
        """Look for assets that came or went; the vocabulary is shown at once, as keys have a meaning by it."""
        self.project = replace(self.project, found=Project.open(self.project.folder).found)
        self._pages.set_vocabulary(vocabulary_view(self.project.settings.vocabulary, self._pages.cards))
        self._queue.add(self._pages.set_assets(self.project.assets()), later=True)

    def poll(self) -> None:
        """See whether others changed something. Never raises: an error is shown, and the next poll tries again."""
        now = read_stamps(self.project)
        changed = diff_stamps(self._stamps, now)
        self._stamps = now
        try:
            if any((self.project.folder / name).is_dir() for name in changed):
                self.reopen()
            if changed:
                self.update(changed)
        except MeshForgeError as error:
            self._pages.set_problem(error.message)
        except Exception:  # the next poll may succeed; polling itself must go on
            _LOG.debug("looking at what others changed failed", exc_info=True)

    def _note_stamps(self, names: Iterable[str]) -> None:
        names = frozenset(names)
        kept = {name: at for name, at in self._stamps.items() if name not in names}
        self._stamps = kept | dict(_stamp_files((self.project.folder / name for name in names), self.project.folder))

    def _add_feedback(self, changes: FileChanges) -> FileChanges:
        """The same with what people said since: what is learned from it, and of which assets; else, what is asked."""
        before, now = self._said, _read_feedback(self.project)
        self._said = now
        about = {
            asset
            for asset in before.verdicts.keys() | now.verdicts.keys()
            if before.verdict_on(asset) != now.verdict_on(asset)
        }
        about |= {
            one
            for one in before.exclusions.keys() | now.exclusions.keys()
            if (one in before.exclusions) != (one in now.exclusions)
        }
        learns = bool(about) or before.answers_and_fixes != now.answers_and_fixes
        assets = changes.assets | (about & self.project.found.ids.keys())
        return replace(changes, assets=assets, learning=changes.learning or learns, questions=True)


def _read_feedback(project: Project) -> Feedback:
    try:
        return project.feedback()
    except MeshForgeError:  # the assessment says so
        return Feedback()


def _view_program(project: Project, before: ProgramView) -> ProgramView:
    try:
        return read_program_view(project)
    except MeshForgeError as error:  # what it was learned from cannot be read
        return before.model_copy(update={"error": error.message})


@dataclass(frozen=True, slots=True)
class FileChanges:
    """assets: ids of which something changed; shapes: those of them whose hulls may be others.

    settings, program: whether these changed; questions: whether others are to be asked; learning: whether what is
    learned from did.
    """

    assets: frozenset[str] = field(default_factory=frozenset)
    shapes: frozenset[str] = field(default_factory=frozenset)
    settings: bool = False
    program: bool = False
    questions: bool = False
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
        learning=settings
        or bool(shapes)
        or any(n.startswith(_LEARNING_FOLDERS) or n in _LEARNING_FILES for n in names),
    )


def read_stamps(project: Project) -> FileStamps:
    """The stamps of a project's files, of those of its assets, and of the folders of assets, where new ones come."""
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


def _stamp_files(paths: Iterable[Path], root: Path, folders: bool = False) -> Iterator[tuple[str, tuple[int, int]]]:
    for path in paths:
        try:
            stat = path.stat()
        except OSError:
            continue
        if S_ISDIR(stat.st_mode) == folders:
            yield relative_name(path, root), (stat.st_mtime_ns, stat.st_size)


class FileWatcher:
    """A thread that polls the files again and again."""

    def __init__(self, poll: Callable[[], None]) -> None:
        self._poll = poll
        self._closed = Event()
        self._thread = Thread(target=self._run, name="watch", daemon=True)

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def close(self) -> None:
        """Stop, and wait for the end of a poll."""
        self._closed.set()
        if self._thread.is_alive():
            self._thread.join()

    def _run(self) -> None:
        took = 0.0
        while not self._closed.wait(max(POLL_SECONDS, _SHARE * took)):
            began = monotonic()
            self._poll()
            took = monotonic() - began
