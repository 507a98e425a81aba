"""What is at stake between readings, and the question that would settle most of it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

HARM, HARMED = 0.006, 0.2
"""Nothing is asked while no larger share of the assets, or no more of them, are expected to be edited wrongly: a doubt
about one asset in a hundred is reported, and so is a faint one about one of seven, which is sooner seen than asked.
Measured (`script/bench asking`) on 52 kinds of rules and families that nothing was fitted on: from one demonstration
and 1.3 answers on average 96% of the rules are right on every asset, from two and 0.9 answers 97%; without questions
68% and 80%."""
CHOICES = 3
"""A person compares so many pictures at once; "neither" stands for all other readings."""

_NOTHING = 1e-9  # less harm than this is none


@dataclass(frozen=True, slots=True)
class Split:
    """An asset on which readings differ.

    asset: its place; choices: places of the most believed reading of each choice, the most believed choice first; what
    the program does is one of them.
    left: the expected harm that stays after the answer.
    """

    asset: int
    choices: tuple[int, ...]
    left: float


class Doubt:
    """Some readings of one rule over the assets of a batch, of which the first is the one that the program has.

    selections: for each reading, what it selects on each asset, in any form that can be compared; beliefs: of each.
    """

    def __init__(self, selections: Sequence[Sequence[object]], beliefs: Sequence[float]) -> None:
        columns = [_numbered(column) for column in zip(*selections, strict=True)]
        self._kinds = np.array(columns, dtype=np.int64).reshape(-1, len(beliefs)).T
        self._beliefs = np.array(beliefs)
        self.differs = (self._kinds[:, None] != self._kinds[None]).mean(axis=2) if columns else None

    @property
    def harm(self) -> float:
        """The expected share of assets that the program edits wrongly in this rule."""
        return 0.0 if self.differs is None else float(self._beliefs @ self.differs[0])

    @property
    def grave(self) -> bool:
        """Whether the harm is worth a question."""
        return self.harm > max(HARM, HARMED / max(self._kinds.shape[1], 1))

    def best(self, askable: Iterable[int]) -> Split | None:
        """The question that leaves the least harm, of assets that can be asked about; of equals, the first."""
        splits = (split for asset in askable if (split := self._split(asset)))
        return min(splits, key=lambda split: (round(split.left, 12), split.asset), default=None)

    def gains(self, first: int) -> dict[int, float]:
        """How much harm an answer about each asset from `first` on would spare, where there is any."""
        assets = range(first, self._kinds.shape[1])
        found = {asset: self.harm - split.left for asset in assets if (split := self._split(asset))}
        return {asset: gain for asset, gain in found.items() if gain > _NOTHING}

    def _split(self, asset: int) -> Split | None:
        assert self.differs is not None
        kinds = self._kinds[:, asset]
        if not kinds.any():
            return None
        weighed, left = [], 0.0
        for kind in range(int(kinds.max()) + 1):
            part = np.flatnonzero(kinds == kind)
            heads = part[np.argmax(self._beliefs[part])] if kind else 0
            left += float(self._beliefs[part] @ self.differs[heads][part])
            weighed.append((-float(self._beliefs[part].sum()), int(heads)))
        ours, *others = weighed
        choices = sorted([ours, *sorted(others)[: CHOICES - 1]])
        return Split(asset, tuple(head for _, head in choices), left)


def _numbered(column: Sequence[object]) -> list[int]:
    """Equal entries get equal numbers, the first 0, the next new one 1."""
    numbers: dict[object, int] = {}
    return [numbers.setdefault(entry, len(numbers)) for entry in column]
