"""The session: the one place in which a project is changed and looked at while the studio is open."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from threading import RLock
from typing import Literal

from meshforge.batch import STATE, stamp_path
from meshforge.common import UsageError, relative_name
from meshforge.labels import OfferCache
from meshforge.project import Project
from meshforge.studio.edits.base import Edit
from meshforge.studio.edits.program import TakeLearned
from meshforge.studio.errors import NotHereError
from meshforge.studio.history import History
from meshforge.studio.history_store import HistoryEntry
from meshforge.studio.label_changes import LabelChanges
from meshforge.studio.learning.scheduler import Learner, LearningScheduler
from meshforge.studio.output_checks import OutputChecks
from meshforge.studio.pages import PageHub, PageState
from meshforge.studio.queries.programs import read_program_view
from meshforge.studio.session.file_sync import LEARNED_FILE, PREVIOUS_FILE, PROGRAM_FILE, FileSync, FileWatcher
from meshforge.studio.session.job_runner import JobRunner
from meshforge.studio.session.refresh import Refresher, RefreshQueue, initial_view
from meshforge.studio.thumbnails import Thumbnails
from meshforge.studio.uploads import Uploads
from meshforge.studio.wire.events import HistoryChanged
from meshforge.studio.wire.program import LessonView
from meshforge.studio.wire.requests import Done
from meshforge.studio.workers import MeshCache, ProjectWithCache, Workers
from meshforge.symbolic import SymbolicMesh

EditWay = Literal["edit", "undo", "redo"]
READERS = 2
"""Processes that read assets which a page waits for."""


@dataclass(frozen=True, slots=True)
class StudioOptions:
    """How a studio is opened. export: a folder that outputs may be exported to besides those in the project; tour:
    whether pages show the guided tour."""

    folder: Path
    export: Path | None = None
    tour: bool = False


class Session:
    """Opens a project, changes it, and keeps all pages in step with it."""

    def __init__(self, opening: StudioOptions) -> None:
        self.options = opening
        self._mutex = RLock()
        self.readers, self._drawers, self._checkers = Workers(READERS), Workers(), Workers(1)
        self.project = ProjectWithCache.of(Project.open(opening.folder), MeshCache(self.readers))
        self.history = History(self.project, _files_of_learning)
        self.label_changes = LabelChanges(self.history)
        self.hub = PageHub()
        view = initial_view(self.project)
        self.pages = PageState(self.hub, view, self.history.view, version("meshforge"), opening.tour)
        self.offers = OfferCache()
        self.jobs = JobRunner(self.pages.set_job)
        self.thumbnails = Thumbnails(self.studio_folder / "thumbnails", self._drawers)
        self.checks = OutputChecks(self.studio_folder / "checks", self._checkers)
        self.uploads = Uploads(self.studio_folder / "uploads")
        self.learning = LearningScheduler(
            Learner(self.project.folder), self.pages, self._has_demonstrations, self._end_learning
        )
        refreshing = Refresher(self)
        self.refresh_queue = RefreshQueue(refreshing.refresh, refreshing.portion_size)
        self._watcher = FileWatcher(self._poll_files)
        self._file_sync = FileSync(self)
        self._take_learned = False

    @property
    def studio_folder(self) -> Path:
        """The folder of what the studio keeps."""
        return self.project.folder / STATE / "studio"

    def start(self) -> None:
        """Begin to read, to learn and to watch."""
        self.pages.set_assets(self.project.assets())
        self.pages.set_program(read_program_view(self.project))
        self.refresh_queue.add(self.project.assets(), later=True)
        self.refresh_queue.start()
        self._watcher.start()
        self.learning.restart()

    def close(self) -> None:
        """Stop everything, worker processes too."""
        self._watcher.close()
        self.refresh_queue.close()
        self.jobs.close()
        self.learning.close()
        self.readers.close()
        self._drawers.close()
        self._checkers.close()
        self.hub.close()

    # Looking

    def mesh(self, asset: str) -> SymbolicMesh:
        """An asset with its labels. Raises NotHereError, or AssetError where it cannot be read."""
        self.check_assets(asset)
        return self.project.mesh(asset)

    def check_assets(self, *assets: str) -> None:
        """Raises NotHereError for an id that no asset has."""
        for asset in assets:
            if asset not in self.project.found.ids:
                raise NotHereError(f"there is no asset {asset!r}", where=self.project.name)

    # Changing

    def edit(self, edit: Edit, by: str | None = None) -> Done:
        """Make an edit; it is on disk when this returns."""
        with self._mutex:
            said = edit.describe(self.project)
            if self.project.layout.program in edit.list_paths(self.project):
                self.learning.pause()
            try:
                entry = self.history.do(self.project, edit, by)
            finally:
                self.learning.resume()
            if entry is None:
                return Done(said=said, nothing=True)
            self.announce((entry,), "edit", by)
        return Done(said=entry.title)

    def undo(self, by: str | None = None) -> Done:
        """Take back what was done last."""
        return self._move("undo", by)

    def redo(self, by: str | None = None) -> Done:
        """Do again what was taken back last."""
        return self._move("redo", by)

    def _move(self, way: Literal["undo", "redo"], by: str | None) -> Done:
        with self._mutex:
            self.learning.pause()
            try:
                move = self.history.undo if way == "undo" else self.history.redo
                entries = move(self.project)
            finally:
                self.learning.resume()
            if not entries:
                return Done(said=f"there is nothing to {way}", nothing=True)
            self.announce(entries, way, by)
        return Done(said=entries[0].title)

    def announce(self, entries: Iterable[HistoryEntry], did: EditWay, by: str | None = None) -> None:
        """Tell all pages of entries that were made, undone or redone, after what they changed (cards follow)."""
        with self._mutex:
            entries = tuple(entries)
            said = entries[0].title
            self.pages.set_relabelled(None)
            self.update({name for entry in entries for name in entry.names})
            self.pages.set_history(HistoryChanged(history=self.history.view, did=did, said=said, by=by))

    @contextmanager
    def record_edit(self, edit: Edit, group: str) -> Iterator[None]:
        """An edit of a job, whose change is made within the block."""
        with self._mutex:
            with self.history.record(self.project, edit, group=group) as before:
                yield
            if self.history.view.undoable > before:
                self.announce((self.history.last_entry,), "edit")

    def note_output(self, asset: str) -> None:
        """The output of an asset was written anew."""
        self.update([relative_name(stamp_path(self.project.layout.edited, asset), self.project.folder)])

    def update(self, names: Iterable[str]) -> None:
        """Look anew at what depends on these files; names: paths from the project's folder."""
        with self._mutex:
            self._file_sync.update(names)

    def _poll_files(self) -> None:
        with self._mutex:
            self._file_sync.poll()

    # Learning

    def learn(self) -> Done:
        """Learn now, and take the learned program even if the present one was written by hand."""
        if not self._has_demonstrations():
            raise UsageError("nothing is demonstrated yet", remedy="Show the steps of the edit on one asset.")
        with self._mutex:
            self._take_learned = self.pages.program.by_hand
            self.learning.restart()
        return Done(said="learning")

    def _has_demonstrations(self) -> bool:
        shown = set(self.project.layout.ids_with("demonstrations"))
        return any(asset in shown for asset in self.project.assets())

    def _end_learning(self, lesson: LessonView) -> None:
        """A lesson is over: it has left its program, unless a person's stands there."""
        with self._mutex:
            taking, self._take_learned = self._take_learned, False
            if taking and lesson.program and self.learning.is_latest(lesson.number):
                self.edit(TakeLearned())
                return
            self._file_sync.show_program()
            self.refresh_queue.add()


def _files_of_learning(project: Project) -> frozenset[str]:
    """What learning writes by itself: undoing puts it back whatever it is by then, but no program by hand goes."""
    always = {LEARNED_FILE, PREVIOUS_FILE}
    return frozenset(always if project.program_state().by_hand else {*always, PROGRAM_FILE})
