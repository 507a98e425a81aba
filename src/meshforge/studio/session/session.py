"""The session: the one place through which an open studio reads and changes its project."""

from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from threading import RLock
from typing import Any, Literal

from meshforge.batch import read_prepared, stamp_path
from meshforge.common import ProjectError, UsageError, relative_name
from meshforge.labels import OfferCache
from meshforge.language import Program
from meshforge.project import NextStep, Project
from meshforge.store import History, HistoryEntry, Layout, MeshCache, NotHereError, list_files
from meshforge.studio.edits.base import Edit, make_edit
from meshforge.studio.edits.program import TakeLearned
from meshforge.studio.label_changes import EarlyLabels, LabelChanges
from meshforge.studio.learning.scheduler import LearningScheduler
from meshforge.studio.output_checks import OutputChecks
from meshforge.studio.pages import PageHub, PageState
from meshforge.studio.queries.programs import read_program_view
from meshforge.studio.queries.project import build_project_view
from meshforge.studio.session.file_sync import FileSync, FileWatcher
from meshforge.studio.session.job_runner import JobRunner
from meshforge.studio.session.refresh import Refresher
from meshforge.studio.similar_hulls import SimilarHulls
from meshforge.studio.thumbnails import Thumbnails
from meshforge.studio.transfers import Uploads
from meshforge.studio.wire.events import HistoryChanged, ProgramChanged
from meshforge.studio.wire.program import OutcomeView
from meshforge.studio.wire.requests import EditReceipt
from meshforge.studio.workers import Workers
from meshforge.symbolic import SymbolicMesh

READERS = 2
"""Processes that read assets which a page waits for."""

_MESHES = 80  # in memory


@dataclass(frozen=True, slots=True)
class StudioOptions:
    """How a studio is opened. folder: of the project, None for the start page; export: a folder that outputs may be
    exported to besides those in the project; tour: whether pages show the guided tour."""

    folder: Path | None = None
    export: Path | None = None
    tour: bool = False


