"""The pages that are open, and the state that all of them show: every change is sent at once."""

import asyncio
from collections.abc import Iterable, Sequence
from contextlib import suppress
from threading import Lock, RLock
from typing import Any

from meshforge.engines import ENGINES, MESH_FILES
from meshforge.project import NextStep
from meshforge.store.history import HistoryState
from meshforge.studio.queries.programs import build_language_view
from meshforge.studio.wire import Wire, events
from meshforge.studio.wire.family import Card, ProjectView
from meshforge.studio.wire.jobs import Job
from meshforge.studio.wire.program import ProgramView

MOST_FINISHED_JOBS = 20
"""Jobs that are over and still sent to pages that connect."""

MOST_BEHIND = 2000
"""Events that may wait for a page; one that is farther behind is closed, and connects anew with one `Hello`."""


class PageState:
    """What all pages show now. Each change is sent with it, under one lock, so that every page sees all in order."""

    def __init__(
        self,
        hub: "PageHub",
        project: ProjectView,
        history: HistoryState,
        version: str,
        *,
        tour: bool = False,
        leave: bool = False,
    ) -> None:
        self._lock, self._hub = RLock(), hub
        self._cards: dict[str, Card] = {}
        self._jobs: dict[str, Job] = {}
        self._rest = events.Hello(
            version=version,
            project=project,
            cards=(),
            history=history,
            program=ProgramView(),
            tour=tour,
            leave=leave,
            language=build_language_view(),
            engines={engine.name: engine.title for engine in ENGINES.values()},
            merged_files=MESH_FILES,
            merged_by=tuple(engine.name for engine in ENGINES.values() if engine.merges_files),
        )

    @property
    def cards(self) -> tuple[Card, ...]:
        with self._lock:
            return tuple(self._cards.values())

    @property
    def readable(self) -> frozenset[str]:
        """The assets that could be read by now."""
        return frozenset(card.asset for card in self.cards if card.hulls is not None)

    @property
    def with_hulls(self) -> tuple[str, ...]:
        """The assets that have hulls, as far as they are read by now."""
        return tuple(card.asset for card in self.cards if card.hulls)

    @property
    def running_jobs(self) -> tuple[Job, ...]:
        with self._lock:
            return tuple(job for job in self._jobs.values() if job.state == "running")

    @property
    def count(self) -> int:
        """How many assets there are."""
        return len(self._cards)

    @property
    def shown(self) -> events.Hello:
        """What all pages show, but for cards and jobs."""
        return self._rest

    def join(self, page: "PageConnection") -> None:
        """Show everything to a page, and from now on what changes."""
        with self._lock:
            self._hub.join(
                page, self._rest.model_copy(update={"cards": self.cards, "jobs": tuple(self._jobs.values())})
            )

    def set_cards(self, cards: Iterable[Card]) -> None:
        """Show other cards of some assets; those of assets that went meanwhile are left out."""
        with self._lock:
            other = tuple(card for card in cards if self._cards.get(card.asset, card) != card)
            self._cards |= {card.asset: card for card in other}
            if other:
                self._hub.broadcast(events.CardsChanged(cards=other))

    def set_assets(self, assets: Sequence[str]) -> tuple[str, ...]:
        """Show cards of these assets, in this order, and no others; gives those that are new."""
        with self._lock:
            new = tuple(asset for asset in assets if asset not in self._cards)
            present = set(assets)
            gone = tuple(asset for asset in self._cards if asset not in present)
            fresh = {asset: Card(asset=asset) for asset in new}
            self._cards = {asset: fresh.get(asset) or self._cards[asset] for asset in assets}
            if new or gone:
                self._hub.broadcast(events.CardsChanged(cards=tuple(fresh.values()), gone=gone))
        return new

    def show(self, event: events.StateChanged) -> None:
        """Show a change of the state, and send it where something is another now."""
        fields = {name: value for name, value in event if name in events.Hello.model_fields and name != "kind"}
        with self._lock:
            if any(getattr(self._rest, name) != value for name, value in fields.items()):
                self._rest = self._rest.model_copy(update=fields)
                self._hub.broadcast(event)

    def change_project(self, **fields: Any) -> None:
        """Show the project with some of its fields changed."""
        with self._lock:
            self.show(events.ProjectChanged(project=self._rest.project.model_copy(update=fields)))

    def show_problem(self, problem: str, **fields: Any) -> None:
        """Show why nothing can be done with the project, which is what is next."""
        self.change_project(problem=problem, next=NextStep("wait", problem), **fields)

    def set_job(self, job: Job) -> None:
        """Show a job as it stands."""
        with self._lock:
            self._jobs[job.id] = job
            over = [key for key, one in self._jobs.items() if one.state != "running"]
            for key in over[:-MOST_FINISHED_JOBS]:
                del self._jobs[key]
            self._hub.broadcast(events.JobChanged(job=job))

    def announce_assets(self, assets: Sequence[str], shapes: bool) -> None:
        """Send that something of these assets changed; shapes: their hulls, too."""
        if assets:
            self._hub.broadcast(events.AssetsChanged(assets=tuple(assets), shapes=shapes))


class PageConnection:
    """One open page. Its queue ends with None where the connection is to be closed."""

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self.events: asyncio.Queue[str | None] = asyncio.Queue()
        self._loop = loop

    def send(self, text: str | None) -> None:
        """Send an event, or None to close; from any thread."""
        with suppress(RuntimeError):  # the studio is closed, and its loop with it
            self._loop.call_soon_threadsafe(self._put, text)

    def _put(self, text: str | None) -> None:
        self.events.put_nowait(None if self.events.qsize() > MOST_BEHIND else text)


class PageHub:
    """All open pages."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._pages: dict[PageConnection, None] = {}

    def join(self, page: PageConnection, hello: Wire) -> None:
        """Add a page, which gets `hello` first, then all events that follow."""
        with self._lock:
            page.send(hello.model_dump_json())
            self._pages[page] = None

    def leave(self, page: PageConnection) -> None:
        """Remove a page."""
        with self._lock:
            self._pages.pop(page, None)

    def broadcast(self, event: Wire) -> None:
        """Send an event to all pages; from any thread."""
        with self._lock:
            pages = list(self._pages)
            if pages:
                text = event.model_dump_json()
                for page in pages:
                    page.send(text)

    def close(self) -> None:
        """End all connections."""
        with self._lock:
            for page in self._pages:
                page.send(None)
