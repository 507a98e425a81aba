"""Makes cards and the view of the project in the background after every change."""

import logging
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import islice
from threading import Condition, Thread
from time import monotonic
from typing import Any

from meshforge.batch import read_stamp
from meshforge.common import MeshForgeError, StoppedError, describe_error, file_state
from meshforge.labels import OfferCache
from meshforge.project import NO_LABEL, AssetStatus, Project, Status, StepKind, choose_next_step, find_offers, list_new
from meshforge.studio.label_changes import LabelChanges
from meshforge.studio.output_checks import OutputChecks
from meshforge.studio.output_measures import check_key
from meshforge.studio.pages import PageState
from meshforge.studio.queries.assets import find_unclear_up
from meshforge.studio.queries.goals import list_goal_views
from meshforge.studio.queries.project import add_session, build_card, build_project_view, vocabulary_view
from meshforge.studio.wire.events import ProjectChanged
from meshforge.studio.wire.family import Card, NewAssetsView, ProjectView
from meshforge.studio.wire.jobs import Job, JobKind

_LOG = logging.getLogger(__name__)
_FEWEST, _PORTIONS = 8, 20
_REPORT_SECONDS = 0.2
_STEPS_OF: Mapping[JobKind, tuple[StepKind, ...]] = {
    "decompose": ("decompose",),
    "label": ("label-all", "label", "check-labels"),
    "apply": ("apply",),
    "export": ("export",),
}
"""The kinds of steps that jobs do."""


