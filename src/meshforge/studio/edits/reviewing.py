"""Edits of what is said about outputs, and edits by hand."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from meshforge.project import parse_action_text
from meshforge.studio.edits.base import Edit
from meshforge.words import counted

if TYPE_CHECKING:
    from meshforge.project import Project


class ReviewAssets(Edit):
    """Accept or flag the outputs of some assets; null takes that back."""

    kind: Literal["review"] = "review"
    ids: tuple[str, ...]
    verdict: Literal["accepted", "flagged"] | None
    note: str | None = None

    def apply(self, project: Project) -> None:
        project.review(self.ids, self.verdict, self.note)

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.review,)

    def describe(self, project: Project) -> str:
        what = self.ids[0] if len(self.ids) == 1 else counted(len(self.ids), "asset")
        return f"{what} {self.verdict or 'not reviewed'}"

    def assets(self, project: Project) -> tuple[str, ...]:
        return self.ids


class CorrectByHand(Edit):
    """Add an edit by hand, on hulls by the names they have after the program and the edits before."""

    kind: Literal["correct"] = "correct"
    asset: str
    select: tuple[str, ...]
    action: str

    def apply(self, project: Project) -> None:
        project.correct(self.asset, self.select, *parse_action_text(self.action, "action"))

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.corrections(self.asset),)

    def describe(self, project: Project) -> str:
        return f"{self.asset} edited by hand: {self.action}"

    def assets(self, project: Project) -> tuple[str, ...]:
        return (self.asset,)


class DropCorrections(Edit):
    """Take all edits by hand away from an asset, so that it is what the program makes of it."""

    kind: Literal["drop-corrections"] = "drop-corrections"
    asset: str

    def apply(self, project: Project) -> None:
        project.drop_corrections(self.asset)

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.corrections(self.asset),)

    def describe(self, project: Project) -> str:
        return f"edits by hand of {self.asset} taken away"

    def assets(self, project: Project) -> tuple[str, ...]:
        return (self.asset,)
