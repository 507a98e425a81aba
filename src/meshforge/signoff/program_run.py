"""A program tried on one asset: what its rules select there, and what would change that: other readings of the rules,
and other labels of the hulls. And what results that people judged say about labels (abduction, as in repair): where a
result is as it was meant, labels that would change it are less probable; where it is not, those that would make it so
are more."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import log

import numpy as np

from meshforge.common import MeshForgeError
from meshforge.geometry import Floats
from meshforge.label_model import FamilyPosterior
from meshforge.language import EXTREMITY, Extractor, Orient, Program, Template, find_rotation, labels_of, select_mask
from meshforge.signoff.assessment import ReviewState
from meshforge.symbolic import SymbolicMesh, mask_of
from meshforge.synthesis import memoize

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
        """The hulls of a bit set, as a rule meets them; rule: its number."""
        return tuple(self.meshes[rule - 1].names_of(mask))

    @property
    def selected(self) -> tuple[frozenset[str], ...]:
        """What each rule selects, names of hulls; of the rules that were reached."""
        return tuple(frozenset(self.names(rule, mask)) for rule, mask in enumerate(self.selections, 1))


def run_on_asset(asset: str, mesh: SymbolicMesh, program: Program, templates: Mapping[str, Template]) -> ProgramRun:
    """The program on an asset."""
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
    """The other labels of hulls with which a rule would select otherwise, or the asset be turned otherwise.

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
                other = select_mask(rule.extractor, met, delta, [*names[:at], to, *names[at + 1 :]])
                if other != run.selections[number - 1]:
                    others[number] = other
            if others:
                chance = float(chances[row, place])
                found.append(AlternativeLabel(hull.name, hull.label, to, chance, tuple(others), tuple(others.values())))
    return tuple(found)


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
    """What another extractor of a rule selects on an asset, None where the rule is not reached."""
    return select_mask(extractor, run.meshes[rule - 1], delta) if rule <= len(run.meshes) else None


_WRONG_BY_RIGHT, _WRONG_BY_CORRECTED = 0.08, 0.24
"""Of labels that follow from results that are as meant, and from corrected ones, so many are wrong (measured)."""


def weigh_labels(state: ReviewState, runs: Sequence[ProgramRun], posterior: FamilyPosterior) -> Floats | None:
    """The evidence (hulls of all meshes, labels) [nats] of results on labels, None where there is none.

    trials: of all assets, with their flips; posterior: by all other evidence.
    """
    codes = {label: code for code, label in enumerate(posterior.seen.labels)}
    found, is_known = np.zeros(posterior.chances.shape), False
    for place, run in enumerate(runs):
        if run.asset not in state.meant or run.error:
            continue
        start, index = posterior.table.spans[place].start, state.meshes[run.asset].index
        for alternative, nats in _weigh_alternatives(state, run):
            found[start + index[alternative.hull], codes[alternative.to]] += nats
            is_known = True
    return found if is_known else None


def _weigh_alternatives(state: ReviewState, run: ProgramRun) -> Iterator[tuple[AlternativeLabel, float]]:
    """How much more probable each other label is by what rules are to select on an asset."""
    meant = [
        mask_of(mesh.index[hull] for hull in select if hull in mesh.index)
        for mesh, select in zip(run.meshes, state.meant[run.asset], strict=False)
    ]
    for alternative in run.alternatives:
        pairs = [
            (meant[rule - 1], now)
            for rule, now in zip(alternative.rules, alternative.selections, strict=True)
            if rule > 0
        ]
        before = sum((run.selections[rule - 1] ^ meant[rule - 1]).bit_count() for rule in alternative.rules if rule > 0)
        after = sum((wanted ^ now).bit_count() for wanted, now in pairs)
        if after < before:
            yield alternative, log((1 - _WRONG_BY_CORRECTED) / _WRONG_BY_CORRECTED)
        elif after > before:
            yield alternative, -log((1 - _WRONG_BY_RIGHT) / _WRONG_BY_RIGHT)
