"""What the server tells every open page over the WebSocket; and errors."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from meshforge.studio.wire import Wire
from meshforge.studio.wire.asset import EngineView
from meshforge.studio.wire.family import Card, HistoryView, ProjectView
from meshforge.studio.wire.jobs import Job, Relabelled
from meshforge.studio.wire.program import LessonView, ProgramView, Reach


class Problem(Wire):
    """What went wrong: the message, what it is about, and the remedy.

    conflict: the change was made on a state that is no more; the page shows the present one and asks again.
    """

    message: str
    where: str | None = None
    remedy: str | None = None
    conflict: bool = False


class Hello(Wire):
    """Everything that is known, on connecting.

    tour: whether the page is to show the guided tour; engines: whose limits can be checked.
    """

    kind: Literal["hello"] = "hello"
    version: str
    project: ProjectView
    cards: tuple[Card, ...]
    history: HistoryView
    relabelled: Relabelled | None = None
    program: ProgramView
    lesson: LessonView | None = None
    learning: bool = False
    reach: tuple[Reach, ...] = ()
    jobs: tuple[Job, ...] = ()
    tour: bool = False
    engines: tuple[EngineView, ...] = ()


class CardsChanged(Wire):
    """Cards that are other now; gone: ids of assets that are no more."""

    kind: Literal["cards"] = "cards"
    cards: tuple[Card, ...]
    gone: tuple[str, ...] = ()


class ProjectChanged(Wire):
    """The project as it is now."""

    kind: Literal["project"] = "project"
    project: ProjectView


class HistoryChanged(Wire):
    """What can be undone now; said: what was just done, undone or redone, in words, by which page. Other settings and
    the names of changed assets are told before, their cards after it."""

    kind: Literal["history"] = "history"
    history: HistoryView
    did: Literal["edit", "undo", "redo"]
    said: str
    by: str | None = None


class RelabelledChanged(Wire):
    """What the last edit did to all labels, told after the cards; null as soon as another one was made."""

    kind: Literal["relabelled"] = "relabelled"
    relabelled: Relabelled | None


class AssetsChanged(Wire):
    """Assets of which something changed: an open page fetches them anew. shapes: their hulls are others, too."""

    kind: Literal["assets"] = "assets"
    assets: tuple[str, ...]
    shapes: bool = False


class LessonChanged(Wire):
    """A lesson has begun (`learning`), or its outcome is there."""

    kind: Literal["lesson"] = "lesson"
    lesson: LessonView | None
    learning: bool


class ReachChanged(Wire):
    """What the program does on all assets; lesson: the number of the lesson it belongs to."""

    kind: Literal["reach"] = "reach"
    lesson: int
    reach: tuple[Reach, ...]


class ProgramChanged(Wire):
    """The accepted program as it is now."""

    kind: Literal["program"] = "program"
    program: ProgramView


class JobChanged(Wire):
    """A job as it stands."""

    kind: Literal["job"] = "job"
    job: Job


Event = Annotated[
    Hello
    | CardsChanged
    | ProjectChanged
    | HistoryChanged
    | RelabelledChanged
    | AssetsChanged
    | LessonChanged
    | ReachChanged
    | ProgramChanged
    | JobChanged,
    Field(discriminator="kind"),
]
