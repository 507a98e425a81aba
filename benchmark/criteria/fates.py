"""What becomes of the parts of an asset, as a task says it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from benchmark.assets.decomposition import bounds
from benchmark.criteria.case import Case
from script.samples.part import Part


@dataclass(frozen=True, slots=True)
class Fate:
    """What becomes of the parts of a label, or of a name (with a number or without).

    fate: `kept`; `gone`; `made`, of new hulls; `whole`, of few hulls, new or not. Which of these parts:
    touching, far: those that touch a part of that label, or that do not;
    extreme: those that reach farthest along an axis of the upright frame, such as +Z.
    Of what is made, where parts that are made `together` are one body, and else each is one:
    share, most: of its volume, so much at least and at most is in hulls;
    hollow: so much of the rest of its convex hull may be in new hulls;
    excess: so much may be around its convex hull, or its smallest box where a box is wanted, of the volume of that;
    hulls: so many there are at most; shape: of that kind, such as box; lowest: the lowest of them is of that kind.
    """

    of: str
    fate: Literal["kept", "gone", "made", "whole"]
    touching: str | None = None
    far: str | None = None
    extreme: str | None = None
    share: float = 0.9
    most: float = 1.0
    hollow: float = 1.0
    excess: float = 0.1
    hulls: int | None = None
    shape: str | None = None
    lowest: str | None = None
    together: bool = False


def assign(case: Case, fates: Sequence[Fate]) -> list[Fate]:
    """The fate of each part: the first that is of it; where none is, the part is kept."""
    kept = Fate("", "kept")
    return [next((row for row in fates if _fits(case, part, row)), kept) for part in case.asset.parts]


def _fits(case: Case, part: Part, fate: Fate) -> bool:
    if not _is_called(part, fate.of):
        return False
    for label, wanted in ((fate.touching, True), (fate.far, False)):
        if label is not None and _touches(case, part, label) != wanted:
            return False
    if fate.extreme is None:
        return True
    axis, side = "XYZ".index(fate.extreme[1]), 1.0 if fate.extreme[0] == "+" else -1.0
    alike = [other for other in case.asset.parts if _is_called(other, fate.of)]
    low, high = bounds(alike)
    reach = _reach(part, axis, side)
    return reach >= max(_reach(other, axis, side) for other in alike) - 0.05 * float(np.linalg.norm(high - low))


def _is_called(part: Part, name: str) -> bool:
    return part.label == name or part.name == name or part.name.rstrip("-_0123456789") == name


def _reach(part: Part, axis: int, side: float) -> float:
    box = part.solid.bounding_box()
    return side * float(box[axis + 3] if side > 0 else box[axis])


def _touches(case: Case, part: Part, label: str) -> bool:
    slack = case.touching
    others = (other for other in case.asset.parts if other is not part and _is_called(other, label))
    return any(float(part.solid.min_gap(other.solid, 2 * slack)) <= slack for other in others)
