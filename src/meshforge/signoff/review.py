"""A family reviewed: the probability of each edit, and the question that makes most edits right for a second of a
person's time (the expected value of information, Howard 1966)."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from meshforge.common import join_names
from meshforge.geometry import Floats
from meshforge.label_model import FamilyModel, FamilyPosterior
from meshforge.language import show
from meshforge.signoff.assessment import THRESHOLD, Assessment, GoalStatus, ResultStatus, ReviewState
from meshforge.signoff.family import FamilyRun
from meshforge.signoff.groups import ask_clusters, ask_groups, ask_orientation
from meshforge.signoff.likely_mistakes import ask_about_kept_label, ask_about_mistake, ask_about_nearest, offer_label
from meshforge.signoff.program_run import CandidateSplit, ProgramRun, split_candidates
from meshforge.signoff.question import (
    CANDIDATE,
    EXCLUDE,
    RIGHT,
    WRONG,
    YES_OR_NO,
    HullPlace,
    QuestionKind,
    ReviewChoice,
    ReviewQuestion,
    identify,
    price_demonstration,
)
from meshforge.signoff.reasons import SUGGESTION_RIGHT, judge_edit, judge_edits, judge_learning
from meshforge.synthesis import (
    Ambiguous,
    Found,
    LearningOutcome,
    NeedsRepair,
    NoProgram,
    OrientationSuggestion,
    choose_first_demonstration,
)

_NO_ALARMS: Mapping[str, Sequence[str]] = MappingProxyType({})
_NO_GOALS: Mapping[str, Sequence[GoalStatus]] = MappingProxyType({})
_TRUST = 2  # the power of the probability that labels on an asset are right, with which what is said there counts
_LEAST_TRUST = 0.7  # below this nothing is asked there about readings
_LIKELY = 0.5  # a slip in what a person answered or accepted is asked about above this, unless a result is wrong
_GOAL_GAIN = 0.5  # what a look is worth at a result that a person accepted, and on which a goal fails
_MOST_SPLITS = 40  # assets on which readings are told apart, those where they differ most


def review_family(
    state: ReviewState,
    outcome: LearningOutcome | None,
    family: FamilyModel,
    threshold: float = THRESHOLD,
    alarms: Mapping[str, Sequence[str]] = _NO_ALARMS,
    goals: Mapping[str, Sequence[GoalStatus]] = _NO_GOALS,
) -> Assessment:
    """Return how the family stands.

    outcome: what was learned from all that the state holds, None before anything was shown; family: its meshes, in
    their order; alarms: sentences on results that stand out, by asset; goals: what is known of them, by asset.
    """
    run = _run_family(state, outcome, family, alarms) if isinstance(outcome, Found | Ambiguous) else None
    looked_at = _list_looked_at(state, run)
    suggested = outcome.suggested if outcome else None
    is_doubted = run and suggested and _sort(ask_orientation(suggested, state, 1.0), state)
    turned = {*suggested.differs_on} - looked_at if suggested and is_doubted else set()
    bare = dict(judge_edits(state, outcome, run, turned))
    assets = {name: one.with_goals(goals.get(name, ())) for name, one in bare.items()}
    found = Assessment(assets, threshold, looked_at, state.wrong, state.excluded, without_goals=bare)
    if run is None:  # what was demonstrated is not what any program does
        questions = _sort(_questions_before(state, outcome, family), state)
    elif (found.need_review or found.failures) and not state.lost.keys() >= {*found.need_review, *found.failures}:
        questions = _sort(_questions(run, found, suggested), state)
    else:
        looks = [*_ask_last_looks(run), *ask_clusters(run)]
        is_enough = any(one.id in state.snoozed for one in looks)  # who snoozes one wants no other
        questions = () if is_enough else _sort(looks, state)
    lost = (_ask_to_exclude(name, state.lost[name]) for name in found.need_review if name in state.lost)
    return replace(found, questions=(*questions, *(one for one in lost if one.id not in state.snoozed)))


def assess_asset(state: ReviewState, outcome: LearningOutcome | None, family: FamilyModel, asset: str) -> ResultStatus:
    """Return how probable the edit of one asset of a family is; the arguments are those of `review_family`."""
    if not isinstance(outcome, Found | Ambiguous):
        return ResultStatus(0.0, (judge_learning(outcome),))
    run = _run_family(state, outcome, family, _NO_ALARMS)
    return judge_edit(run, run.places[asset])


def _run_family(
    state: ReviewState, outcome: Found | Ambiguous, family: FamilyModel, alarms: Mapping[str, Sequence[str]]
) -> FamilyRun:
    return FamilyRun.of(state, outcome.program, outcome.candidates, _infer(state, family), alarms)


def _infer(state: ReviewState, family: FamilyModel) -> FamilyPosterior:
    annotations = [hull.annotation for mesh in state.meshes.values() for hull in mesh.hulls]
    return family.infer(annotations, state.frame.labels)


def _list_looked_at(state: ReviewState, run: FamilyRun | None) -> frozenset[str]:
    """The assets of which a person accepted the result as it is, or said what it is to be."""
    seen = state.accepted | state.corrected
    unconfirmed = {asset for asset, texts in state.unconfirmed.items() if texts} - seen
    if run is None:
        return seen - unconfirmed
    stopped = {one.asset for one in run.runs if one.error} - state.accepted
    return (seen | state.demos.keys()) - stopped - run.contradicted - state.wrong - unconfirmed


def _questions_before(
    state: ReviewState, outcome: LearningOutcome | None, family: FamilyModel
) -> Iterator[ReviewQuestion]:
    """What can be asked while there is no program; the first is to be asked before the others."""
    everyone = float(len(state.meshes))
    match outcome:
        case None:
            meshes = {name: state.meshes[name] for name in state.meshes if name not in state.excluded}
            frame = state.frame
            first = choose_first_demonstration(meshes, frame.labels, frame.orient, frame.contact, frame.extremity)
            if asset := first or next(iter(meshes), None):
                yield _ask_demonstration(state, asset, everyone, "Show the edit on {}.")
        case NeedsRepair():
            asked: list[ReviewQuestion] = list(_ask_repairs(state, outcome, everyone))
            kept = (ask_about_kept_label(state, repair, everyone) for repair in outcome.repairs)
            asked = asked or [mistake for mistake in kept if mistake and mistake.id not in state.snoozed]
            yield from asked
            if not asked:  # all was refused: what was shown there may be otherwise
                text = "Nothing fits what was shown on {} with the labels there: show it again, or correct a label."
                yield _ask_demonstration(state, outcome.repairs[0].fix.asset, everyone, text)
        case NoProgram():
            yield from ask_orientation(outcome.suggested, state, everyone)
            if mistake := ask_about_nearest(state, outcome.nearest, everyone):
                yield offer_label(state, _infer(state, family), mistake)
            text = f"Nothing fits what was shown on {{}}: {outcome.why}."
            yield _ask_demonstration(state, outcome.nearest.asset, everyone, text)
        case _:
            return


def _ask_repairs(state: ReviewState, outcome: NeedsRepair, everyone: float) -> Iterator[ReviewQuestion]:
    for repair in outcome.repairs:
        wrong, place = repair.fix, HullPlace(repair.fix.asset, repair.fix.hull)
        text = f"{wrong.hull} of {wrong.asset} is called {wrong.was or 'nothing'}: is it {wrong.to}? {repair.why}."
        choices = tuple(map(ReviewChoice.of_label, [wrong.to, *([wrong.was] if wrong.was else [])]))
        gain = everyone * repair.belief
        question = identify(
            ReviewQuestion("repair", text, YES_OR_NO, gain, wrong.asset, repair.rule, (place,), choices)
        )
        if question.id not in state.snoozed:
            yield question


def _questions(
    family: FamilyRun, found: Assessment, suggested: OrientationSuggestion | None
) -> Iterator[ReviewQuestion]:
    """What a person said is not asked again as a mistake, unless a result or a long rule speaks against it."""
    state, need_review = family.state, set(found.need_review)
    yield from ask_groups(family, [place for place, one in enumerate(family.runs) if one.asset in need_review])
    yield from _ask_candidates(family, found)
    answered = [one for one in family.mistakes if one.mistake.asset in state.demos or one.mistake.share > _LIKELY]
    asked = family.mistakes if family.results[1] else answered
    yield from (offer_label(state, family.posterior, ask_about_mistake(state, mistake)) for mistake in asked)
    yield from _ask_results(family, found)
    if suggested:
        yield from ask_orientation(
            suggested, state, SUGGESTION_RIGHT * len(need_review.intersection(suggested.differs_on))
        )


def _sort(questions: Iterable[ReviewQuestion], state: ReviewState) -> tuple[ReviewQuestion, ...]:
    """Those that may be asked, what is worth most a second first; of equals the first by its id. Who refused to turn
    the assets is not asked again on another one."""
    is_refused = any(name.startswith("orientation") for name in state.snoozed)
    asked = {one.id: one for one in questions if one.id not in state.snoozed}.values()
    left = (one for one in asked if not (is_refused and one.kind == "orientation"))
    return tuple(sorted(left, key=lambda one: (-one.worth, one.id)))


def _ask_candidates(family: FamilyRun, found: Assessment) -> Iterator[ReviewQuestion]:
    names = [one.asset for one in family.runs]
    known = {(answer.rule, answer.asset) for answer in family.state.answers}
    decided = {*found.looked_at, *found.excluded}
    for rule in family.candidates:
        uncertainty = 1 - rule.agreement
        places = [
            k
            for k in np.argsort(-uncertainty, kind="stable").tolist()
            if uncertainty[k] > 0 and names[k] not in decided
        ]
        open_places = [
            k
            for k in places
            if (rule.rule, names[k]) not in known
            and not family.runs[k].error
            and family.evidence[k].labels >= _LEAST_TRUST
        ]
        for split in split_candidates(rule, open_places[:_MOST_SPLITS]):
            yield _ask_candidate(family, rule.rule, split)


def _ask_candidate(family: FamilyRun, rule: int, split: CandidateSplit) -> ReviewQuestion:
    known, run = family.candidates[rule - 1], family.runs[split.asset]
    choices = []
    for letter, head in zip("abc", split.heads, strict=False):
        selected = run.names(rule, family.select(known, head, split.asset))
        choices.append(ReviewChoice(letter, show(known.extractors[head]), select=selected))
    gain = float(_gains_of(family, [split]).sum()) * family.evidence[split.asset].labels ** _TRUST
    kind: QuestionKind = "label" if run.asset in family.unseen_labels else "candidate"
    text = f"What does rule {rule} mean on {run.asset}?"
    return identify(ReviewQuestion(kind, text, CANDIDATE, gain, run.asset, rule, (), tuple(choices)))


def _gains_of(family: FamilyRun, splits: Sequence[CandidateSplit], looks: int = 0) -> Floats:
    """What it is worth for each edit (assets,) when some rules are told apart, and as many results more are found
    right; nothing for those that a person saw."""
    shares, program = np.ones(len(family.runs)), family.trust_in_program(looks) / family.trust_in_program()
    for split in splits:
        agreement = family.candidates[split.rule - 1].agreement
        shares *= np.minimum(1.0, agreement + split.gains) / np.maximum(agreement, 1e-9)
    seen = family.state.reviewed_assets
    rows = zip(family.runs, family.evidence, shares.tolist(), strict=True)
    return np.array(
        [
            0.0 if run.asset in seen else one.credit(candidates=max(share, 1.0), program=program)
            for run, one, share in rows
        ]
    )


def _ask_results(family: FamilyRun, found: Assessment) -> Iterator[ReviewQuestion]:
    correcting = price_demonstration(family.state.demos.values())
    failures, count = found.failures, len(found.assets)
    often = f" It is one of {len(failures)} of {count} that fail a goal." if 2 * len(failures) > count > 2 else ""
    for name in (one for one in {**dict.fromkeys(found.need_review), **failures} if one in family.places):
        uncertainty = 1 - found.assets[name].confidence
        place = family.places[name]
        if family.runs[place].error and not any(hull.label for hull in family.state.meshes[name].hulls):
            continue  # it is labelled before the program is applied, or by hand
        run, trust = family.runs[place], family.evidence[place].labels ** _TRUST
        splits = [split for rule in family.candidates for split in split_candidates(rule, [place])]
        others = _gains_of(family, splits, looks=1)
        others[place] = 0.0
        gain = uncertainty + float(others.sum()) * trust
        seconds = YES_OR_NO + uncertainty * correcting
        is_same = run.selected == family.state.failed.get(name) and name not in family.state.edited
        if name in found.wrong and is_same:
            text = f"The result of {name} was called wrong: what is right there?"
            yield _ask_result(run, 1.0, YES_OR_NO + correcting, text, _GIVE_UP)
        elif failing := failures.get(name):
            text = (
                f"On {name} {join_names([one.describe() for one in failing])}.{often} Is the result right all the same?"
            )
            own = [one.goal for one in found.assets[name].goals if one.fails or one.accepted]  # a reply is about all
            yield _ask_result(run, max(gain, _GOAL_GAIN), seconds, text, goals=own)
        else:
            yield _ask_result(run, gain, seconds)


def _ask_last_looks(family: FamilyRun) -> Iterator[ReviewQuestion]:
    """A person may have slipped in an answer, and many edits rest on it: one look at a result of each rule that answers
    have shaped, where nobody has seen any; and one at each asset that has an answer and labels that no demonstration
    shows, as the results of others tell little of it."""
    state = family.state
    seen = [state.meant[name] for name in (*state.accepted, *state.corrected) if name in state.meant]
    answers = [one for one in state.answers if one.select is not None]
    unseen = {one.rule for one in answers if not any(len(done) >= one.rule and done[one.rule - 1] for done in seen)}
    known = state.reviewed_assets | state.excluded.keys()
    for run, evidence in zip(family.runs, family.evidence, strict=True):
        answered = {one.rule for one in answers if one.asset == run.asset}
        if run.asset in known or (answered and run.asset not in family.unseen_labels):
            continue
        looked = answered | {rule for rule in unseen if rule <= len(run.selections) and run.selections[rule - 1]}
        if looked:
            gain = len(looked) + 1 - evidence.probability
            yield _ask_result(run, gain, YES_OR_NO, f"One last look: is the result of {run.asset} right?")


_EXCLUDE_CHOICES = tuple(ReviewChoice(choice, f"exclude it: {reason}") for choice, reason in EXCLUDE.items())
_GIVE_UP = (ReviewChoice(WRONG, "say what is right, or later"), *_EXCLUDE_CHOICES)
_CORRECT = (ReviewChoice(WRONG, "correct it"), *_EXCLUDE_CHOICES)
JUDGE_CHOICES = (ReviewChoice(RIGHT, "right"), ReviewChoice(WRONG, "wrong"), *_EXCLUDE_CHOICES)


def _ask_result(
    run: ProgramRun,
    gain: float,
    seconds: float,
    text: str = "",
    choices: tuple[ReviewChoice, ...] = JUDGE_CHOICES,
    goals: Sequence[str] = (),
) -> ReviewQuestion:
    """Whether a result is right; where the program cannot run there is none that could be. What is right where it was
    called wrong is the same question, so that a reply which was given before is known."""
    if run.error:
        text, choices = f"The program cannot run on {run.asset}: {run.error}. Correct it, or exclude it?", _CORRECT
    text = text or f"Is the result of {run.asset} right?"
    draft = ReviewQuestion(
        "result", text, seconds, gain, run.asset, choices=JUDGE_CHOICES if choices is _GIVE_UP else choices
    )
    bound = [*(f"{bits:x}" for bits in run.selections), *goals]
    return replace(identify(draft, bound), choices=choices, goals=tuple(goals))


def _ask_to_exclude(asset: str, why: str) -> ReviewQuestion:
    text = f"{asset} cannot be read: {why} Is it to be excluded?"
    return identify(ReviewQuestion("result", text, YES_OR_NO, 0.0, asset, choices=_EXCLUDE_CHOICES), [why])


def _ask_demonstration(state: ReviewState, asset: str, gain: float, text: str) -> ReviewQuestion:
    seconds = price_demonstration(state.demos.values())
    return identify(ReviewQuestion("demonstrate", text.format(asset), seconds, gain, asset))
