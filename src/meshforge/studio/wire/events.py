"""The events that the server sends to every open page over the WebSocket; and errors."""

from typing import Annotated, Literal

from pydantic import Field

from meshforge.store.history import HistoryState
from meshforge.studio.wire import Wire
from meshforge.studio.wire.family import AssessmentView, Card, ProjectView
from meshforge.studio.wire.jobs import Job
from meshforge.studio.wire.program import LanguageView, OutcomeView, ProgramView, Reach
from meshforge.studio.wire.start import StartView


class Problem(Wire):
    """An error. where: what it is about; conflict: the change was based on an old state; the page asks again."""

    message: str
    where: str | None = None
    remedy: str | None = None
    conflict: bool = False


class Start(Wire):
    """No project is open; sent when a page connects."""

    kind: Literal["start"] = "start"
    start: StartView


class Hello(Wire):
    """The whole state, sent when a page connects. tour: whether the page shows the guided tour; engines: the
    titles of those whose limits can be checked, by name; merged_files: formats of which those in `merged_by` make one
    hull a file; leave: whether the page can leave the project."""

    kind: Literal["hello"] = "hello"
    version: str
    project: ProjectView
    cards: tuple[Card, ...]
    history: HistoryState
    program: ProgramView
    language: LanguageView
    outcome: OutcomeView | None = None
    learning: bool = False
    reach: tuple[Reach, ...] = ()
    assessment: AssessmentView | None = None
    assessing: bool = False
    jobs: tuple[Job, ...] = ()
    tour: bool = False
    engines: dict[str, str] = Field(default_factory=dict)
    merged_files: tuple[str, ...] = ()
    merged_by: tuple[str, ...] = ()
    leave: bool = False


class CardsChanged(Wire):
    """New and changed cards; gone: ids of assets that no longer exist."""

    kind: Literal["cards"] = "cards"
    cards: tuple[Card, ...]
    gone: tuple[str, ...] = ()


class ProjectChanged(Wire):
    """The project as it is now."""

    kind: Literal["project"] = "project"
    project: ProjectView


class HistoryChanged(Wire):
    """What can be undone now; by: the page that did, undid or redid something. Changed settings and the names of
    changed assets are sent before, their cards after it."""

    kind: Literal["history"] = "history"
    history: HistoryState
    by: str | None = None


class AssetsChanged(Wire):
    """Assets that changed, for open pages to fetch anew; shapes: whether their hulls changed, too."""

    kind: Literal["assets"] = "assets"
    assets: tuple[str, ...]
    shapes: bool = False


class OutcomeChanged(Wire):
    """A learning run has started (`learning`), or its outcome is there."""

    kind: Literal["outcome"] = "outcome"
    outcome: OutcomeView | None
    learning: bool


class ReachChanged(Wire):
    """What the program does on all assets."""

    kind: Literal["reach"] = "reach"
    reach: tuple[Reach, ...]


class AssessmentChanged(Wire):
    """How sure the edits are now. assessment: null as soon as labels, answers or demonstrations changed, until that is
    known again; assessing: whether that is being worked out."""

    kind: Literal["assessment"] = "assessment"
    assessment: AssessmentView | None
    assessing: bool


class ProgramChanged(Wire):
    """The accepted program as it is now."""

    kind: Literal["program"] = "program"
    program: ProgramView


StateChanged = ProjectChanged | HistoryChanged | OutcomeChanged | ReachChanged | AssessmentChanged | ProgramChanged
"""Other values of the fields of `Hello` that have their names."""


class JobChanged(Wire):
    """A job as it stands."""

    kind: Literal["job"] = "job"
    job: Job


Event = Annotated[Start | Hello | CardsChanged | AssetsChanged | StateChanged | JobChanged, Field(discriminator="kind")]
