"""Cards and the view of the project, made anew in the background after every change: a queue, and what works it off."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable
from functools import partial
from threading import Condition, Thread
from typing import TYPE_CHECKING

from meshforge.batch import read_stamp
from meshforge.common import MeshForgeError, StoppedError, describe_error
from meshforge.project import Project, Status, suggest_first_demonstration
from meshforge.studio.output_measures import check_key
from meshforge.studio.queries.next_step import choose_next_step
from meshforge.studio.queries.project import build_card, build_project_view
from meshforge.studio.wire.family import Next, ProjectView
from meshforge.studio.wire.jobs import Job

if TYPE_CHECKING:
    from meshforge.studio.session.session import Session


_LOG = logging.getLogger(__name__)
_FEWEST, _PORTIONS = 8, 20

RefreshCallback = Callable[[tuple[str, ...]], None]


def initial_view(project: Project) -> ProjectView:
    """The project before its assets are looked at. Raises ProjectError for a file of it that cannot be read."""
    return build_project_view(project, (), Next(stage="label", say="The assets are being read."), None, ())


class Refresher:
    """Makes cards and the view of the project, and tells how far the first reading is."""

    def __init__(self, desk: Session) -> None:
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
            self._desk.pages.set_problem(describe_error(error))

    def _refresh(self, assets: tuple[str, ...]) -> None:
        desk, project = self._desk, self._desk.project
        status = project.status(assets, progress=self._count_read, stop=desk.refresh_queue.is_closed)
        settings = project.settings
        self._names |= {row.id: row.names for row in status.assets}
        keys = [check_key(read_stamp(project.layout.edited, row.id)) for row in status.assets]
        desk.pages.set_cards(
            build_card(row, settings.vocabulary, settings.orient, key, desk.checks.faults_of(key))
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
        first = partial(suggest_first_demonstration, desk.project)
        carried = desk.label_changes.propagation_state(desk.project, cards)
        following = choose_next_step(
            cards, status.vocabulary, has_program, desk.pages.lesson, status.problem, first, carried
        )
        return build_project_view(desk.project, cards, following, status.problem, status.lost, carried)

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


class RefreshQueue:
    """A thread that refreshes assets by their ids: urgent ones first, then the rest, some at a time.

    refresh: called with some ids, or none where only the project as a whole is to be looked at; size: of one portion.
    """

    def __init__(self, refresh: RefreshCallback, size: Callable[[], int]) -> None:
        self._refresh, self._size = refresh, size
        self._wake = Condition()
        self._urgent: dict[str, None] = {}
        self._rest: dict[str, None] = {}
        self._whole = False
        self._closed = False
        self._thread = Thread(target=self._run, name="chores", daemon=True)

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def add(self, assets: Iterable[str] = (), *, later: bool = False) -> None:
        """Have some assets refreshed, and the project; later: after those that are urgent."""
        with self._wake:
            (self._rest if later else self._urgent).update(dict.fromkeys(assets))
            self._whole = True
            self._wake.notify()

    @property
    def remaining(self) -> int:
        """How many assets are still to be refreshed."""
        with self._wake:
            return len(self._urgent | self._rest)

    def is_closed(self) -> bool:
        """Whether what is being done is to stop."""
        return self._closed

    def close(self) -> None:
        """Stop, and wait for the end of what is being done."""
        with self._wake:
            self._closed = True
            self._wake.notify()
        if self._thread.is_alive():
            self._thread.join()

    def _run(self) -> None:
        while True:
            with self._wake:
                self._wake.wait_for(lambda: self._urgent or self._rest or self._whole or self._closed)
                if self._closed:
                    return
                assets = self._take_portion()
                self._whole = False
            self._refresh(assets)

    def _take_portion(self) -> tuple[str, ...]:
        source = self._urgent or self._rest
        assets = tuple(source)[: self._size()]
        for asset in assets:
            self._urgent.pop(asset, None)
            self._rest.pop(asset, None)
        return assets
