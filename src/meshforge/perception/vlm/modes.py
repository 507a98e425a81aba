"""From cheap to exact: how many hulls are asked about at once, and in how many pictures they are shown."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

ModeName = Literal["cheap", "balanced", "exact"]


@dataclass(frozen=True, slots=True)
class Mode:
    """hulls: asked about in one question at most; pictures: numbered ones of so many hulls; size [px] of each side.

    questions: over which the pictures are spread, so that each hull is judged several times; plain: of how many of the
    pictures of a question the same without numbers stands beside it.
    """

    hulls: int
    pictures: int
    size: int
    questions: int
    plain: int


MODES: Mapping[ModeName, Mode] = {
    "cheap": Mode(hulls=40, pictures=4, size=768, questions=1, plain=1),
    "balanced": Mode(hulls=12, pictures=4, size=1024, questions=2, plain=2),
    "exact": Mode(hulls=5, pictures=6, size=1024, questions=6, plain=1),
}
