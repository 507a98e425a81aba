"""Every change that a person can make in the studio, one class each: what it does and which files it touches."""

from typing import Annotated

from pydantic import Field

from meshforge.studio.edits import assets, program, replies

AnyEdit = Annotated[
    assets.LabelHulls
    | assets.SetVocabulary
    | assets.RenameLabel
    | assets.SetUp
    | program.SetSteps
    | program.MoveRule
    | program.DeleteRule
    | program.SetOrientation
    | program.SetLandmarks
    | replies.ReplyToQuestion
    | program.AnswerForRule
    | program.TakeBack
    | program.SetGoal
    | program.WriteProgram
    | assets.CutHull
    | assets.Unprepare
    | assets.DismissSpanning
    | assets.ReviewAssets
    | assets.ExcludeAssets
    | assets.CorrectByHand
    | assets.DropManualEdits,
    Field(discriminator="kind"),
]
