"""Every change that a person can make in the studio, one class each: what it does and which files it touches."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from meshforge.studio.edits import assets, program

AnyEdit = Annotated[
    assets.LabelHulls
    | assets.LabelGroup
    | assets.LabelFromFiles
    | assets.LabelFromNames
    | assets.SetVocabulary
    | assets.RenameLabel
    | program.SetSteps
    | program.CorrectSelection
    | program.MoveRule
    | program.DeleteRule
    | program.SetOrientation
    | program.AnswerQuestion
    | program.SettleRepair
    | program.TakeBack
    | program.PutOff
    | program.WriteProgram
    | assets.CutHull
    | assets.SplitSpan
    | assets.MarkAsOnePart
    | assets.Unprepare
    | assets.ReviewAssets
    | assets.CorrectByHand
    | assets.DropCorrections
    | assets.LeaveOut
    | assets.RemoveAssets,
    Field(discriminator="kind"),
]
