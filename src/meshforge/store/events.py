"""events.jsonl: what people said of a family, one JSON object a line in the order in which it was said."""

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple, Self, TypeVar

from pydantic import (
    AliasChoices,
    ConfigDict,
    Field,
    SerializerFunctionWrapHandler,
    TypeAdapter,
    ValidationError,
    model_serializer,
)

from meshforge import symbolic, synthesis
from meshforge.batch import RuleSelection
from meshforge.common import ProjectError, first_validation_error
from meshforge.signoff.question import ExclusionReason, ReviewQuestion, ReviewReply
from meshforge.store.layout import JsonFile

Line = TypeVar("Line")
Verdict = Literal["accepted", "wrong"]
Probability = Annotated[float, Field(ge=0, le=1)]


class QuestionAndReply(JsonFile):
    """A question and the reply to it, as the files of questions and of replies have them."""

    asked: dict[str, Any]
    reply: dict[str, Any]


class Origin(NamedTuple):
    """Where an event comes from: the id of its question, the name that the person gave, and what was asked and said."""

    question: str | None = None
    by: str | None = None
    origin: QuestionAndReply | None = None

    @staticmethod
    def of(question: ReviewQuestion, reply: ReviewReply) -> "Origin":
        return Origin(question.id, reply.by, QuestionAndReply(asked=question.to_json(), reply=reply.to_json()))


NO_ORIGIN = Origin()