class Session:
    """One open project: changes it, and keeps all pages in step with it."""

    def __init__(self, folder: Path, options: StudioOptions) -> None:
        self.options = options
        self._mutex = RLock()
        self.readers, self._drawers, self._checkers = Workers(READERS), Workers(), Workers(1)
        project = Project.open(folder).with_cache(
            MeshCache(lambda path, prepared: self.readers.run(read_prepared, path, prepared), _MESHES)
        )
        own = project.layout.studio
        self.history = History.open(project.folder, lambda: _list_learned_files(project))
        self.label_changes = LabelChanges(self.history)
        self.hub = PageHub()
        view = build_project_view(project, NextStep("wait", "The assets are being read."), None, ())
        self.pages = PageState(
            self.hub, view, self.history.state, version("meshforge"), tour=options.tour, leave=options.folder is None
        )
        self.offers = OfferCache()
        self.thumbnails = Thumbnails(own / "thumbnails", self._drawers)
        self.similar = SimilarHulls(self._drawers)
        self.checks = OutputChecks(own / "checks", self._checkers)
        self.uploads = Uploads(own / "uploads")
        # the queue's thread must see the project that is open when it works, not the first one
        refresher = Refresher(lambda: self.project, self.pages, self.checks, self.label_changes, self.offers)
        self.refresh_queue = refresher.queue
        self.jobs = JobRunner(refresher.show_job)
        self._early_labels = EarlyLabels(self.pages, lambda: refresher.names)
        self.learning = LearningScheduler(
            project.folder, self.pages, self._has_demonstrations, self._end_learning, self.refresh_queue.add
        )
        self._watcher = FileWatcher(self._poll_files)
        self._file_sync = FileSync(project, self.pages, self.learning, self.refresh_queue)
        self._take_learned = False
        self.preview: tuple[str, bytes] | None = None  # an asset, and the packet of hulls that were tried on it

    @property
    def project(self) -> Project:
        """The project with the assets that it has now."""
        return self._file_sync.project

    def start(self) -> None:
        """Start reading, learning and watching files."""
        self.pages.set_assets(self.project.assets())
        self.pages.show(ProgramChanged(program=read_program_view(self.project)))
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

    # Reading

    def mesh(self, asset: str) -> SymbolicMesh:
        """Return an asset with its labels. Raises NotHereError, or AssetError where it cannot be read."""
        self.check_assets(asset)
        return self.project.mesh(asset)

    @property
    def present_program(self) -> Program | None:
        """The program that was learned last, or else the accepted one; one that a person wrote comes before both."""
        learned, accepted = self.pages.shown.outcome, self.pages.shown.program
        if learned and learned.program and not accepted.by_hand:
            return Program.parse(learned.program)
        if accepted.error:
            raise ProjectError(accepted.error)
        return Program.parse(accepted.text) if accepted.text else None

    def describe_state(self) -> str | None:
        """Return how far the project is, as a list of projects says it; None while it is being read."""
        cards, found = self.pages.cards, self.pages.shown
        if not cards or any(card.hulls is None and card.error is None for card in cards):
            return None
        if found.assessment and found.assessment.assets:
            reviewed = {row.asset: row.reviewed for row in found.assessment.assets if row.state == "signed"}
            signed = sum(reviewed[one.asset] or not one.is_open for one in cards if one.asset in reviewed)
            return f"{signed} of {len(cards)} signed off"
        if not any(label >= 0 for card in cards for label in card.labels):
            return "no labels yet"
        return "not reviewed yet" if found.program.text else "no program yet"

    def check_assets(self, *assets: str) -> None:
        """Raise NotHereError for an id that no asset has."""
        for asset in assets:
            if asset not in self.project.found.ids:
                remedy = "If its file was moved or removed, put it back."
                raise NotHereError(f"there is no asset {asset!r}", where=self.project.name, remedy=remedy)

    # Changing

    def edit(self, edit: Edit, by: str | None = None) -> EditReceipt:
        """Make an edit; it is on disk when this returns."""
        with self._mutex:
            title = edit.describe(self.project)
            if self.project.layout.program in edit.list_paths(self.project):
                self.learning.pause()
            try:
                with self._early_labels.show(edit):
                    entry = make_edit(self.history, self.project, edit, by)
            finally:
                self.learning.resume()
            if entry is None:
                return EditReceipt(message=title, nothing=True)
            self.announce((entry,), by)
        return EditReceipt(message=entry.title)

    def move(self, way: Literal["undo", "redo"], by: str | None = None, to: int | None = None) -> EditReceipt:
        """Undo what was done last, or redo what was undone last; to: on and on, until so many changes are done.

        Raises ConflictError where something else changed a file since; what was undone or redone before that stays so.
        """
        move, moved = (self.history.undo if way == "undo" else self.history.redo), list[HistoryEntry]()
        with self._mutex:
            self.learning.pause()
            try:
                while entries := move():
                    moved += entries
                    done = self.history.state.undoable
                    if to is None or (done <= to if way == "undo" else done >= to):
                        break
            finally:
                self.learning.resume()
                if moved:
                    self.announce(moved, by)
        return EditReceipt(message=moved[0].title if moved else f"there is nothing to {way}", nothing=not moved)

    def announce(self, entries: Iterable[HistoryEntry], by: str | None = None) -> None:
        """Send all pages what entries changed, then that they were made, undone or redone; the cards follow."""
        with self._mutex:
            self.update({name for entry in entries for name in entry.names})
            self.pages.show(HistoryChanged(history=self.history.state, by=by))

    @contextmanager
    def record(self, title: str, edit: dict[str, Any], paths: Iterable[Path], group: str) -> Iterator[None]:
        """Record a change of files that a job makes within the block. edit: what it is, as JSON."""
        with self._mutex:
            with self.history.record(title, edit, paths, group=group) as before:
                yield
            entries = self.history.entries
            if len(entries) > before:
                self.announce(entries[-1:])

    def record_preparation(self, title: str, asset: str, group: str) -> AbstractContextManager[None]:
        """Record what a job does to an asset before the program, within a block."""
        paths = (file.path(self.project.folder, asset) for file in list_files() if file.hulls)
        return self.record(title, {"asset": asset}, paths, group)

    def count_edits(self) -> int:
        """Return how many edits are done, as soon as the one that is being made is: what is read then has them all."""
        with self._mutex:
            return self.history.state.undoable

    def note_output(self, asset: str) -> None:
        """Record that the output of an asset was written."""
        self.update([relative_name(stamp_path(self.project.layout.edited, asset), self.project.folder)])

    def update(self, names: Iterable[str]) -> None:
        """Refresh what depends on these files; names: paths from the project's folder."""
        with self._mutex:
            self._file_sync.update(names)

    def _poll_files(self) -> None:
        with self._mutex:
            self._file_sync.poll()
            if self.history.refresh():
                self.pages.show(HistoryChanged(history=self.history.state))

    # Learning

    def learn(self) -> EditReceipt:
        """Learn now, and take the learned program even if the present one was written by hand."""
        if not self._has_demonstrations():
            raise UsageError("nothing is demonstrated yet", remedy="Show the steps of the edit on one asset.")
        with self._mutex:
            self._take_learned = self.pages.shown.program.by_hand
            self.learning.restart()
        self.refresh_queue.add()
        return EditReceipt(message="learning")

    def _has_demonstrations(self) -> bool:
        shown = set(self.project.layout.demonstration.ids)
        return any(asset in shown for asset in self.project.assets())

    def _end_learning(self, outcome: OutcomeView) -> None:
        with self._mutex:
            take, self._take_learned = self._take_learned, False
            if take and outcome.program and self.learning.is_latest(outcome.number):
                self.edit(TakeLearned())
                return
            self._file_sync.show_program()
            self.refresh_queue.add()


def _list_learned_files(project: Project) -> frozenset[str]:
    """The files that follow from others: undo puts them back whatever they hold by then, but for a program by hand."""
    by_hand = {Layout.program.name} if project.program_state().by_hand else set[str]()
    return frozenset(file.name for file in list_files() if file.learned) - by_hand
