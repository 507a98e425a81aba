"""Why the edit of an asset may be wrong, in sentences, and how probable it is that it is right."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from math import prod

import numpy as np

from meshforge.language import show
from meshforge.signoff.assessment import MOST_DOUBTS, AssetConfidence, Doubt, DoubtKind, ReviewState
from meshforge.signoff.confidence import NO_EDIT
from meshforge.signoff.family import FamilyTrial
from meshforge.signoff.trial import RULE_OF_FRAME, Flip, Trial
from meshforge.synthesis import LearningOutcome, NeedsRepair

CALLED_WRONG = "a person said that this result is wrong"
CALLED_WRONG_BEFORE = "a person said that a result here was wrong, and nobody has looked at it since"
EDITED_SINCE = "it was edited by hand, and nobody has accepted that"
CONTRADICTED = "the program does something else than was shown here"
SURE_OF_DEMONSTRATED = 0.999
SUGGESTION_RIGHT = 0.5
"""How often an orientation that is suggested, and not refused, is right."""
_NOT_MEANT = 0.5  # the probability that not all new hulls are meant where a demonstration named the one before
_WORTH_TELLING = 0.01  # the probability that an edit is wrong for one reason, from which on it is told
_MOST_MISTRUST = 0.03  # in a program, above which it is told


def judge_edits(
    state: ReviewState, outcome: LearningOutcome | None, family: FamilyTrial | None, turned: Collection[str]
) -> Iterator[tuple[str, AssetConfidence]]:
    """Give how sure the edit of each asset is, with its doubts; turned: assets that may have to be turned first."""
    rows = [(asset, text) for asset, texts in state.unconfirmed.items() for text in texts]
    for place, name in enumerate((*state.meshes, *state.lost)):
        if why := state.lost.get(name):
            one = AssetConfidence(name, 0.0, (Doubt("alarm", f"it cannot be read: {why}", share=1.0),))
        else:
            one = judge_edit(family, place) if family else AssetConfidence(name, 0.0, (doubt_learning(outcome),))
        if name in turned:
            text = "it may have to be turned first, and would be edited otherwise then"
            one = one.with_doubts([Doubt("orientation", text, share=SUGGESTION_RIGHT)])
        if rows and name not in state.accepted | state.corrected:
            texts = (text if asset == name else f"{asset}: {text}" for asset, text in rows)
            one = one.with_doubts(Doubt("reading", text, share=_NOT_MEANT) for text in texts)
        yield name, one


def doubt_learning(outcome: LearningOutcome | None) -> Doubt:
    """Return why no edit is sure where no program was learned."""
    if outcome is None:
        return Doubt("reading", "nothing is demonstrated yet", share=1.0)
    if isinstance(outcome, NeedsRepair):
        return Doubt("label", "labels of demonstrated assets are probably wrong", share=1.0)
    return Doubt("reading", getattr(outcome, "why", "no program was found"), share=1.0)


def judge_edit(family: FamilyTrial, place: int) -> AssetConfidence:
    """Return how sure the edit of the asset at a place is, with its doubts."""
    trial, state = family.trials[place], family.state
    asset = trial.asset
    if trial.error and asset not in state.accepted:
        kind: DoubtKind = "label" if trial.meshes else "orientation"
        return _refuse(asset, Doubt(kind, f"the program cannot run: {trial.error}", (), len(trial.meshes) or None, 1.0))
    if asset in family.contradicted:
        return _refuse(asset, Doubt("reading", CONTRADICTED, share=1.0))
    if asset in state.wrong and trial.selected == state.failed.get(asset):
        return _refuse(asset, Doubt("reading", EDITED_SINCE if asset in state.edited else CALLED_WRONG, share=1.0))
    if asset in state.reviewed_assets:
        return AssetConfidence(asset, SURE_OF_DEMONSTRATED)
    doubts = [*_doubt_readings(family, place), *_doubt_labels(trial), *_doubt_outliers(family, place)]
    weightiest = sorted([*doubts, *_doubt_program(family)], key=lambda one: -one.share)[:MOST_DOUBTS]
    if asset in state.wrong:  # it needs review for this, however probable it is now
        weightiest = [Doubt("reading", CALLED_WRONG_BEFORE), *weightiest[: MOST_DOUBTS - 1]]
    return AssetConfidence(asset, family.evidence[place].probability, tuple(weightiest))


def _refuse(asset: str, why: Doubt) -> AssetConfidence:
    return AssetConfidence(asset, NO_EDIT, (why,))


def _doubt_program(family: FamilyTrial) -> Iterator[Doubt]:
    share = 1 - family.trust_in_program()
    right, wrong = map(len, family.results)
    if wrong and share > _MOST_MISTRUST:
        text = f"{wrong} of the {right + wrong} results that were looked at are wrong"
        yield Doubt("reading", text, share=share)


def _doubt_readings(family: FamilyTrial, place: int) -> Iterator[Doubt]:
    trial = family.trials[place]
    for known in family.readings:
        other, share = np.flatnonzero(known.kinds[:, place]), float(1 - known.agreement[place])
        if not len(other) or share < _WORTH_TELLING:
            continue
        best = int(other[np.argmax(known.beliefs[other])])
        ours, theirs = trial.selections[known.rule - 1], family.select(known, best, place)
        change = _describe_change(trial, known.rule, ours, theirs)
        text = f"rule {known.rule} may mean {show(known.extractors[best])}, which {change}"
        yield Doubt("reading", text, trial.names(known.rule, ours ^ theirs), known.rule, share)
    for slip in (one for one in family.slips if one.differs[place]):
        text = f"rule {slip.rule} may mean {show(slip.slip.extractor)}, if there was a slip on {slip.slip.asset}"
        yield Doubt("reading", text, (), slip.rule, slip.slip.share)


def _doubt_labels(trial: Trial) -> Iterator[Doubt]:
    grouped = defaultdict[tuple[str | None, str, tuple[int, ...]], list[Flip]](list)
    for flip in trial.flips:
        grouped[flip.was, flip.to, flip.rules].append(flip)
    for (was, to, (rule, *_)), flips in grouped.items():
        share = 1 - prod(1 - flip.chance for flip in flips)
        if share < _WORTH_TELLING:
            continue
        names = tuple(flip.hull for flip in flips)
        called = f"called {was}" if was else "without a label"
        is_turned = rule == RULE_OF_FRAME
        what = "the asset would be turned otherwise" if is_turned else f"rule {rule} would select otherwise"
        text = f"{_join(names)} {'is' if len(names) == 1 else 'are'} {called}, and may be {to} ({share:.0%}): {what}"
        yield Doubt("orientation" if is_turned else "label", text, names, rule or None, share)


def _doubt_outliers(family: FamilyTrial, place: int) -> Iterator[Doubt]:
    evidence = family.evidence[place]
    share = replace(evidence, unlike=0.0, alarms=0.0).probability - evidence.probability
    yield from (Doubt("alarm", text, share=share) for text in family.alarms.get(family.trials[place].asset, ()))
    if evidence.unlike > 0 and share >= _WORTH_TELLING:
        yield Doubt("unlike", "unlike the rest: no other asset has such hulls", share=share)


def _describe_change(trial: Trial, rule: int, ours: int, theirs: int) -> str:
    more, less = trial.names(rule, theirs & ~ours), trial.names(rule, ours & ~theirs)
    parts = [f"would select {_join(more)} too"] if more else []
    parts += [f"would leave {_join(less)} out"] if less else []
    return " and ".join(parts)


def _join(names: Sequence[str], most: int = 3) -> str:
    shown = ", ".join(names[:most])
    return f"{shown} and {len(names) - most} more" if len(names) > most else shown
