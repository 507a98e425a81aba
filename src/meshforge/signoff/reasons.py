"""Why the edit of an asset may be wrong, in sentences, and how probable it is that it is right."""

from collections import defaultdict
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from math import prod

import numpy as np

from meshforge.language import show
from meshforge.signoff.assessment import MOST_REASONS, NO_EDIT, Reason, ReasonKind, ResultStatus, ReviewState
from meshforge.signoff.family import FamilyRun
from meshforge.signoff.program_run import RULE_OF_FRAME, AlternativeLabel, ProgramRun
from meshforge.symbolic import is_class_name
from meshforge.synthesis import LearningOutcome, NeedsRepair

CALLED_WRONG = "a person said that this result is wrong"
CALLED_WRONG_BEFORE = "a person said that a result here was wrong, and nobody has looked at it since"
EDITED_SINCE = "it was edited by hand, and nobody has accepted that"
CHANGED = "it is not the result that a person accepted"
CONTRADICTED = "the program does something else than was shown here"
SURE_OF_DEMONSTRATED = 0.999
SUGGESTION_RIGHT = 0.5
"""How often an orientation that is suggested, and not refused, is right."""
_NOT_MEANT = 0.5  # the probability that not all new hulls are meant where a demonstration named the one before
_WORTH_TELLING = 0.01  # the probability that an edit is wrong for one reason, from which on it is told
_MOST_MISTRUST = 0.03  # in a program, above which it is told


def judge_edits(
    state: ReviewState, outcome: LearningOutcome | None, family: FamilyRun | None, turned: Collection[str]
) -> Iterator[tuple[str, ResultStatus]]:
    """Give how sure the edit of each asset is, with its doubts; turned: assets that may have to be turned first."""
    rows = [(asset, text) for asset, texts in state.unconfirmed.items() for text in texts]
    for place, name in enumerate((*state.meshes, *state.lost)):
        if why := state.lost.get(name):
            one = ResultStatus(0.0, (Reason("alarm", f"it cannot be read: {why}", share=1.0),))
        else:
            one = judge_edit(family, place) if family else ResultStatus(0.0, (judge_learning(outcome),))
        if name in turned:
            text = "it may have to be turned first, and would be edited otherwise then"
            one = one.with_reasons([Reason("orientation", text, share=SUGGESTION_RIGHT)])
        if rows and name not in state.accepted | state.corrected:
            texts = (text if asset == name else f"{asset}: {text}" for asset, text in rows)
            one = one.with_reasons(Reason("candidate", text, share=_NOT_MEANT) for text in texts)
        if name in state.changed:
            one = one.with_reasons([Reason("candidate", CHANGED, share=_NOT_MEANT)])
        yield name, one


def judge_learning(outcome: LearningOutcome | None) -> Reason:
    """Return why no edit is sure where no program was learned."""
    if outcome is None:
        return Reason("candidate", "nothing is demonstrated yet", share=1.0)
    if isinstance(outcome, NeedsRepair):
        return Reason("label", "labels of demonstrated assets are probably wrong", share=1.0)
    return Reason("candidate", getattr(outcome, "why", "no program was found"), share=1.0)


def judge_edit(family: FamilyRun, place: int) -> ResultStatus:
    """Return how sure the edit of the asset at a place is, with its doubts."""
    run, state = family.runs[place], family.state
    asset = run.asset
    if run.error and asset not in state.accepted:
        kind: ReasonKind = "label" if run.meshes else "orientation"
        return _refuse(Reason(kind, f"the program cannot run: {run.error}", (), len(run.meshes) or None, 1.0))
    if asset in family.contradicted:
        return _refuse(Reason("candidate", CONTRADICTED, share=1.0))
    if asset in state.wrong and run.selected == state.failed.get(asset):
        return _refuse(Reason("candidate", EDITED_SINCE if asset in state.edited else CALLED_WRONG, share=1.0))
    if asset in state.reviewed_assets:
        return ResultStatus(SURE_OF_DEMONSTRATED)
    reasons = [
        *_list_candidate_reasons(family, place),
        *_list_label_reasons(run),
        *_list_outlier_reasons(family, place),
    ]
    weightiest = sorted([*reasons, *_list_program_reasons(family)], key=lambda one: -one.share)[:MOST_REASONS]
    if asset in state.wrong:  # it needs review for this, however probable it is now
        weightiest = [Reason("candidate", CALLED_WRONG_BEFORE), *weightiest[: MOST_REASONS - 1]]
    return ResultStatus(family.evidence[place].probability, tuple(weightiest))