class Refresher:
    """Makes cards and the view of the project, and shows how far the first reading is.

    project: gives the project that is open now; queue: the assets that are still to be refreshed.
    """

    def __init__(
        self,
        project: Callable[[], Project],
        pages: PageState,
        checks: OutputChecks,
        label_changes: LabelChanges,
        offers: OfferCache,
    ) -> None:
        self._project, self._pages, self._checks, self._label_changes = project, pages, checks, label_changes
        self._offers = offers
        self.queue = RefreshQueue(self.refresh, self.portion_size)
        self._rows: dict[str, AssetStatus] = {}
        self._new_assets = NewAssetsQuery()
        self._read, self._next_report = 0, 0.0
        self._job: Job | None = None

    def show_job(self, job: Job) -> None:
        """Show a job, and as the next step what it does, not that it is to be done."""
        self._pages.set_job(job)
        step = self._pages.shown.project.next
        if job.state != "running":
            self.queue.add()
        elif step.kind in _STEPS_OF.get(job.kind, ()) and step.text != job.title:
            self._pages.change_project(next=replace(step, text=job.title))

    @property
    def names(self) -> Mapping[str, tuple[str, ...]]:
        """The names of the hulls of each asset that was read, in order."""
        return {asset: row.names for asset, row in self._rows.items()}

    def portion_size(self) -> int:
        """Return how many assets are looked at together: few, so that their cards come soon."""
        return max(_FEWEST, self._pages.count // _PORTIONS)

    def refresh(self, assets: tuple[str, ...]) -> None:
        """Look at some assets, and at the project when none are left. Never raises."""
        try:
            self._refresh(tuple(asset for asset in assets if asset in self._project().found.ids))
        except StoppedError:  # the studio is being closed
            return
        except MeshForgeError as error:
            self._show_problem(error.message)
        except Exception as error:
            _LOG.debug("refreshing cards failed", exc_info=True)
            self._show_problem(describe_error(error))

    def _show_problem(self, problem: str) -> None:
        """What the settings say is shown with it: a refresh that began before they changed may have shown the old."""
        settings: dict[str, Any] = {}
        with suppress(MeshForgeError):  # it may be the settings that cannot be read
            project = self._project()
            settings = {"vocabulary": vocabulary_view(project.words), "goals": list_goal_views(project)}
        self._pages.show_problem(problem, **settings)

    def _refresh(self, assets: tuple[str, ...]) -> None:
        project = self._project()
        status = project.status(
            assets, others=self._rows.values(), progress=self._count_read, stop=self.queue.is_closed
        )
        words, settings = project.words, project.settings
        self._rows |= {row.id: row for row in status.assets}
        keys = [check_key(read_stamp(project.layout.edited, row.id)) for row in status.assets]
        self._pages.set_cards(
            build_card(row, words, settings.orient, settings.up, key, self._checks.faults_of(key))
            for row, key in zip(status.assets, keys, strict=True)
        )
        self._report_progress()
        if self.queue.remaining == 0 or len(assets) < self.portion_size():
            self._pages.show(ProjectChanged(project=self._build_view(status)))

    def _build_view(self, status: Status) -> ProjectView:
        project, cards = self._project(), self._pages.cards
        propagation = self._label_changes.propagation_state(cards)
        new, damage = self._new_assets.find(project, cards)
        problem = status.problem or damage
        shown = self._pages.shown
        is_judged = not shown.learning and (not shown.assessing or shown.assessment is not None)
        feedback = project.feedback()
        has_replies = bool(feedback.verdicts or feedback.answers or feedback.replied)
        titles = {kind: job.title for job in self._pages.running_jobs for kind in _STEPS_OF.get(job.kind, ())}
        family = replace(
            add_session(status.family, shown.program, shown.outcome, shown.assessment, propagation, problem),
            find_offers=partial(find_offers, project, self._offers, self._pages.readable),
            is_judged=is_judged,
            shown=shown.project.next,
            has_replies=has_replies,
            running=titles,
        )
        # what is not looked at yet would be proposed though it is done
        step = shown.project.next if self.queue.remaining else choose_next_step(family)
        ask_up = find_unclear_up(project, self._pages.with_hulls)
        return build_project_view(project, step, problem, status.lost, propagation, new, ask_up)

    def _count_read(self) -> None:
        """One asset had to be read; called from another thread."""
        self._read += 1
        if monotonic() >= self._next_report:
            self._next_report = monotonic() + _REPORT_SECONDS
            self._report_progress()

    def _report_progress(self) -> None:
        total, left = self._pages.count, self.queue.remaining
        if self._job is None and self._read and left:
            self._job = Job(id="read", kind="read", title="Reading assets", total=total)
        if self._job:
            update = {"done": total - left, "state": "running" if left else "done"}
            self._job = self._job.model_copy(update=update)
            self._pages.set_job(self._job)
        if not left:
            self._job, self._read = None, 0


class NewAssetsQuery:
    """Finds which assets a run prepares first. All preparations are read for that, so it is asked again only where the
    project's file about it, its assets, or what was done to one of them is another."""

    def __init__(self) -> None:
        self._basis: tuple[object, ...] | None = None
        self._found: tuple[NewAssetsView | None, str | None] = None, None

    def find(self, project: Project, cards: Iterable[Card]) -> tuple[NewAssetsView | None, str | None]:
        """Return the new assets, None where there are none; and why they are not known, where a file is damaged."""
        rows = tuple(cards)
        done = tuple((card.asset, card.prepared) for card in rows if card.prepared)
        bare = tuple(card.asset for card in rows if all(label == NO_LABEL for label in card.labels))
        files = file_state(project.layout.preparation_plan), file_state(project.layout.sign_offs)
        basis = files, file_state(project.layout.program), project.assets(), done, bare
        if basis != self._basis:
            self._basis, self._found = basis, _find_new_assets(project)
        return self._found


def _find_new_assets(project: Project) -> tuple[NewAssetsView | None, str | None]:
    try:
        new, unclear = list_new(project)
    except MeshForgeError as error:
        return None, error.message
    if not new and not unclear:
        return None, None
    plans = [one.plan.rebuild for one in new if one.plan.rebuild]
    least = plans[0].min_confidence if plans else None
    ids = tuple(one.id for one in new)
    return NewAssetsView(ids=ids, rebuilt=len(plans), min_confidence=least, unclear=unclear), None


class RefreshQueue:
    """A thread that refreshes assets by their ids: urgent ones first, then the rest, one portion at a time.

    refresh: called with some ids, or none where only the project itself is to be refreshed; size: of one portion.
    """

    def __init__(self, refresh: Callable[[tuple[str, ...]], None], size: Callable[[], int]) -> None:
        self._refresh, self._size = refresh, size
        self._wake = Condition()
        self._urgent: dict[str, None] = {}
        self._rest: dict[str, None] = {}
        self._whole = False
        self._closed = False
        self._thread = Thread(target=self._run, name="refresh", daemon=True)

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def add(self, assets: Iterable[str] = (), *, later: bool = False) -> None:
        """Have some assets refreshed, and the project; later: after those that are urgent."""
        with self._wake:
            for asset in assets:
                if not later:
                    self._rest.pop(asset, None)
                    self._urgent[asset] = None
                elif asset not in self._urgent:
                    self._rest[asset] = None
            self._whole = True
            self._wake.notify()

    @property
    def remaining(self) -> int:
        """How many assets are still to be refreshed."""
        with self._wake:
            return len(self._urgent) + len(self._rest)

    def is_closed(self) -> bool:
        """Return whether the queue is closed, so that the refresh that is running is to stop."""
        return self._closed

    def close(self) -> None:
        """Stop, and wait for the end of the refresh that is running."""
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
        assets = tuple(islice(source, self._size()))
        for asset in assets:
            del source[asset]
        return assets
