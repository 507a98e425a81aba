"""A family under a program: what speaks for each edit, and against it."""

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import exp, log, prod

import numpy as np

from meshforge.geometry import Floats
from meshforge.label_model import FamilyPosterior
from meshforge.language import EXTREMITY, Program
from meshforge.signoff.assessment import AssetEvidence, ReviewState, read_calibration
from meshforge.signoff.likely_mistakes import RuleMistake, find_mistakes
from meshforge.signoff.program_run import (
    AlternativeLabel,
    ProgramRun,
    RuleCandidates,
    compare_candidates,
    find_alternatives,
    run_on_asset,
    select_by,
)
from meshforge.symbolic import mask_of
from meshforge.synthesis import CandidateProgram, Step

ALIKE = 14.0
"""The distance of descriptions up to which hulls look alike."""
_WRONG_BY_CHANCE, _MOST_EXPECTED = 0.27, 0.995
"""The share of a program's right results that are called wrong where it is wrong nearly everywhere, and the most that
a result can be expected to be right."""
_WRONG_BY_RIGHT, _WRONG_BY_CORRECTED = 0.08, 0.24
"""Of labels that follow from results that are as meant, and from corrected ones, so many are wrong (measured)."""
_OUTLIER_FROM = 1.5  # what is so much farther than usual, as a logarithm, is unlike the rest