def _refuse(why: Reason) -> ResultStatus:
    return ResultStatus(NO_EDIT, (why,))


def _list_program_reasons(family: FamilyRun) -> Iterator[Reason]:
    share = 1 - family.trust_in_program()
    right, wrong = map(len, family.results)
    if wrong and share > _MOST_MISTRUST:
        text = f"{wrong} of the {right + wrong} results that were looked at are wrong"
        yield Reason("candidate", text, share=share)


def _list_candidate_reasons(family: FamilyRun, place: int) -> Iterator[Reason]:
    run = family.runs[place]
    for known in family.candidates:
        other, share = np.flatnonzero(known.kinds[:, place]), float(1 - known.agreement[place])
        if not len(other) or share < _WORTH_TELLING:
            continue
        best = int(other[np.argmax(known.beliefs[other])])
        ours, theirs = run.selections[known.rule - 1], family.select(known, best, place)
        change = _describe_change(run, known.rule, ours, theirs)
        text = f"rule {known.rule} may mean {show(known.extractors[best])}, which {change}"
        yield Reason("candidate", text, run.names(known.rule, ours ^ theirs), known.rule, share)
    for mistake in (one for one in family.mistakes if one.differs[place]):
        likely = mistake.mistake
        meant = show(likely.extractor)
        text = f"rule {mistake.rule} may mean {meant}, if hulls of {likely.asset} were shown by mistake"
        yield Reason("candidate", text, (), mistake.rule, likely.share)


def _list_label_reasons(run: ProgramRun) -> Iterator[Reason]:
    grouped = defaultdict[tuple[str | None, str, tuple[int, ...]], list[AlternativeLabel]](list)
    for alternative in run.alternatives:
        grouped[alternative.was, alternative.to, alternative.rules].append(alternative)
    for (was, to, (rule, *_)), alternatives in grouped.items():
        share = 1 - prod(1 - alternative.chance for alternative in alternatives)
        if share < _WORTH_TELLING:
            continue
        names = tuple(alternative.hull for alternative in alternatives)
        called = f"called {was}" if was else "taken by no step" if is_class_name(to) else "without a label"
        is_turned = rule == RULE_OF_FRAME
        what = "the asset would be turned otherwise" if is_turned else f"rule {rule} would select otherwise"
        text = f"{_join(names)} {'is' if len(names) == 1 else 'are'} {called}, and may be {to}: {what}"
        yield Reason("orientation" if is_turned else "label", text, names, rule or None, share)


def _list_outlier_reasons(family: FamilyRun, place: int) -> Iterator[Reason]:
    evidence = family.evidence[place]
    share = replace(evidence, outlier_score=0.0, alarms=0.0).probability - evidence.probability
    yield from (Reason("alarm", text, share=share) for text in family.alarms.get(family.runs[place].asset, ()))
    if evidence.outlier_score > 0 and share >= _WORTH_TELLING:
        yield Reason("outlier", "unlike the rest: no other asset has such hulls", share=share)


def _describe_change(run: ProgramRun, rule: int, ours: int, theirs: int) -> str:
    more, less = run.names(rule, theirs & ~ours), run.names(rule, ours & ~theirs)
    parts = [f"would select {_join(more)} too"] if more else []
    parts += [f"would leave {_join(less)} out"] if less else []
    return " and ".join(parts)


def _join(names: Sequence[str], most: int = 3) -> str:
    shown = ", ".join(names[:most])
    return f"{shown} and {len(names) - most} more" if len(names) > most else shown
