"""Likely mistakes in demonstrations, answers and verdicts, and the question about them."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from meshforge.common import join_names
from meshforge.geometry import Floats
from meshforge.label_model import FamilyPosterior
from meshforge.language import Program, show
from meshforge.signoff.assessment import ReviewState
from meshforge.signoff.program_run import ProgramRun, select_by
from meshforge.signoff.question import NO, YES, YES_OR_NO, HullPlace, ReviewChoice, ReviewQuestion, identify
from meshforge.symbolic import HUMAN_SOURCES, mask_of
from meshforge.synthesis import Example, LikelyMistake, Nearest, Options, Repair, find_mistake
from meshforge.synthesis.diagnosis import MOST_MISTAKES

_LEAST_SHARE = 0.05  # from which on a slip is asked about
_LEAST_CHANCE = 0.05  # of another label, from which on it is offered
_FITS_BARELY = 0.5  # the probability of a slip where no program fits what was shown


@dataclass(frozen=True, eq=False, slots=True)
class RuleMistake:
    """A mistake in what was shown or said of a rule. differs: whether the rule would change on each asset."""

    rule: int
    mistake: LikelyMistake
    differs: Floats


def find_mistakes(state: ReviewState, program: Program, runs: Sequence[ProgramRun]) -> Iterator[RuleMistake]:
    """Yield the likely mistakes under a program that does what was shown, of each rule at most one; those that a person
    denied are not among them, and there are none where nothing was shown, as under a program that a person wrote."""
    if state.by_hand or not state.demos:
        return
    options = Options(extremity=program.extremity)
    by_name = {run.asset: run for run in runs}
    for number, rule in enumerate(program.rules, 1):
        examples = list(_list_examples(state, by_name, number))
        if not examples:
            continue
        answered = {one.asset for one in state.answers if one.rule == number}.union(state.accepted)
        answered -= state.demos.keys() | state.corrected
        mistake = find_mistake(rule.extractor, examples, program.labels, options, answered)
        if mistake is None or mistake.asset not in {*state.demos, *answered} or mistake.share < _LEAST_SHARE:
            continue
        if _is_used_later(state, mistake.asset, number, mistake.missing):
            continue
        selected = [select_by(run, number, mistake.extractor, options.geo_extremity) for run in runs]
        if any(_is_refused(state, number, run, mask) for run, mask in zip(runs, selected, strict=True)):
            continue
        ours = [run.selections[number - 1] if number <= len(run.selections) else None for run in runs]
        differs = np.array([float(one != other) for one, other in zip(ours, selected, strict=True)])
        found = RuleMistake(number, mistake, differs)
        if ask_about_mistake(state, found).id not in state.snoozed:
            yield found


def _list_examples(state: ReviewState, runs: Mapping[str, ProgramRun], rule: int) -> Iterator[Example]:
    for name in dict.fromkeys([*state.demos, *(one.asset for one in state.answers), *state.meant]):
        select, run = _read_selection(state, name, rule), runs.get(name)
        if select is None or run is None or rule > len(run.meshes):
            continue
        mesh = run.meshes[rule - 1]
        if select <= mesh.index.keys():
            yield Example(name, mesh, mask_of(mesh.index[hull] for hull in select))


def _read_selection(state: ReviewState, asset: str, rule: int) -> frozenset[str] | None:
    """What a rule was shown or said to select on an asset, None where nothing was; what was shown counts first, then
    results that were seen, then the last answer."""
    if asset in state.demos:
        step = state.demos[asset].step(rule)
        return None if step is None else step.select
    if rule <= len(state.meant.get(asset, ())):
        return state.meant[asset][rule - 1]
    answers = (one.select for one in reversed(state.answers) if (one.rule, one.asset) == (rule, asset))
    return next((select for select in answers if select is not None), None)


def _is_used_later(state: ReviewState, asset: str, rule: int, hulls: Sequence[str]) -> bool:
    """Whether a later step of a demonstration selects one of some hulls, so that it was left out on purpose."""
    steps = state.demos[asset].steps[rule:] if asset in state.demos else ()
    return any(not step.select.isdisjoint(hulls) for step in steps if step.select)


def _is_refused(state: ReviewState, rule: int, run: ProgramRun, mask: int | None) -> bool:
    refused = [some for one in state.answers if (one.rule, one.asset) == (rule, run.asset) for some in one.refused]
    return bool(refused) and mask is not None and frozenset(run.names(rule, mask)) in refused


def ask_about_mistake(state: ReviewState, found: RuleMistake) -> ReviewQuestion:
    """Return the question whether it is one."""
    mistake, rule = found.mistake, found.rule
    text = _liken_to_shown(state, found) or (
        f"{_describe(mistake.missing, mistake.extra)} rule {rule} would just be {show(mistake.extractor)}"
    )
    return _ask(
        state, (mistake.asset, rule), mistake.missing, mistake.extra, text, mistake.share * float(found.differs.sum())
    )


def ask_about_nearest(state: ReviewState, nearest: Nearest, everyone: float) -> ReviewQuestion | None:
    """Return the question where nothing fits what was shown and said, and an extractor nearly does."""
    if len(nearest.extra) + len(nearest.missing) > MOST_MISTAKES:
        return None
    if nearest.asset in state.corrected or nearest.asset not in state.meshes:
        return None
    if _read_selection(state, nearest.asset, nearest.rule) is None:
        return None
    if _is_used_later(state, nearest.asset, nearest.rule, nearest.extra):
        return None
    text = f"{_describe(nearest.extra, nearest.missing)} rule {nearest.rule} could be {show(nearest.extractor)}"
    place = nearest.asset, nearest.rule
    return _ask(state, place, nearest.extra, nearest.missing, text, _FITS_BARELY * everyone)


def ask_about_kept_label(state: ReviewState, repair: Repair, everyone: float) -> ReviewQuestion | None:
    """Return the question where a person kept the label that would have to be another one for what was shown and said:
    what was shown or said of that hull may be the mistake."""
    hull, asset = repair.fix.hull, repair.fix.asset
    shown = _read_selection(state, asset, repair.rule)
    kept = state.meshes[asset].hull_of(hull).source in HUMAN_SOURCES if asset in state.meshes else False
    if shown is None or asset in state.corrected or not kept:
        return None
    missing, extra = ((), (hull,)) if hull in shown else ((hull,), ())
    if _is_used_later(state, asset, repair.rule, missing):
        return None
    text = f"{hull} is {repair.fix.was}, and rule {repair.rule} {'selects it' if extra else 'leaves it out'}"
    return _ask(state, (asset, repair.rule), missing, extra, text, _FITS_BARELY * everyone)


def _liken_to_shown(state: ReviewState, found: RuleMistake) -> str | None:
    """What hulls that were left out have in common with those that were selected, None where that is not all."""
    mistake, mesh = found.mistake, state.meshes[found.mistake.asset]
    shown = _read_selection(state, mistake.asset, found.rule) or frozenset()
    labels = {mesh.hull_of(hull).label for hull in {*mistake.missing, *shown} if hull in mesh.index}
    if mistake.extra or not shown or len(labels) != 1:
        return None
    verb = "is" if len(mistake.missing) == 1 else "are"
    others = f"the {len(shown)} hulls that rule {found.rule} selects" if len(shown) > 1 else next(iter(shown))
    return f"{join_names(mistake.missing)} {verb} {next(iter(labels))}, like {others}"


def offer_label(state: ReviewState, posterior: FamilyPosterior, question: ReviewQuestion) -> ReviewQuestion:
    """Return the same question with one more choice: that its hull has another label, where one is likely."""
    if len(question.hulls) != 1 or not posterior.seen.labels:
        return question
    asset, hull = question.hulls[0]
    place, mesh = list(state.meshes).index(asset), state.meshes[asset]
    chances = posterior.by_others[posterior.table.spans[place]][mesh.index[hull]]
    label = mesh.hull_of(hull).label
    others = [(-share, name) for share, name in zip(chances.tolist(), posterior.seen.labels, strict=True)]
    share, name = min((row for row in others if row[1] != label), default=(0.0, ""))
    if -share < _LEAST_CHANCE or name in (YES, NO):
        return question
    return replace(question, choices=(*question.choices, ReviewChoice(name, f"no, {hull} is {name}", label=name)))


def _describe(missing: Sequence[str], extra: Sequence[str]) -> str:
    if not missing:
        return f"Without {join_names(extra)}"
    return f"With {join_names(missing)}" + (f" and without {join_names(extra)}" if extra else "")


def _ask(
    state: ReviewState, place: tuple[str, int], missing: Sequence[str], extra: Sequence[str], why: str, gain: float
) -> ReviewQuestion:
    asset, rule = place
    shown = _read_selection(state, asset, rule) or frozenset()
    corrected = tuple(sorted((shown | {*missing}) - {*extra}))
    done = "left out" if missing and not extra else "selected" if extra and not missing else "left out or selected"
    one = len(missing) + len(extra) == 1
    text = f"{why}: {'was it' if one else 'were they'} {done} on {asset} by mistake?"
    hulls = tuple(HullPlace(asset, name) for name in [*missing, *extra] if name in state.meshes[asset].index)
    choices = (
        ReviewChoice(NO, "no, on purpose", select=tuple(sorted(shown))),
        ReviewChoice(YES, "yes, by mistake", select=corrected),
    )
    return identify(ReviewQuestion("selection", text, YES_OR_NO, gain, asset, rule, hulls, choices))
