"""Edits of what is done to an asset before any program sees it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from meshforge.studio.edits.base import Edit

if TYPE_CHECKING:
    from meshforge.project import Project

Vector = tuple[float, float, float]


class _Preparing(Edit):
    asset: str

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.preparation(self.asset), project.layout.labels(self.asset))

    def assets(self, project: Project) -> tuple[str, ...]:
        return (self.asset,)


class CutHull(_Preparing):
    """Cut a hull along a plane through `at` [m] across `across`, in the frame that the asset comes in."""

    kind: Literal["cut"] = "cut"
    hull: str
    at: Vector
    across: Vector

    def apply(self, project: Project) -> None:
        project.cut(self.asset, self.hull, self.at, self.across)

    def describe(self, project: Project) -> str:
        return f"{self.hull} of {self.asset} cut in two"


class Unprepare(_Preparing):
    """Take back the last thing that was done to an asset before the program."""

    kind: Literal["unprepare"] = "unprepare"

    def apply(self, project: Project) -> None:
        project.unprepare(self.asset)

    def describe(self, project: Project) -> str:
        return f"last preparation of {self.asset} taken back"
