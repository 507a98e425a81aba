"""answers.json: what a person said while a program was learned, as the file keeps it."""

from __future__ import annotations

from abc import abstractmethod
from typing import Annotated, Self

from pydantic import ConfigDict, Field, model_validator

from meshforge.project.json_files import JsonFile
from meshforge.symbolic import Label, Source
from meshforge.synthesis import Answer, Correction


class _Said(JsonFile):
    """One thing that was said. id: what it is called; it follows from the other fields."""

    id: str

    @model_validator(mode="after")
    def _check_id(self) -> Self:
        if self.id != self.proper_id:
            raise ValueError(f"the id of this entry is {self.proper_id!r}")
        return self

    @property
    @abstractmethod
    def proper_id(self) -> str:
        """What it is to be called."""


class AnswerLine(_Said):
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


class RepairLine(_Said):
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
    def correction(self) -> Correction:
        return Correction(self.asset, self.hull, self.was, self.to)


class LabelBefore(JsonFile):
    """The label that a hull had, by whom, and how sure that was."""

    label: str
    source: Source
    confidence: Annotated[float, Field(ge=0, le=1)]

    @staticmethod
    def of(label: Label | None) -> LabelBefore | None:
        return LabelBefore(label=label.name, source=label.source, confidence=label.confidence) if label else None

    @property
    def annotation(self) -> Label:
        return Label(self.label, self.confidence, self.source)


class ConfirmedLine(RepairLine):
    """A repair that was made. before: what the hull had, null for no label, so that the repair can be taken back."""

    before: LabelBefore | None


class AnswersFile(JsonFile):
    """answers.json: answers by rule and asset, repairs by asset and hull; of one id only what was said last."""

    answers: tuple[AnswerLine, ...] = ()
    confirmed: tuple[ConfirmedLine, ...] = ()
    rejected: tuple[RepairLine, ...] = ()

    @property
    def ids(self) -> tuple[str, ...]:
        """The ids of everything that was said."""
        return tuple(line.id for line in (*self.answers, *self.confirmed, *self.rejected))

    def without(self, said: str) -> AnswersFile:
        """The same without what has this id."""
        return self.model_copy(
            update={
                "answers": tuple(line for line in self.answers if line.id != said),
                "confirmed": tuple(line for line in self.confirmed if line.id != said),
                "rejected": tuple(line for line in self.rejected if line.id != said),
            }
        )

    def with_line(self, line: AnswerLine | RepairLine) -> AnswersFile:
        """The same with one thing more, in place of what was said under its id before."""
        rest = self.without(line.id)
        match line:
            case AnswerLine():
                lines = sorted([*rest.answers, line], key=lambda one: (one.rule, one.asset))
                return rest.model_copy(update={"answers": tuple(lines)})
            case ConfirmedLine():
                return rest.model_copy(update={"confirmed": tuple(sorted([*rest.confirmed, line], key=_place))})
            case _:
                return rest.model_copy(update={"rejected": tuple(sorted([*rest.rejected, line], key=_place))})


def repair_id(correction: Correction) -> str:
    """What a repair is called: `ASSET#HULL=LABEL`, with the label that it gives."""
    return f"{correction.asset}#{correction.hull}={correction.to}"


def _place(line: RepairLine) -> tuple[str, str, str]:
    return line.asset, line.hull, line.to
