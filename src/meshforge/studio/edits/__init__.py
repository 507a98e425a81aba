"""Every change that a person can make in the studio: one class each, with what it does and what it touches."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from meshforge.studio.edits.base import Edit
from meshforge.studio.edits.demonstrating import DeleteRule, MoveRule, SetOrientation, SetSteps, StepText
from meshforge.studio.edits.labels import LabelFromFiles, LabelFromNames, LabelHulls, RenameLabel, SetVocabulary
from meshforge.studio.edits.learning import AnswerQuestion, SettleRepair, TakeBack, WriteProgram
from meshforge.studio.edits.preparing import CutHull, Unprepare
from meshforge.studio.edits.reviewing import CorrectByHand, DropCorrections, ReviewAssets

AnyEdit = Annotated[
    LabelHulls
    | LabelFromFiles
    | LabelFromNames
    | SetVocabulary
    | RenameLabel
    | SetSteps
    | MoveRule
    | DeleteRule
    | SetOrientation
    | AnswerQuestion
    | SettleRepair
    | TakeBack
    | WriteProgram
    | CutHull
    | Unprepare
    | ReviewAssets
    | CorrectByHand
    | DropCorrections,
    Field(discriminator="kind"),
]

__all__ = ["AnyEdit", "Edit", "StepText"]
