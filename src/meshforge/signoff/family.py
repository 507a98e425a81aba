"""A family under a program: what speaks for each edit, and against it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import exp, log, prod

import numpy as np

from meshforge.geometry import Floats
from meshforge.label_model import FamilyPosterior
from meshforge.language import EXTREMITY, Program, show
from meshforge.signoff.assessment import (
    CALLED_WRONG,
    CALLED_WRONG_BEFORE,
    CONTRADICTED,
    EDITED_SINCE,
    MOST_REASONS,
    AssetConfidence,
    Reason,
    ReasonKind,
    ReviewState,
)
from meshforge.signoff.candidates import RuleCandidates, compare_candidates
from meshforge.signoff.confidence import NO_EDIT, AssetEvidence, read_calibration
from meshforge.signoff.likely_mistakes import RuleMistake, find_mistakes
from meshforge.signoff.program_run import (
    RULE_OF_FRAME,
    AlternativeLabel,
    ProgramRun,
    find_alternatives,
    run_on_asset,
    select_by,
    weigh_labels,
)
from meshforge.synthesis import CandidateProgram

SURE_OF_DEMONSTRATED = 0.999
ALIKE = 14.0
"""The distance of descriptions up to which hulls look alike."""
_WORTH_TELLING = 0.01  # the probability that an edit is wrong for one reason, from which on it is told
_WRONG_BY_CHANCE, _MOST_EXPECTED = 0.27, 0.995
"""The share of a program's right results that are called wrong where it is wrong nearly everywhere, and the most that
a result can be expected to be right."""
_MOST_MISTRUST = 0.03  # in a program, above which it is told
_OUTLIER_FROM = 1.5  # what is so much farther than usual, as a logarithm, is unlike the rest


@dataclass(frozen=True, eq=False)
class FamilyRun:
    """A program on all assets of a family. mistakes: what a person probably did not mean to show; alarms: sentences by
    asset."""

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
    ) -> FamilyRun:
        """Try a program on a family; what people said of results speaks for labels, too."""
        runs = [run_on_asset(name, mesh, program, state.templates) for name, mesh in state.meshes.items()]
        compared, mistakes = compare_candidates(program, candidates, runs), tuple(find_mistakes(state, program, runs))
        found = FamilyRun(state, program, posterior, tuple(runs), compared, mistakes, alarms)._with_alternatives(
            posterior
        )
        evidence = weigh_labels(state, found.runs, posterior)
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

    def _with_alternatives(self, posterior: FamilyPosterior) -> FamilyRun:
        """The same with the probabilities of labels, and what other labels would change."""
        posterior, labels = posterior.doubt_rebuilt(), posterior.seen.labels
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
        """The probability that no other labels would change the edit of an asset: hulls that look alike err together,
        so of each such cluster the most doubtful one counts.

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
        """What describes some hulls of an asset (hulls, columns), so that distances are sums of differences."""
        table = self.posterior.table
        index, start = self.state.meshes[self.runs[place].asset].index, table.spans.get(place, slice(0, 0)).start
        return table.rows[[start + index[hull] for hull in hulls]] * table.metric

    def trust_in_program(self, looks: int = 0) -> float:
        """The probability that the program is not wrong nearly everywhere, by Bayes: each result that is as a person
        accepted or meant it speaks for it, each that is not against it, the more the less that was expected.

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
        """The demonstrated assets on which the program, written by hand, does something else than was shown, and
        nobody said of the result whether that is meant."""
        found = set()
        seen = self.state.accepted | self.state.corrected
        for name, demo in ((name, demo) for name, demo in self.state.demos.items() if name not in seen):
            done = self.runs[self.places[name]].selected if name in self.places else ()
            shown = {step.rule: step.select for step in demo.steps if step.select is not None}
            if any(rule > len(done) or done[rule - 1] != select for rule, select in shown.items()):
                found.add(name)
        return frozenset(found)

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

    def confidence_of(self, place: int) -> AssetConfidence:
        """One asset, with its reasons."""
        run, evidence, state = self.runs[place], self.evidence[place], self.state
        if run.error and run.asset not in state.accepted:
            return AssetConfidence(run.asset, NO_EDIT, (self._reason_of_error(place),))
        if run.asset in self.contradicted:
            return AssetConfidence(run.asset, NO_EDIT, (Reason("candidate", CONTRADICTED, share=1.0),))
        if run.asset in state.wrong and run.selected == state.failed.get(run.asset):
            why = EDITED_SINCE if run.asset in state.edited else CALLED_WRONG
            return AssetConfidence(run.asset, NO_EDIT, (Reason("candidate", why, share=1.0),))
        if run.asset in state.reviewed_assets:
            return AssetConfidence(run.asset, SURE_OF_DEMONSTRATED)
        reasons = [*self._candidate_reasons(place), *self._label_reasons(place), *self._outlier_reasons(place)]
        reasons += self._program_reasons
        weightiest = sorted(reasons, key=lambda one: -one.share)[:MOST_REASONS]
        if run.asset in state.wrong:  # it needs review for this, however probable it is now
            weightiest = [Reason("candidate", CALLED_WRONG_BEFORE), *weightiest[: MOST_REASONS - 1]]
        return AssetConfidence(run.asset, evidence.probability, tuple(weightiest))

    def _reason_of_error(self, place: int) -> Reason:
        run = self.runs[place]
        return Reason(
            "label" if run.meshes else "orientation",
            f"the program cannot run: {run.error}",
            (),
            len(run.meshes) or None,
            1.0,
        )

    @cached_property
    def _program_reasons(self) -> tuple[Reason, ...]:
        """Whether too many of the results that were looked at were wrong."""
        share = 1 - self.trust_in_program()
        right, wrong = map(len, self.results)
        text = f"{wrong} of the {right + wrong} results that were looked at are wrong"
        return (Reason("candidate", text, share=share),) if wrong and share > _MOST_MISTRUST else ()

    def _candidate_reasons(self, place: int) -> list[Reason]:
        found, run = [], self.runs[place]
        for known in self.candidates:
            other = np.flatnonzero(known.kinds[:, place])
            if not len(other) or 1 - known.agreement[place] < _WORTH_TELLING:
                continue
            best = int(other[np.argmax(known.beliefs[other])])
            ours, theirs = run.selections[known.rule - 1], self.select(known, best, place)
            change = _describe_change(run, known.rule, ours, theirs)
            text = f"rule {known.rule} may mean {show(known.extractors[best])}, which {change}"
            hulls = run.names(known.rule, ours ^ theirs)
            found.append(Reason("candidate", text, hulls, known.rule, float(1 - known.agreement[place])))
        for mistake in (one for one in self.mistakes if one.differs[place]):
            likely = mistake.mistake
            text = f"rule {mistake.rule} may mean {show(likely.extractor)}, if {likely.asset} was shown by mistake"
            found.append(Reason("candidate", text, (), mistake.rule, likely.share))
        return found

    def select(self, known: RuleCandidates, candidate: int, place: int) -> int:
        """What a reading of a rule selects on the asset at a place, as a bit set; nothing where it is not reached."""
        delta = EXTREMITY if self.program.extremity is None else self.program.extremity
        return select_by(self.runs[place], known.rule, known.extractors[candidate], delta) or 0

    def _label_reasons(self, place: int) -> list[Reason]:
        grouped = defaultdict[tuple[str | None, str, tuple[int, ...]], list[AlternativeLabel]](list)
        for alternative in self.runs[place].alternatives:
            grouped[alternative.was, alternative.to, alternative.rules].append(alternative)
        found = []
        for (was, to, rules), alternatives in grouped.items():
            share = 1 - prod(1 - alternative.chance for alternative in alternatives)
            if share < _WORTH_TELLING:
                continue
            names = tuple(alternative.hull for alternative in alternatives)
            called = f"called {was}" if was else "without a label"
            turned = rules[0] == RULE_OF_FRAME
            what = "the asset would be turned otherwise" if turned else f"rule {rules[0]} would select otherwise"
            text = (
                f"{_join(names)} {'is' if len(names) == 1 else 'are'} {called}, and may be {to} ({share:.0%}): {what}"
            )
            kind: ReasonKind = "orientation" if rules[0] == RULE_OF_FRAME else "label"
            found.append(Reason(kind, text, names, rules[0] or None, share))
        return found

    def _outlier_reasons(self, place: int) -> list[Reason]:
        run, evidence = self.runs[place], self.evidence[place]
        plain = replace(evidence, outlier_score=0.0, alarms=0.0).probability
        share = plain - evidence.probability
        found = [Reason("alarm", text, share=share) for text in self.alarms.get(run.asset, ())]
        if evidence.outlier_score > 0 and share >= _WORTH_TELLING:
            found.append(Reason("outlier", "unlike the rest: no other asset has such hulls", share=share))
        return found


def cluster(rows: Floats) -> list[int]:
    """The clusters of some hulls: each belongs to the first one that it looks like."""
    heads, found = list[int](), list[int]()
    for place, row in enumerate(rows):
        alike = (k for k, head in enumerate(heads) if np.abs(rows[head] - row).sum() <= ALIKE)
        found.append(next(alike, len(heads)))
        if found[-1] == len(heads):
            heads.append(place)
    return found


def alternative_shares(alternatives: Sequence[AlternativeLabel]) -> dict[str, float]:
    """How probable it is for each hull that it has a label which changes the edit."""
    found = defaultdict[str, float](float)
    for alternative in alternatives:
        found[alternative.hull] += alternative.chance
    return {hull: min(share, 1.0) for hull, share in found.items()}


def _describe_change(run: ProgramRun, rule: int, ours: int, theirs: int) -> str:
    more, less = run.names(rule, theirs & ~ours), run.names(rule, ours & ~theirs)
    parts = [f"would select {_join(more)} too"] if more else []
    parts += [f"would leave {_join(less)} out"] if less else []
    return " and ".join(parts)


def _join(names: Sequence[str], most: int = 3) -> str:
    shown = ", ".join(names[:most])
    return f"{shown} and {len(names) - most} more" if len(names) > most else shown
