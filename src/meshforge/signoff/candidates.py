"""The readings of the rules over a family: how probable it is that what a rule does on an asset is what is meant, and
the question that tells readings apart for the fewest seconds."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats, Ints
from meshforge.language import EXTREMITY, Extractor, Program
from meshforge.signoff.program_run import ProgramRun, select_by
from meshforge.synthesis import CandidateProgram

MOST_CANDIDATES = 24
"""Of the readings of a rule so many are compared, the most believed ones."""
LEAST_BELIEF = 0.0005
FEW_ASSETS = 400
"""Up to so many assets learning has looked at all of them, and says where readings differ."""
MOST_CHOICES = 3
Bools = npt.NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class RuleCandidates:
    """The readings of one rule, that of the program first.

    beliefs: (k,), in all 1; kinds: (k, assets), equal where two readings select the same on an asset, 0 for what the
    program does.
    """

    rule: int
    extractors: tuple[Extractor, ...]
    beliefs: Floats
    kinds: Ints

    @property
    def agreement(self) -> Floats:
        """The belief in readings that do on each asset as the program does (assets,)."""
        found: Floats = self.beliefs @ (self.kinds == 0)
        return found

    def discount(self, some: Bools, share: float) -> RuleCandidates:
        """The same where some readings (k,) are wrong with that probability besides."""
        beliefs = np.where(some, self.beliefs * (1 - share), self.beliefs)
        return replace(self, beliefs=beliefs / beliefs.sum())


@dataclass(frozen=True, slots=True)
class CandidateSplit:
    """A question about one rule on one asset: the selections to choose from, as readings that make them; gains: by how
    much more probable the edit of each asset is right in this rule once it is answered (assets,)."""

    rule: int
    asset: int
    heads: tuple[int, ...]
    gains: Floats


def compare_candidates(
    program: Program, candidates: Sequence[CandidateProgram], runs: Sequence[ProgramRun]
) -> tuple[RuleCandidates, ...]:
    """The readings of each rule over a family; a rule without any is what it says."""
    delta = EXTREMITY if program.extremity is None else program.extremity
    found = []
    for number, rule in enumerate(program.rules, 1):
        mine = [one for one in candidates if one.rule == number and one.extractor != rule.extractor]
        own = sum(one.belief for one in candidates if one.rule == number and one.extractor == rule.extractor)
        mine = sorted(mine, key=lambda one: -one.belief)[:MOST_CANDIDATES]
        mine = [one for one in mine if one.belief >= LEAST_BELIEF]
        extractors = (rule.extractor, *(one.extractor for one in mine))
        weights = np.array([own or 1.0, *(one.belief for one in mine)])
        kinds = np.zeros((len(extractors), len(runs)), dtype=np.int64)
        every = len(runs) > FEW_ASSETS
        differs = [frozenset(one.differs_on) for one in mine]
        for place, run in enumerate(runs):
            masks = [select_by(run, number, rule.extractor, delta)]
            masks += [
                select_by(run, number, one.extractor, delta) if every or run.asset in some or run.error else masks[0]
                for one, some in zip(mine, differs, strict=True)
            ]
            numbers: dict[int | None, int] = {}
            kinds[:, place] = [numbers.setdefault(mask, len(numbers)) for mask in masks]
        found.append(RuleCandidates(number, extractors, weights / weights.sum(), kinds))
    return tuple(found)


def split_candidates(known: RuleCandidates, places: Collection[int]) -> list[CandidateSplit]:
    """The questions about a rule on some of the assets, given by their places."""
    found = []
    for asset in places:
        kinds = known.kinds[:, asset]
        if not kinds.any():
            continue
        expected, heads = np.zeros(known.kinds.shape[1]), list[tuple[float, int]]()
        for kind in range(int(kinds.max()) + 1):
            part = np.flatnonzero(kinds == kind)
            head = int(part[np.argmax(known.beliefs[part])]) if kind else 0
            same = known.kinds[part] == known.kinds[head]
            expected += known.beliefs[part] @ same
            heads.append((-float(known.beliefs[part].sum()), head))
        ours, *others = heads
        chosen = sorted([ours, *sorted(others)[: MOST_CHOICES - 1]])
        found.append(CandidateSplit(known.rule, asset, tuple(head for _, head in chosen), expected - known.agreement))
    return found
