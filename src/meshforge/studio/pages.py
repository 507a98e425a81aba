"""The pages that are open, and the state that all of them show: every change is sent at once."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable, Sequence
from contextlib import suppress
from threading import Lock, RLock
from typing import Any

from meshforge.engines import ENGINES
from meshforge.store.history import HistoryState
from meshforge.studio.queries.programs import build_language_view
from meshforge.studio.wire import Wire, events
from meshforge.studio.wire.family import AssessmentView, Card, ProjectView, VocabularyLabel
from meshforge.studio.wire.jobs import Job, LabelUpdate
from meshforge.studio.wire.program import OutcomeView, ProgramView, Reach

MOST_FINISHED_JOBS = 20
"""Jobs that are over and still sent to pages that connect."""

MOST_BEHIND = 2000
"""Events that may wait for a page; one that is farther behind is closed, and connects anew with one `Hello`."""


class PageState:
    """What all pages show now. Each change is sent with it, under one lock, so that every page sees all in order."""

    def __init__(
        self,
        hub: PageHub,
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
    def count(self) -> int:
        """How many assets there are."""
        return len(self._cards)

    @property
    def shown(self) -> events.Hello:
        """What all pages show, but for cards and jobs."""
        return self._rest

    def join(self, page: PageConnection) -> None:
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

    def set_project(self, project: ProjectView) -> None:
        """Show the project as it is now."""
        self._change(events.ProjectChanged(project=project), project=project)

    def set_vocabulary(self, labels: tuple[VocabularyLabel, ...]) -> None:
        """Show other labels."""
        with self._lock:
            self.set_project(self._rest.project.model_copy(update={"vocabulary": labels}))

    def set_problem(self, problem: str) -> None:
        """Show what is wrong with the project."""
        with self._lock:
            self.set_project(self._rest.project.model_copy(update={"problem": problem}))

    def set_history(self, event: events.HistoryChanged) -> None:
        """Show what was done, and what can be undone now."""
        with self._lock:
            self._rest = self._rest.model_copy(update={"history": event.history})
            self._hub.broadcast(event)

    def set_relabelled(self, relabelled: LabelUpdate | None) -> None:
        """Show what the last edit did to all labels."""
        self._change(events.LabelUpdateChanged(relabelled=relabelled), relabelled=relabelled)

    def set_outcome(self, outcome: OutcomeView | None, learning: bool) -> None:
        """Show the outcome of a learning run, or that one has started."""
        self._change(events.OutcomeChanged(outcome=outcome, learning=learning), outcome=outcome, learning=learning)

    def set_program(self, program: ProgramView) -> bool:
        """Show the accepted program; whether its text is another than before."""
        with self._lock:
            before = self._rest.program
            self._change(events.ProgramChanged(program=program), program=program)
            return program.text != before.text

    def set_reach(self, reach: tuple[Reach, ...]) -> None:
        """Show what the program does on all assets."""
        self._change(events.ReachChanged(reach=reach), reach=reach)

    def set_assessment(self, assessment: AssessmentView | None, assessing: bool) -> None:
        """Show how sure the edits are, or that this is not known now."""
        event = events.AssessmentChanged(assessment=assessment, assessing=assessing)
        self._change(event, assessment=assessment, assessing=assessing)

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

    def _change(self, event: Wire, **fields: Any) -> None:
        """Set fields of the state, and send the event where one of them is another now."""
        with self._lock:
            if any(getattr(self._rest, name) != value for name, value in fields.items()):
                self._rest = self._rest.model_copy(update=fields)
                self._hub.broadcast(event)


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
