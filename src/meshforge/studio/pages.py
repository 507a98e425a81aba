"""The pages that are open, and the state that all of them are shown: kept here, sent as soon as it changes."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable, Sequence
from contextlib import suppress
from threading import Lock, RLock

from meshforge.checks import ENGINES
from meshforge.studio.wire import Wire, events
from meshforge.studio.wire.asset import EngineView
from meshforge.studio.wire.family import Card, HistoryView, ProjectView, VocabularyLabel
from meshforge.studio.wire.jobs import Job, Relabelled
from meshforge.studio.wire.program import LessonView, ProgramView, Reach

MOST_FINISHED_JOBS = 20
"""Jobs that are over and still shown to pages that connect."""

_ENGINES = tuple(EngineView(name=engine.name, title=engine.title) for engine in ENGINES.values())

MOST_BEHIND = 2000
"""Events that a page may be behind; one that is farther behind is closed, and connects anew with one `Hello`."""


class PageState:
    """The present state; every change and what pages are told of it are one, so that each page sees all in order."""

    def __init__(self, hub: PageHub, project: ProjectView, history: HistoryView, version: str, tour: bool) -> None:
        self._lock, self._hub = RLock(), hub
        self._version, self._tour = version, tour
        self._project, self._history = project, history
        self._relabelled: Relabelled | None = None
        self._cards: dict[str, Card] = {}
        self._program = ProgramView()
        self._lesson: LessonView | None = None
        self._learning = False
        self._reach: tuple[Reach, ...] = ()
        self._jobs: dict[str, Job] = {}

    @property
    def cards(self) -> tuple[Card, ...]:
        with self._lock:
            return tuple(self._cards.values())

    @property
    def project(self) -> ProjectView:
        with self._lock:
            return self._project

    @property
    def lesson(self) -> LessonView | None:
        with self._lock:
            return self._lesson

    @property
    def program(self) -> ProgramView:
        with self._lock:
            return self._program

    def join(self, page: PageConnection) -> None:
        """Show everything to a page, and from now on what changes."""
        with self._lock:
            hello = events.Hello(
                version=self._version,
                project=self._project,
                cards=self.cards,
                history=self._history,
                relabelled=self._relabelled,
                program=self._program,
                lesson=self._lesson,
                learning=self._learning,
                reach=self._reach,
                jobs=tuple(self._jobs.values()),
                tour=self._tour,
                engines=_ENGINES,
            )
            self._hub.join(page, hello)

    def set_cards(self, cards: Iterable[Card]) -> None:
        """Show some cards anew; those of assets that went while they were looked at are left out."""
        with self._lock:
            other = tuple(card for card in cards if self._cards.get(card.asset, card) != card)
            self._cards |= {card.asset: card for card in other}
            if other:
                self._hub.broadcast(events.CardsChanged(cards=other))

    def set_assets(self, assets: Sequence[str]) -> tuple[str, ...]:
        """Show cards of these assets, in this order, and no others; gives those that are new."""
        with self._lock:
            new = tuple(asset for asset in assets if asset not in self._cards)
            gone = tuple(asset for asset in self._cards if asset not in set(assets))
            fresh = {asset: Card(asset=asset) for asset in new}
            self._cards = {asset: fresh.get(asset) or self._cards[asset] for asset in assets}
            if new or gone:
                self._hub.broadcast(events.CardsChanged(cards=tuple(fresh.values()), gone=gone))
        return new

    def set_project(self, project: ProjectView) -> None:
        """Show the project anew."""
        with self._lock:
            if project != self._project:
                self._project = project
                self._hub.broadcast(events.ProjectChanged(project=project))

    def set_vocabulary(self, labels: tuple[VocabularyLabel, ...]) -> None:
        """Show other labels."""
        with self._lock:
            self.set_project(self._project.model_copy(update={"vocabulary": labels}))

    def set_problem(self, problem: str) -> None:
        """Show what is wrong with the project."""
        with self._lock:
            self.set_project(self._project.model_copy(update={"problem": problem}))

    def set_history(self, event: events.HistoryChanged) -> None:
        """Show what was done, and what can be undone now."""
        with self._lock:
            self._history = event.history
            self._hub.broadcast(event)

    def set_relabelled(self, relabelled: Relabelled | None) -> None:
        """Show what the last edit did to all labels."""
        with self._lock:
            if relabelled != self._relabelled:
                self._relabelled = relabelled
                self._hub.broadcast(events.RelabelledChanged(relabelled=relabelled))

    def set_lesson(self, lesson: LessonView | None, learning: bool) -> None:
        """Show a lesson, or that one has begun."""
        with self._lock:
            if (lesson, learning) != (self._lesson, self._learning):
                self._lesson, self._learning = lesson, learning
                self._hub.broadcast(events.LessonChanged(lesson=lesson, learning=learning))

    def set_program(self, program: ProgramView) -> bool:
        """Show the accepted program; whether its text is another than before."""
        with self._lock:
            before, self._program = self._program, program
            if program != before:
                self._hub.broadcast(events.ProgramChanged(program=program))
            return program.text != before.text

    def set_reach(self, lesson: int, reach: tuple[Reach, ...]) -> None:
        """Show what the program does on all assets."""
        with self._lock:
            if reach != self._reach:
                self._reach = reach
                self._hub.broadcast(events.ReachChanged(lesson=lesson, reach=reach))

    def set_job(self, job: Job) -> None:
        """Show a job as it stands."""
        with self._lock:
            self._jobs[job.id] = job
            over = [key for key, one in self._jobs.items() if one.state != "running"]
            for key in over[:-MOST_FINISHED_JOBS]:
                del self._jobs[key]
            self._hub.broadcast(events.JobChanged(job=job))

    def announce_assets(self, assets: Sequence[str], shapes: bool) -> None:
        """Tell that something of these assets changed."""
        if assets:
            self._hub.broadcast(events.AssetsChanged(assets=tuple(assets), shapes=shapes))


class PageConnection:
    """One open page. Its queue ends with None where the connection is to be closed."""

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self.events: asyncio.Queue[str | None] = asyncio.Queue()
        self._loop = loop

    def send(self, text: str | None) -> None:
        """Add to what it is told; from any thread."""
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
        """Add a page, which is told `hello` first, then everything that comes after that."""
        with self._lock:
            page.send(hello.model_dump_json())
            self._pages[page] = None

    def leave(self, page: PageConnection) -> None:
        """A page is no more."""
        with self._lock:
            self._pages.pop(page, None)

    def broadcast(self, event: Wire) -> None:
        """Tell all pages; from any thread."""
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
