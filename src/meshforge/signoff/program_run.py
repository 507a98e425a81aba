"""A program tried on the assets of a family: what its rules select there, and what would change that: other labels of
the hulls, and other readings of the rules, which a question tells apart for the fewest seconds."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from meshforge.common import MeshForgeError
from meshforge.geometry import Floats, Ints
from meshforge.language import EXTREMITY, Extractor, Orient, Program, Template, find_rotation, labels_of, select_mask
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import CandidateProgram, memoize

LEAST_CHANCE = 0.003
"""A label that a hull has with a lower probability is not reckoned with."""
_SAME_FRAME = np.cos(np.radians(5.0))  # frames that turn by less are the same
RULE_OF_FRAME = 0
"""Stands for the orientation where rules are numbered from 1."""


@dataclass(frozen=True, slots=True)
class AlternativeLabel:
    """A hull that may have another label, with which the edit would be another one.

    chance: of that label; rules: the numbers of those that would select otherwise; 0 for the orientation; selections:
    what these would select, as bit sets; nothing for the orientation.
    """

    hull: str
    was: str | None
    to: str
    chance: float
    rules: tuple[int, ...]
    selections: tuple[int, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class ProgramRun:
    """One asset under a program. meshes: as each rule meets it; selections: of the rules, as bit sets; error: why the
    program cannot run, None where it can; flips: the labels that matter.
    """

    asset: str
    meshes: tuple[SymbolicMesh, ...]
    selections: tuple[int, ...]
    alternatives: tuple[AlternativeLabel, ...] = ()
    error: str | None = None

    def names(self, rule: int, mask: int) -> tuple[str, ...]:
        """Return the hulls of a bit set, as a rule meets them; rule: its number."""
        return tuple(self.meshes[rule - 1].names_of(mask))

    @property
    def selected(self) -> tuple[frozenset[str], ...]:
        """What each rule selects, names of hulls; of the rules that were reached."""
        return tuple(frozenset(self.names(rule, mask)) for rule, mask in enumerate(self.selections, 1))


def run_on_asset(asset: str, mesh: SymbolicMesh, program: Program, templates: Mapping[str, Template]) -> ProgramRun:
    """Return the program on an asset."""
    delta = EXTREMITY if program.extremity is None else program.extremity
    meshes, selections = list[SymbolicMesh](), list[int]()
    try:
        program.check_has_labels(mesh)
        replays = program.replay(mesh, templates, name=asset, memo=memoize)
        for rule, replay in zip(program.rules, replays, strict=False):
            meshes.append(replay.mesh)
            selections.append(select_mask(rule.extractor, replay.mesh, delta))
        next(replays, None)  # the last rule
    except MeshForgeError as error:
        return ProgramRun(asset, tuple(meshes), tuple(selections), error=error.problem)
    return ProgramRun(asset, tuple(meshes), tuple(selections))


def find_alternatives(
    run: ProgramRun, mesh: SymbolicMesh, program: Program, labels: Sequence[str], chances: Floats
) -> tuple[AlternativeLabel, ...]:
    """Return the other labels of hulls with which a rule would select otherwise, or the asset be turned otherwise.

    mesh: the asset; chances: (hulls, labels) of it.
    """
    delta = EXTREMITY if program.extremity is None else program.extremity
    asked = [frozenset(labels_of(rule.extractor)) for rule in program.rules]
    before = _frame_of(mesh, program.orient) if program.orient else None
    landmarks = frozenset(Program(orient=program.orient).labels_asked)
    every = landmarks.union(*asked)
    seen = [[hull.label for hull in met.hulls] for met in run.meshes]
    found = list[AlternativeLabel]()
    for row, hull in enumerate(mesh.hulls):
        for place in np.flatnonzero(chances[row] >= LEAST_CHANCE).tolist():
            to = labels[place]
            if to == hull.label or not {to, hull.label} & every:
                continue
            turned = bool({to, hull.label} & landmarks) and _turns(mesh, row, to, program.orient, before)
            others = {RULE_OF_FRAME: 0} if turned else {}
            for number, (rule, met, names) in enumerate(zip(program.rules, run.meshes, seen, strict=False), 1):
                at = met.index.get(hull.name)
                if at is None or names[at] != hull.label or not {to, hull.label} & asked[number - 1]:
                    continue
                asks = to if to in asked[number - 1] else None  # any other is alike to the rule
                other = _select_with_label(rule.extractor, met, delta, at, asks, names)
                if other != run.selections[number - 1]:
                    others[number] = other
            if others:
                chance = float(chances[row, place])
                found.append(AlternativeLabel(hull.name, hull.label, to, chance, tuple(others), tuple(others.values())))
    return tuple(found)


def _select_with_label(
    extractor: Extractor, mesh: SymbolicMesh, delta: float, place: int, to: str | None, labels: Sequence[str | None]
) -> int:
    """What an extractor selects with another label of one hull; labels: of all hulls now."""
    other = [*labels[:place], to, *labels[place + 1 :]]
    key = ("selected", extractor, delta, place, to)
    return memoize(mesh, key, int, lambda: select_mask(extractor, mesh, delta, other))


def _turns(mesh: SymbolicMesh, row: int, to: str, orient: Orient | None, before: Floats | None) -> bool:
    """Whether the asset is turned otherwise, or cannot be, with another label of a hull; before: its frame now."""
    if orient is None:
        return False

    def compare() -> bool:
        labels = [to if place == row else hull.label for place, hull in enumerate(mesh.hulls)]
        after = _frame_of(mesh, orient, labels)
        if before is None or after is None:
            return before is not after
        cosine = (float(np.trace(before.T @ after)) - 1) / 2
        return bool(cosine < _SAME_FRAME)

    return memoize(mesh, ("turns", orient, row, to), bool, compare)


def _frame_of(mesh: SymbolicMesh, orient: Orient, labels: Sequence[str | None] | None = None) -> Floats | None:
    try:
        return find_rotation(mesh, orient, labels)
    except MeshForgeError:
        return None


def select_by(run: ProgramRun, rule: int, extractor: Extractor, delta: float) -> int | None:
    """Return what another extractor of a rule selects on an asset, None where the rule is not reached."""
    return select_mask(extractor, run.meshes[rule - 1], delta) if rule <= len(run.meshes) else None


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

    def discount(self, some: Bools, share: float) -> "RuleCandidates":
        """Return the same where some readings (k,) are wrong with that probability besides."""
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
    """Return the readings of each rule over a family; a rule without any is what it says."""
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
    """Return the questions about a rule on some of the assets, given by their places."""
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
