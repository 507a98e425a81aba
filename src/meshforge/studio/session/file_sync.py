"""Keeps what pages show in step with the files of a project: this studio, a command or an editor may change them."""

import logging
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from stat import S_ISDIR
from threading import Event, Thread
from time import monotonic

from meshforge.batch import source_files
from meshforge.common import MeshForgeError, relative_name
from meshforge.project import Project
from meshforge.store import Effect, Feedback, Layout, identify_file, list_files
from meshforge.studio.learning.scheduler import LearningScheduler
from meshforge.studio.pages import PageState
from meshforge.studio.queries.goals import list_goal_views
from meshforge.studio.queries.programs import read_program_view
from meshforge.studio.queries.project import vocabulary_view
from meshforge.studio.session.refresh import RefreshQueue
from meshforge.studio.wire.events import ProgramChanged
from meshforge.studio.wire.program import ProgramView

_LOG = logging.getLogger(__name__)

POLL_SECONDS = 1.5
"""Seconds between two polls; more where a poll itself takes long, so that it takes a small share of the time."""
_SHARE = 10

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
        self._announced, self._family = _read_feedback(project), project.assets()

    def update(self, names: Iterable[str]) -> None:
        """Refresh what depends on files that changed; names: paths from the project's folder."""
        changes = changes_of(self.project, names := frozenset(names))
        if "learning" in changes.effects and (gone := self.project.forget_learned()):
            return self.update(names | {*gone})
        self._note_stamps(names)
        assets, effects = changes.assets, changes.effects
        if "feedback" in effects:
            about, learns = self._take_feedback()
            assets |= about & self.project.found.ids.keys()
            effects |= {"questions", "learning"} if learns else {"questions"}
        if "settings" in effects:
            self.reopen()
        is_other = self.show_program() if effects & {"settings", "program"} else False
        if "learning" in effects:  # before the rest, as it takes longest
            self._learning.restart()
        self._pages.announce_assets(sorted(assets), bool(changes.shapes))
        self._queue.add(assets, later="settings" in effects)
        if is_other and "learning" not in effects:
            self._learning.measure_reach()
        if "questions" in effects and "learning" not in effects:
            self._learning.assess()

    def show_program(self) -> bool:
        """Show the accepted program; whether it is another one, so that outputs may be stale."""
        self._note_stamps(file.name for file in (Layout.program, Layout.learned))
        before = self._pages.shown.program
        program = _view_program(self.project, before)
        self._pages.show(ProgramChanged(program=program))
        is_other = program.text != before.text
        if is_other:
            self._queue.add([card.asset for card in self._pages.cards if card.output != "none"], later=True)
            self._pages.announce_assets(self.project.layout.demonstration.ids, shapes=False)
        return is_other

    def reopen(self) -> None:
        """Look for assets that came or went; the vocabulary is shown at once, as keys have a meaning by it."""
        self.project = replace(self.project, every=Project.open(self.project.folder).every)
        self._pages.change_project(vocabulary=vocabulary_view(self.project.words), goals=list_goal_views(self.project))
        self._family = self.project.assets()
        self._queue.add(self._pages.set_assets(self._family), later=True)

    def poll(self) -> None:
        """See whether others changed something. Never raises: an error is shown, and the next poll tries again."""
        try:
            now = read_stamps(self.project)
            changed = {name for name in self._stamps | now if self._stamps.get(name) != now.get(name)}
            self._stamps = now
            if any((self.project.folder / name).is_dir() for name in changed):
                self.reopen()
            if changed:
                self.update(changed)
        except MeshForgeError as error:
            self._pages.show_problem(error.message)
        except Exception:  # the next poll may succeed; polling itself must go on
            _LOG.debug("looking at what others changed failed", exc_info=True)

    def _note_stamps(self, names: Iterable[str]) -> None:
        names = frozenset(names)
        kept = {name: at for name, at in self._stamps.items() if name not in names}
        self._stamps = kept | dict(_stamp_files((self.project.folder / name for name in names), self.project.folder))

    def _take_feedback(self) -> tuple[set[str], bool]:
        """The assets of which people said something since, and whether there is anything to be learned from it."""
        before, now = self._announced, _read_feedback(self.project)
        self._announced = now
        about = {
            asset
            for asset in before.verdicts.keys() | now.verdicts.keys()
            if before.verdict_on(asset) != now.verdict_on(asset)
        }
        about |= before.exclusions.keys() ^ now.exclusions.keys()
        if self.project.assets() != self._family:
            self.reopen()
        return about, bool(about) or before.answers_and_fixes != now.answers_and_fixes


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
    """assets: ids of which something changed; shapes: those of them whose hulls may be others; effects: what else is to
    be refreshed."""

    assets: frozenset[str] = frozenset()
    shapes: frozenset[str] = frozenset()
    effects: frozenset[Effect] = frozenset()


def changes_of(project: Project, names: Iterable[str]) -> FileChanges:
    """Return what a change of files means; names: paths from the project's folder."""
    ids = project.found.ids
    sources = {relative_name(path, project.folder): asset for asset, path in ids.items()}
    effects, cards, shapes = set[Effect](), set[str](), {sources[name] for name in names if name in sources}
    for file, asset in filter(None, map(identify_file, names)):
        effects |= file.effects
        shapes |= {asset} if "hulls" in file.effects else set()
        cards |= {asset} if "card" in file.effects else set()
    shapes &= ids.keys()
    effects -= {"card", "hulls"}
    if shapes:
        effects.add("learning")
    assets = frozenset(ids) if "settings" in effects else frozenset((cards & ids.keys()) | shapes)
    return FileChanges(assets, frozenset(shapes), frozenset(effects))


def read_stamps(project: Project) -> FileStamps:
    """Return the stamps of a project's files, of those of its assets, and of their folders, where new ones come."""
    folder = project.folder
    assets = [file for path in project.found.paths for file in _source_files(path)]
    homes = {path.parent for path in project.found.paths}
    watched = (file.path(folder) for file in list_files() if file.effects)
    kept = (one for path in watched for one in _list_files(path))
    files = dict(_stamp_files([*kept, *assets], folder))
    return files | dict(_stamp_files(homes, folder, folders=True))


def _list_files(path: Path) -> Iterator[Path]:
    return (one for one in path.rglob("*") if not one.name.startswith(".")) if path.is_dir() else iter([path])


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
