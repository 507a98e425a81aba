"""What is at stake between readings, and the question that would settle most of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.geometry import Floats

SEEN = 12
"""So many results a person looks at before accepting a program (paper, protocol): what differs on many assets is seen,
what differs on few is likely not."""
UNSEEN = 1.0
"""What a wrong program that is accepted costs above one that is seen, in demonstrations; that one costs one. Little,
since the results that are looked at are chosen so that they show it."""
PRICE = 0.4
"""What a question must spare to be asked, in demonstrations. Measured on the calibration set of the benchmark
(`script/bench tuning`), where demonstrators look at the results that are proposed: all of 120 sessions end right with
any price; demonstrations plus answers are 2.2 a task, 1.9 at a price of 0.5, 2.9 at 0.25, a person's time as modelled
61, 63 and 51 s."""
CHOICES = 3
"""A person compares so many pictures at once; "neither" stands for all other readings."""

_NOTHING = 1e-9  # less harm than this is none


@dataclass(frozen=True, slots=True)
class Split:
    """An asset on which readings differ.

    asset: its place; choices: places of the most believed reading of each choice, the most believed choice first; what
    the program does is one of them.
    left: the expected harm that stays after the answer; spared: what the answer is worth, in demonstrations.
    """

    asset: int
    choices: tuple[int, ...]
    left: float
    spared: float

    @property
    def is_worth_asking(self) -> bool:
        return self.spared > PRICE


class Doubt:
    """Some readings of one rule over the assets of a batch, of which the first is the one that the program has.

    selections: for each reading, what it selects on each asset, in any form that can be compared; beliefs: of each.
    """

    def __init__(self, selections: Sequence[Sequence[object]], beliefs: Sequence[float]) -> None:
        columns = [_numbered(column) for column in zip(*selections, strict=True)]
        self._kinds = np.array(columns, dtype=np.int64).reshape(-1, len(beliefs)).T
        self._beliefs = np.array(beliefs)
        self.differs = (self._kinds[:, None] != self._kinds[None]).mean(axis=2) if columns else None
        self._costs = None if self.differs is None else _costs(self.differs)

    @property
    def harm(self) -> float:
        """The expected share of assets that the program edits wrongly in this rule."""
        return 0.0 if self.differs is None else float(self._beliefs @ self.differs[0])

    def best_question(self, trust: Mapping[int, float]) -> Split | None:
        """The question that spares most; of equals, the first.

        trust: the assets that can be asked about, with how much an answer there is worth: where labels are wrong, what
        is right to say is what no reading does.
        """
        splits = (split for asset in trust if (split := self._split(asset)))
        return min(splits, key=lambda one: (-round(one.spared * trust[one.asset], 12), one.asset), default=None)

    def gains(self, first: int) -> dict[int, float]:
        """How much harm an answer about each asset from `first` on would spare, where there is any."""
        assets = range(first, self._kinds.shape[1])
        found = {asset: self.harm - split.left for asset in assets if (split := self._split(asset))}
        return {asset: gain for asset, gain in found.items() if gain > _NOTHING}

    def _split(self, asset: int) -> Split | None:
        assert self.differs is not None
        assert self._costs is not None
        kinds = self._kinds[:, asset]
        if not kinds.any():
            return None
        weighed, left, spared = [], 0.0, float(self._beliefs @ self._costs[0])
        for kind in range(int(kinds.max()) + 1):
            part = np.flatnonzero(kinds == kind)
            heads = part[np.argmax(self._beliefs[part])] if kind else 0
            left += float(self._beliefs[part] @ self.differs[heads][part])
            spared -= float(self._beliefs[part] @ self._costs[heads][part])
            weighed.append((-float(self._beliefs[part].sum()), int(heads)))
        ours, *others = weighed
        choices = sorted([ours, *sorted(others)[: CHOICES - 1]])
        return Split(asset, tuple(head for _, head in choices), left, spared)


def _costs(differs: Floats) -> Floats:
    """What it costs to have one reading where another is meant, in demonstrations; differs: shares of assets."""
    costs: Floats = np.where(differs > 0, 1 + UNSEEN * (1 - differs) ** SEEN, 0.0)
    return costs


def _numbered(column: Sequence[object]) -> list[int]:
    """Equal entries get equal numbers, the first 0, the next new one 1."""
    numbers: dict[object, int] = {}
    return [numbers.setdefault(entry, len(numbers)) for entry in column]
