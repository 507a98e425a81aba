"""Every change that a person can make in the studio, one class each: what it does and which files it touches."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from meshforge.studio.edits.assets import CorrectByHand, CutHull, DropCorrections, ReviewAssets, Unprepare
from meshforge.studio.edits.labels import LabelFromFiles, LabelFromNames, LabelHulls, RenameLabel, SetVocabulary
from meshforge.studio.edits.program import (
    AnswerQuestion,
    DeleteRule,
    MoveRule,
    SetOrientation,
    SetSteps,
    SettleRepair,
    TakeBack,
    WriteProgram,
)

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
