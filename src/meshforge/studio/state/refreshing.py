"""Cards and the project, looked at anew in the background."""

from __future__ import annotations

import logging
from functools import partial
from typing import TYPE_CHECKING

from meshforge.batch import read_stamp
from meshforge.errors import MeshForgeError, StoppedError, told
from meshforge.project import Project, Status, first_to_show
from meshforge.studio.checking import check_key
from meshforge.studio.showing.cards import card
from meshforge.studio.showing.next_step import next_step
from meshforge.studio.showing.project import project_view
from meshforge.studio.wire.family import Next, ProjectView
from meshforge.studio.wire.jobs import Job

if TYPE_CHECKING:
    from meshforge.studio.state.desk import Desk

_LOG = logging.getLogger(__name__)
_FEWEST, _PORTIONS = 8, 20


def first_view(project: Project) -> ProjectView:
    """The project before its assets are looked at. Raises ProjectError for a file of it that cannot be read."""
    return project_view(project, (), Next(stage="label", say="The assets are being read."), None, ())


class Refreshing:
    """Makes cards and the view of the project, and tells how far the first reading is."""

    def __init__(self, desk: Desk) -> None:
        self._desk = desk
        self._names: dict[str, tuple[str, ...]] = {}
        self._read = 0
        self._job: Job | None = None

    def portion_size(self) -> int:
        """How many assets are looked at together: few, so that their cards come soon."""
        return max(_FEWEST, len(self._desk.project.assets()) // _PORTIONS)

    def refresh(self, assets: tuple[str, ...]) -> None:
        """Look at some assets, and at the project when none are left. Never raises."""
        try:
            self._refresh(tuple(asset for asset in assets if asset in self._desk.project.found.ids))
        except StoppedError:  # the studio is being closed
            return
        except MeshForgeError as error:
            self._desk.pages.set_problem(error.message)
        except Exception as error:
            _LOG.debug("a chore failed", exc_info=True)
            self._desk.pages.set_problem(told(error))

    def _refresh(self, assets: tuple[str, ...]) -> None:
        desk, project = self._desk, self._desk.project
        status = project.status(assets, progress=self._count_read, stop=desk.refresh_queue.is_closed)
        settings = project.settings
        self._names |= {row.id: row.names for row in status.assets}
        keys = [check_key(read_stamp(project.layout.edited, row.id)) for row in status.assets]
        desk.pages.set_cards(
            card(row, settings.vocabulary, settings.orient, key, desk.checks.faults_of(key))
            for row, key in zip(status.assets, keys, strict=True)
        )
        self._report_progress()
        if desk.refresh_queue.remaining == 0 or len(assets) < self.portion_size():
            desk.pages.set_relabelled(desk.label_changes.last_change(self._names))
            desk.pages.set_project(self._build_view(status))

    def _build_view(self, status: Status) -> ProjectView:
        desk, cards = self._desk, self._desk.pages.cards
        program = desk.pages.program
        has_program = bool(program.text) and not program.error
        first = partial(first_to_show, desk.project)
        carried = desk.label_changes.propagation_state(desk.project, cards)
        following = next_step(cards, status.vocabulary, has_program, desk.pages.lesson, status.problem, first, carried)
        return project_view(desk.project, cards, following, status.problem, status.lost, carried)

    def _count_read(self) -> None:
        """One asset had to be read; called from another thread."""
        self._read += 1
        self._report_progress()

    def _report_progress(self) -> None:
        """Show how far the reading is, where there is any that takes time."""
        cards = self._desk.pages.cards
        left = self._desk.refresh_queue.remaining
        if self._job is None and self._read and left:
            self._job = Job(id="read", kind="read", title="Reading assets", total=len(cards))
        if self._job:
            update = {"done": len(cards) - left, "state": "running" if left else "done"}
            self._job = self._job.model_copy(update=update)
            self._desk.pages.set_job(self._job)
        if not left:
            self._job, self._read = None, 0