@dataclass(frozen=True, eq=False)
class FamilyRun:
    """A program on a family. mistakes: what was probably not meant to be shown; alarms: sentences by asset."""

    state: ReviewState
    program: Program
    posterior: FamilyPosterior
    runs: tuple[ProgramRun, ...]
    candidates: tuple[RuleCandidates, ...]
    mistakes: tuple[RuleMistake, ...]
    alarms: Mapping[str, Sequence[str]]

    @staticmethod
    def of(
        state: ReviewState,
        program: Program,
        candidates: Sequence[CandidateProgram],
        posterior: FamilyPosterior,
        alarms: Mapping[str, Sequence[str]],
    ) -> "FamilyRun":
        """Try a program on a family; what people said of results speaks for labels, too."""
        runs = [run_on_asset(name, mesh, program, state.templates) for name, mesh in state.meshes.items()]
        compared, mistakes = compare_candidates(program, candidates, runs), tuple(find_mistakes(state, program, runs))
        found = FamilyRun(state, program, posterior, tuple(runs), compared, mistakes, alarms)._with_alternatives(
            posterior
        )
        evidence = _weigh_labels(state, found.runs, posterior)
        found = found if evidence is None else found._with_alternatives(posterior.weigh(evidence))
        return replace(found, candidates=found._weigh_candidates())

    def _weigh_candidates(self) -> tuple[RuleCandidates, ...]:
        """The readings by what rules did on results that were called wrong: where the other rules and the labels there
        are probably right, a reading that does the same is probably not meant."""
        found = list(self.candidates)
        for asset, failed in self.state.failed.items():
            place = self.places.get(asset)
            if place is None or asset in self.state.meant or self.runs[place].selected != failed:
                continue
            agreements = [one.agreement[place] for one in self.candidates]
            for k, one in enumerate(self.candidates):
                others = prod([*agreements[:k], *agreements[k + 1 :], self.labels_right(place)])
                found[k] = found[k].discount(one.kinds[:, place] == 0, min(others, _MOST_EXPECTED))
        return tuple(found)

    def _with_alternatives(self, posterior: FamilyPosterior) -> "FamilyRun":
        """The same with the probabilities of labels, and what other labels would change."""
        posterior, labels = posterior.discount_rebuilt(), posterior.seen.labels
        rows = enumerate(zip(self.runs, self.state.meshes.values(), strict=True))
        runs = tuple(
            replace(run, alternatives=find_alternatives(run, mesh, self.program, labels, posterior.chances_of(place)))
            for place, (run, mesh) in rows
        )
        return replace(self, posterior=posterior, runs=runs)

    @cached_property
    def evidence(self) -> tuple[AssetEvidence, ...]:
        """What speaks for the edit of each asset."""
        trust = self.trust_in_program()
        return tuple(replace(one, program=trust) for one in self._edits)

    @cached_property
    def _edits(self) -> tuple[AssetEvidence, ...]:
        """The same under a program that is not wrong everywhere."""
        agreement = np.ones(len(self.runs))
        for one in self.candidates:
            agreement = agreement * one.agreement
        for found in self.mistakes:
            agreement = agreement * (1 - found.mistake.share * found.differs)
        return tuple(
            AssetEvidence(
                float(agreement[place]),
                self.labels_right(place),
                float(run.asset in self.unseen_labels),
                float(self._unlikeness[place]),
                float(len(self.alarms.get(run.asset, ()))),
            )
            for place, run in enumerate(self.runs)
        )

    def labels_right(self, place: int, known_hulls: Collection[str] = ()) -> float:
        """Return the probability that no other labels would change the edit of an asset: hulls that look alike err
        together, so of each such cluster the most doubtful one counts.

        told: names of hulls whose labels are known.
        """
        worst = defaultdict[int, float](float)
        for hull, share in alternative_shares(self.runs[place].alternatives).items():
            if hull not in known_hulls:
                cluster = self._clusters[place][hull]
                worst[cluster] = max(worst[cluster], share)
        return prod(1 - share for share in worst.values())

    @cached_property
    def _clusters(self) -> Sequence[Mapping[str, int]]:
        """For each asset the cluster of look-alikes of each hull whose label matters."""
        return [
            dict(zip(hulls, cluster(self.rows_of(place, hulls)), strict=True))
            for place, run in enumerate(self.runs)
            for hulls in [list(alternative_shares(run.alternatives))]
        ]

    def rows_of(self, place: int, hulls: Iterable[str]) -> Floats:
        """Return what describes some hulls of an asset (hulls, columns), so that distances are sums of differences."""
        table = self.posterior.table
        index, start = self.state.meshes[self.runs[place].asset].index, table.spans.get(place, slice(0, 0)).start
        return table.rows[[start + index[hull] for hull in hulls]] * table.metric

    def trust_in_program(self, looks: int = 0) -> float:
        """Return the probability that the program is not wrong nearly everywhere, by Bayes: each result that is as a
        person accepted or meant it speaks for it, each that is not against it, the more the less that was expected.

        looks: more results that are found right.
        """
        right, wrong = self.results
        against = sum(log((1 - _WRONG_BY_CHANCE * q) / (1 - q)) for q in map(self._expect, wrong))
        known = read_calibration()
        return 1 / (1 + exp(-(known.program + known.result * (len(right) + looks) - against)))

    @cached_property
    def results(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """The assets on which the program does what a person accepted or meant, and those on which it does not."""
        state, done = self.state, {run.asset: run.selected for run in self.runs}
        right = [name for name, meant in state.meant.items() if done.get(name) == meant]
        wrong = [name for name, meant in state.meant.items() if name in done and done[name] != meant]
        wrong += [name for name, failed in state.failed.items() if name not in state.meant and done.get(name) == failed]
        return tuple(right), tuple(dict.fromkeys([*wrong, *self.contradicted]))

    def _expect(self, asset: str) -> float:
        """How probable it was that the result of an asset is right, under a program that is not wrong everywhere."""
        return min(_MOST_EXPECTED, self._edits[self.places[asset]].probability)

    @cached_property
    def contradicted(self) -> frozenset[str]:
        """The demonstrated assets on which the program, written by hand, does something else than was shown, to other
        hulls or by a rule that nobody showed, and nobody said of the result whether that is meant."""
        found = set()
        seen = self.state.accepted | self.state.corrected
        count = max((len(demo.steps) for demo in self.state.demos.values()), default=0)
        for name, demo in ((name, demo) for name, demo in self.state.demos.items() if name not in seen):
            done = self.runs[self.places[name]].selected if name in self.places else ()
            shown = [step for step in demo.steps if step.select is not None]
            selects = all(step.rule <= len(done) and done[step.rule - 1] == step.select for step in shown)
            if not selects or (self.state.by_hand and (any(done[count:]) or not all(map(self._does, shown)))):
                found.add(name)
        return frozenset(found)

    def _does(self, step: Step) -> bool:
        rule = self.program.rules[step.rule - 1]
        return not step.select or (rule.action, rule.label) == (step.action, step.label)

    @cached_property
    def places(self) -> Mapping[str, int]:
        """The place of each asset."""
        return {run.asset: place for place, run in enumerate(self.runs)}

    @cached_property
    def unseen_labels(self) -> frozenset[str]:
        """The assets with labels that no demonstrated one has; none under a program that was learned from nothing."""
        meshes = self.state.meshes
        if not self.state.demos:
            return frozenset()
        known = {hull.label for name in self.state.demos for hull in meshes[name].hulls}
        return frozenset(name for name, mesh in meshes.items() if any(h.label not in known for h in mesh.hulls))

    @cached_property
    def _unlikeness(self) -> Floats:
        """How much farther than usual the strangest hull of each asset is from all hulls of other assets of which
        something is said, as a logarithm, above what may be (assets,)."""
        table, seen = self.posterior.table, self.posterior.seen
        _, apart = table.find_lookalikes(seen).nearest(seen.known, 1, 1)
        nearest = apart[:, 0]
        usual = float(np.median(nearest[np.isfinite(nearest)])) if np.isfinite(nearest).any() else 1.0
        found = np.zeros(len(self.runs))
        for place, span in table.spans.items():
            worst = float(nearest[span].max(initial=0.0))
            found[place] = max(0.0, np.log(worst / max(usual, 1e-9)) - _OUTLIER_FROM) if 0 < worst < np.inf else 0.0
        return found

    def select(self, known: RuleCandidates, candidate: int, place: int) -> int:
        """Return what a reading of a rule selects on an asset, as a bit set; nothing where it is not reached."""
        delta = EXTREMITY if self.program.extremity is None else self.program.extremity
        return select_by(self.runs[place], known.rule, known.extractors[candidate], delta) or 0


def cluster(rows: Floats) -> list[int]:
    """Return the clusters of some hulls: each belongs to the first one that it looks like."""
    heads, found = list[int](), list[int]()
    for place, row in enumerate(rows):
        alike = (k for k, head in enumerate(heads) if np.abs(rows[head] - row).sum() <= ALIKE)
        found.append(next(alike, len(heads)))
        if found[-1] == len(heads):
            heads.append(place)
    return found


def alternative_shares(alternatives: Sequence[AlternativeLabel]) -> dict[str, float]:
    """Return how probable it is for each hull that it has a label which changes the edit."""
    found = defaultdict[str, float](float)
    for alternative in alternatives:
        found[alternative.hull] += alternative.chance
    return {hull: min(share, 1.0) for hull, share in found.items()}


def _weigh_labels(state: ReviewState, runs: Sequence[ProgramRun], posterior: FamilyPosterior) -> Floats | None:
    """The evidence (hulls of all meshes, labels) [nats] of results on labels, None where there is none (abduction, as
    in repair): where a result is as it was meant, labels that would change it are less probable; where it is not, those
    that would make it so are more.

    trials: of all assets, with their flips; posterior: by all other evidence.
    """
    codes = {label: code for code, label in enumerate(posterior.seen.labels)}
    found, called = np.zeros(posterior.chances.shape), False
    for place, run in enumerate(runs):
        if run.asset not in state.meant or run.error:
            continue
        start, index = posterior.table.spans[place].start, state.meshes[run.asset].index
        for alternative, nats in _weigh_alternatives(state, run):
            found[start + index[alternative.hull], codes[alternative.to]] += nats
            called = True
    return found if called else None


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