class _Line(JsonFile):
    """One event. by, question, origin: see `Origin`; origin is called said in files of earlier versions."""

    model_config = ConfigDict(populate_by_name=True)

    by: str | None = None
    question: str | None = None
    origin: QuestionAndReply | None = Field(default=None, validation_alias=AliasChoices("origin", "said"))

    @model_serializer(mode="wrap")
    def _leave_out_defaults(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        fields = type(self).model_fields
        empty = {one.serialization_alias or name for name, one in fields.items() if getattr(self, name) == one.default}
        found: dict[str, Any] = write(self)
        kind = {"event": found["event"]} if "event" in found else {}
        return {**kind, **{name: value for name, value in found.items() if name not in empty}}


class _Withdrawable(_Line):
    """What can be withdrawn by its id."""

    @property
    @abstractmethod
    def id(self) -> str:
        """Follows from the other fields; of one id only the last event counts."""

    def with_origin(self, origin: Origin) -> Self:
        return self.model_copy(update=origin._asdict())


class AnswerEvent(_Withdrawable):
    """An answer `RULE:ASSET`. select: names of the hulls that the rule selects there; None for none of the choices,
    which are in `refused`.

    action: what the rule does, in the language's own text without `Each`, so that an answer is not taken for one to
    another rule when steps are put in or left out later.
    """

    event: Literal["answer"] = "answer"
    rule: Annotated[int, Field(ge=1)]
    asset: str
    select: tuple[str, ...] | None = None
    action: str | None = None
    refused: tuple[tuple[str, ...], ...] = ()

    @property
    def id(self) -> str:
        return f"{self.rule}:{self.asset}"

    @property
    def answer(self) -> synthesis.Answer:
        return synthesis.Answer(self.rule, self.asset, self.select, self.refused)

    def fits(self, actions: Mapping[int, str]) -> bool:
        """Return whether its rule still does what it did; actions: what rules do, by number, in the same text."""
        return actions.get(self.rule) == (self.action or actions.get(self.rule, ""))


class LabelBefore(JsonFile):
    """The label that a hull had, by whom, and how sure that was; given: see `Label`, left out where there is none."""

    label: str
    source: symbolic.LabelSource
    confidence: Probability
    given: "LabelBefore | None" = None

    @model_serializer(mode="wrap")
    def _leave_out_given(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        found: dict[str, Any] = write(self)
        return {name: value for name, value in found.items() if name != "given" or value is not None}

    @staticmethod
    def of(label: symbolic.Label | None) -> "LabelBefore | None":
        if label is None:
            return None
        given = LabelBefore.of(label.given)
        return LabelBefore(label=label.name, source=label.source, confidence=label.confidence, given=given)

    @property
    def annotation(self) -> symbolic.Label:
        return symbolic.Label(self.label, self.confidence, self.source, self.given.annotation if self.given else None)

    def rename(self, old: str, new: str) -> "LabelBefore":
        """Return the same where a label has another name."""
        given = self.given.rename(old, new) if self.given else None
        return self.model_copy(update={"label": new if self.label == old else self.label, "given": given})


class LabelFixEvent(_Withdrawable):
    """A fix of a label `ASSET#HULL=LABEL`. was, `from` in the file: the label before, None for none; accepted: whether
    it was made, else refused; before: all about the label before, so that the fix can be withdrawn."""

    event: Literal["label fix"] = "label fix"
    asset: str
    hull: str
    was: Annotated[str | None, Field(validation_alias="from", serialization_alias="from")] = None
    to: str
    accepted: bool
    before: LabelBefore | None = None

    @property
    def id(self) -> str:
        return self.fix.id

    @property
    def fix(self) -> synthesis.LabelFix:
        return synthesis.LabelFix(self.asset, self.hull, self.was, self.to)

    def rename(self, old: str, new: str) -> "LabelFixEvent":
        """Return the same where a label has another name."""
        was, to = (new if label == old else label for label in (self.was, self.to))
        before = self.before.rename(old, new) if self.before else None
        return self.model_copy(update={"was": was, "to": to, "before": before})


class WithdrawalEvent(_Line):
    """An answer or a fix taken back. id: its id."""

    event: Literal["withdrawal"] = "withdrawal"
    id: str


class VerdictEvent(_Line):
    """What a person said of a result; verdict: None takes the last one back.

    output: the digest of the files that were looked at, None where there were none; seen: what the program did there,
    where the result was looked at by itself; meant: what it should have done, where a person said so of a wrong result;
    goals: texts of those that fail on it, and that the person accepted all the same.
    """

    event: Literal["verdict"] = "verdict"
    asset: str
    verdict: Verdict | None = None
    note: str | None = None
    output: str | None = None
    seen: tuple[RuleSelection, ...] = ()
    meant: tuple[RuleSelection, ...] = ()
    goals: tuple[str, ...] = ()


class LabelsEvent(_Line):
    """Labels that a person gave in reply to a question; what holds of them is in the labels files."""

    event: Literal["labels"] = "labels"
    labels: dict[str, dict[str, str]]


class ReplyEvent(_Line):
    """A reply of which the effect is in other files: a demonstration, the settings, or how an asset is prepared."""

    event: Literal["reply"] = "reply"


class ExclusionEvent(_Line):
    """An asset that is given up; reason: None includes it again."""

    event: Literal["exclusion"] = "exclusion"
    asset: str
    reason: ExclusionReason | None = None


class SnoozeEvent(_Line):
    """A question that is not asked again as long as what it is about stays; without one, all are asked again."""

    event: Literal["snooze"] = "snooze"


Event = (
    AnswerEvent
    | LabelFixEvent
    | WithdrawalEvent
    | VerdictEvent
    | LabelsEvent
    | ReplyEvent
    | ExclusionEvent
    | SnoozeEvent
)
_ADAPTER: TypeAdapter[Event] = TypeAdapter(Annotated[Event, Field(discriminator="event")])


def parse_events(text: str, where: str) -> tuple[Event, ...]:
    """Return the events of a file. Raises ProjectError, naming the line, for one that is none."""
    return tuple(parse_line(_ADAPTER.validate_json, line, number, where) for number, line in list_lines(text))


def read_lines(path: Path) -> str:
    """Read the text of a file of lines, empty where there is none. Raises ProjectError where it cannot be read."""
    try:
        return path.read_text("utf-8-sig")
    except FileNotFoundError:
        return ""
    except UnicodeDecodeError as error:
        remedy = "Correct the file by hand, or remove it: it is text in UTF-8."
        raise ProjectError("cannot be read: it is not text in UTF-8", where=str(path), remedy=remedy) from error
    except OSError as error:
        raise ProjectError(f"cannot be read: {error.strerror}", where=str(path)) from error


def list_lines(text: str) -> Iterator[tuple[int, str]]:
    """Yield the lines of a file that hold anything, with their numbers."""
    yield from ((number, line) for number, line in enumerate(text.split("\n"), 1) if line.strip())


def parse_line(parse: Callable[[str], Line], line: str, number: int, where: str) -> Line:
    """Return what a line holds. Raises ProjectError, naming it, where it is not what it should be."""
    try:
        return parse(line)
    except ValidationError as error:
        remedy = "Correct that line by hand, or remove it: each line is one JSON object."
        raise ProjectError(f"line {number}: {first_validation_error(error)}", where=where, remedy=remedy) from error


def format_lines(lines: Iterable[JsonFile]) -> str:
    """Return the text of a file of lines."""
    return "".join(f"{line.model_dump_json(by_alias=True)}\n" for line in lines)
