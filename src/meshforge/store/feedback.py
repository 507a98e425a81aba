"""What a person said: answers and label repairs in answers.json, verdicts on edited assets in review.json."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import Annotated, Any, Literal, Self

from pydantic import ConfigDict, Field, SerializerFunctionWrapHandler, model_serializer, model_validator

from meshforge.store.layout import JsonFile
from meshforge.symbolic import Label, LabelSource
from meshforge.synthesis import Answer, LabelCorrection

Verdict = Literal["accepted", "flagged"]


class _Entry(JsonFile):
    """An answer or a repair. id: its name, which follows from the other fields."""

    id: str

    @model_validator(mode="after")
    def _check_id(self) -> Self:
        if self.id != self.proper_id:
            raise ValueError(f"the id of this entry is {self.proper_id!r}")
        return self

    @property
    @abstractmethod
    def proper_id(self) -> str:
        """The id that it must have."""


class AnswerLine(_Entry):
    """An answer `RULE:ASSET`. select: names of the hulls that the rule selects there, null for neither of the choices,
    which are in `refused`.

    action: what the rule does, in the language's own text without `Each`, so that an answer is not taken for one to
    another rule when steps are put in or left out later.
    """

    rule: Annotated[int, Field(ge=1)]
    asset: str
    select: tuple[str, ...] | None
    action: str | None = None
    refused: tuple[tuple[str, ...], ...] = ()

    @property
    def proper_id(self) -> str:
        return f"{self.rule}:{self.asset}"

    @property
    def answer(self) -> Answer:
        return Answer(self.rule, self.asset, self.select, self.refused)

    def fits(self, actions: Mapping[int, str]) -> bool:
        """Whether its rule still does what it did; actions: what rules do, by number, in the same text."""
        return actions.get(self.rule) == (self.action or actions.get(self.rule, ""))


class RepairLine(_Entry):
    """A repair of a label `ASSET#HULL=LABEL`. was, `from` in the file: the wrong label, null for none."""

    model_config = ConfigDict(populate_by_name=True)

    asset: str
    hull: str
    was: Annotated[str | None, Field(validation_alias="from", serialization_alias="from")]
    to: str

    @property
    def proper_id(self) -> str:
        return repair_id(self.correction)

    @property
    def correction(self) -> LabelCorrection:
        return LabelCorrection(self.asset, self.hull, self.was, self.to)


class LabelBefore(JsonFile):
    """The label that a hull had, by whom, and how sure that was; given: see `Label`, left out where there is none."""

    label: str
    source: LabelSource
    confidence: Annotated[float, Field(ge=0, le=1)]
    given: LabelBefore | None = None

    @staticmethod
    def of(label: Label | None) -> LabelBefore | None:
        if label is None:
            return None
        given = LabelBefore.of(label.given)
        return LabelBefore(label=label.name, source=label.source, confidence=label.confidence, given=given)

    @property
    def annotation(self) -> Label:
        return Label(self.label, self.confidence, self.source, self.given.annotation if self.given else None)

    def rename(self, old: str, new: str) -> LabelBefore:
        """The same where a label has another name."""
        given = self.given.rename(old, new) if self.given else None
        return self.model_copy(update={"label": new if self.label == old else self.label, "given": given})

    @model_serializer(mode="wrap")
    def _leave_out_none(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        found: dict[str, Any] = write(self)
        return {name: value for name, value in found.items() if name != "given" or value is not None}


class ConfirmationLine(RepairLine):
    """A repair that was made. before: what the hull had, null for no label, so that the repair can be taken back."""

    before: LabelBefore | None


class AnswersFile(JsonFile):
    """answers.json: answers by rule and asset, repairs by asset and hull; of one id only the last."""

    answers: tuple[AnswerLine, ...] = ()
    confirmed: tuple[ConfirmationLine, ...] = ()
    rejected: tuple[RepairLine, ...] = ()

    @property
    def ids(self) -> tuple[str, ...]:
        """The ids of all entries."""
        return tuple(line.id for line in (*self.answers, *self.confirmed, *self.rejected))

    def without(self, entry: str) -> AnswersFile:
        """All but the entry of this id."""
        kinds = {"answers": self.answers, "confirmed": self.confirmed, "rejected": self.rejected}
        return self.model_copy(
            update={kind: tuple(line for line in lines if line.id != entry) for kind, lines in kinds.items()}
        )

    def with_line(self, line: AnswerLine | RepairLine) -> AnswersFile:
        """All, and one entry more in place of that of the same id."""
        rest = self.without(line.id)
        if isinstance(line, AnswerLine):
            answers = sorted([*rest.answers, line], key=lambda one: (one.rule, one.asset))
            return rest.model_copy(update={"answers": tuple(answers)})
        kind = "confirmed" if isinstance(line, ConfirmationLine) else "rejected"
        lines = sorted([*getattr(rest, kind), line], key=lambda one: (one.asset, one.hull, one.to))
        return rest.model_copy(update={kind: tuple(lines)})


def repair_id(correction: LabelCorrection) -> str:
    """What a repair is called: `ASSET#HULL=LABEL`, with the label that it gives."""
    return f"{correction.asset}#{correction.hull}={correction.to}"


class RuleSelection(JsonFile):
    """What a rule selected on an accepted asset; action: what the rule does, in the language's text without `Each`."""

    rule: Annotated[int, Field(ge=1)]
    action: str
    select: tuple[str, ...]


class Review(JsonFile):
    """What a person said about one edited asset; output: the digest of the files that were looked at.

    seen: of a result that was accepted by itself, what the program did there.
    """

    verdict: Verdict
    note: str | None = None
    output: str | None = None
    seen: tuple[RuleSelection, ...] = ()


class ReviewFile(JsonFile):
    """All reviews, by asset."""

    assets: dict[str, Review] = Field(default_factory=dict)
