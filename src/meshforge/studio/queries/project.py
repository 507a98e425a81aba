"""The project as a whole, the cards of its assets and the next sensible step, as the page shows them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from importlib.util import find_spec

from meshforge.batch import action_text
from meshforge.common import MeshForgeError, pluralize
from meshforge.labels import LabelOffers, check_vlm_settings, endpoint_of
from meshforge.language import explain
from meshforge.project import AssetStatus, Project
from meshforge.rendering import UNSURE, label_color
from meshforge.studio.queries.assets import output_picture_digest, picture_digest
from meshforge.studio.wire.asset import Fault
from meshforge.studio.wire.family import AnswerView, Card, NewAssetsView, Next, ProjectView, RuleLine, VocabularyLabel
from meshforge.studio.wire.jobs import Model, PropagationState
from meshforge.studio.wire.program import OutcomeView
from meshforge.studio.wire.signoff import AssessmentView
from meshforge.symbolic import GIVEN_SOURCES
from meshforge.synthesis import Step


@dataclass(frozen=True, slots=True)
class Lookups:
    """What is looked up only where a step asks for it.

    suggest: which of some assets, by id, to demonstrate first; find_offers: labels that files and names say.
    """

    suggest: Callable[[Sequence[str]], str | None]
    find_offers: Callable[[], LabelOffers] = LabelOffers


def choose_next_step(
    cards: Sequence[Card],
    vocabulary: Sequence[str],
    has_program: bool,
    outcome: OutcomeView | None,
    problem: str | None,
    lookups: Lookups,
    propagated: PropagationState | None = None,
    assessment: AssessmentView | None = None,
) -> Next:
    """The first thing that is missing on the way from assets to exported outputs.

    outcome: the outcome of the last learning run; problem: why the program cannot be applied; propagated: what is
    known of the last propagation of labels; assessment: how sure the edits are, as far as it is known.
    """
    return (
        _step_for_hulls(cards)
        or _step_for_first_labels(cards, has_program, lookups.find_offers)
        or (None if vocabulary else Next(stage="label", say="Name what hulls can be: the labels of this family."))
        or _step_for_span(assessment)
        or _step_before_learning(cards, has_program, lookups.suggest, propagated)
        or _step_for_learning(outcome, has_program)
        or (Next(stage="learn", say=f"The program cannot be applied: {problem.splitlines()[0]}") if problem else None)
        or _step_for_question(assessment)
        or _step_for_outputs(cards)
        or _step_for_sign_off(cards, assessment)
        or _step_for_reviews(cards, outcome.sample if outcome else ())
    )


def _step_for_hulls(cards: Sequence[Card]) -> Next | None:
    bare = [card for card in cards if card.hulls == 0 and card.sources]
    if not bare:
        return None
    say = f"{_count_assets(bare, 'has', 'have')} no hulls: decompose what is shown there."
    return Next(stage="label", say=say, asset=bare[0].asset)


def _step_for_first_labels(
    cards: Sequence[Card], has_program: bool, find_offers: Callable[[], LabelOffers]
) -> Next | None:
    """To take labels that are there already, where no hull has one yet and nothing was done without any."""
    if has_program or any(card.demonstrated or max(card.labels, default=-1) >= 0 for card in cards):
        return None
    offers = find_offers()
    if offers.files:
        say = f"Labels files lie beside {pluralize(len(offers.files), 'asset')}: take their labels."
        return Next(stage="label", say=say)
    if offers.names:
        say = f"The names of {pluralize(offers.named, 'hull')} say a label: take their labels."
        return Next(stage="label", say=say)
    return None


def _count_assets(cards: Sequence[Card], one: str, many: str) -> str:
    """The asset by its id, or how many there are, with the verb."""
    return f"{cards[0].asset} {one}" if len(cards) == 1 else f"{pluralize(len(cards), 'asset')} {many}"


def _step_before_learning(
    cards: Sequence[Card],
    has_program: bool,
    suggest: Callable[[Sequence[str]], str | None],
    propagated: PropagationState | None,
) -> Next | None:
    if has_program or any(card.demonstrated for card in cards):
        return None
    labelled = [card.asset for card in cards if any(place >= 0 for place in card.labels)]
    if not labelled:
        first = next((card.asset for card in cards if card.hulls), None)
        return Next(stage="label", say="No hull has a label yet: label those of one asset.", asset=first)
    if step := _step_for_propagation(cards, propagated):
        return step
    best = suggest(labelled)
    say = f"Show the first step of the edit on one asset{f', best on {best}' if best else ''}."
    return Next(stage="demonstrate", say=say, asset=best or labelled[0])


def _step_for_propagation(cards: Sequence[Card], propagated: PropagationState | None) -> Next | None:
    bare = [card for card in cards if card.hulls and _count_unlabelled(card) == len(card.labels)]
    is_one_whole = any(card.hulls and card.given == card.hulls for card in cards)
    if bare and is_one_whole:
        return Next(stage="label", say=f"{_count_assets(bare, 'has', 'have')} no label: propagate labels.")
    if step := _step_for_unlabelled(cards, is_one_whole and propagated is None):
        return step
    doubtful = [card for card in cards if card.unsure]
    unsure = sum(len(card.unsure) for card in doubtful)
    if not unsure:
        return None
    if propagated and propagated.unused >= unsure:
        used = pluralize(propagated.unused, "label")
        return Next(stage="label", say=f"Propagate labels again: {used} of yours not used yet.")
    are = "1 label is unsure" if unsure == 1 else f"{unsure} labels are unsure"
    best = next((card for card in cards if propagated and card.asset == propagated.next), None)
    if best and len(best.labels) - best.given < unsure:
        return Next(stage="label", say=f"{are}: label {best.asset} next.", asset=best.asset)
    return Next(stage="label", say=f"{are}: press N.", asset=doubtful[0].asset)


def _step_for_unlabelled(cards: Sequence[Card], can_propagate: bool) -> Next | None:
    """To label what has no label yet, on the asset that lacks least of those that are begun."""
    lacking = {card.asset: count for card in cards if (count := _count_unlabelled(card))}
    if not lacking:
        return None
    lack, every = sum(lacking.values()), sum(len(card.labels) for card in cards)
    say = f"{lack} of {pluralize(every, 'hull')} {'has' if lack == 1 else 'have'} no label"
    if can_propagate:
        return Next(stage="label", say=f"{say}: propagate labels.")
    begun = {card.asset for card in cards if 0 < _count_unlabelled(card) < len(card.labels)}
    best = min((asset for asset in lacking if asset in begun or not begun), key=lambda asset: lacking[asset])
    return Next(stage="label", say=f"{say}: label those of {best}.", asset=best)


def _count_unlabelled(card: Card) -> int:
    return sum(place < 0 for place in card.labels)


def _step_for_learning(outcome: OutcomeView | None, has_program: bool) -> Next | None:
    if outcome is None:
        return None
    if outcome.repairs:
        say = f"{pluralize(outcome.repairs, 'label')} may be wrong: answer the question."
        return Next(stage="learn", say=say)
    if outcome.status in ("none", "timeout", "error"):
        return Next(
            stage="learn", say=_explain_failure(outcome), asset=outcome.nearest.asset if outcome.nearest else None
        )
    return None if has_program else Next(stage="learn", say="Learn the program from what is demonstrated.")


def _explain_failure(outcome: OutcomeView) -> str:
    """What to do where there is no program; the panel of the learning run says why."""
    if outcome.status == "error":
        return "Learning failed: see why, then learn again."
    if outcome.status == "timeout":
        return "Learning was stopped: learn again, or show the steps on another asset."
    if outcome.nearest:
        return f"No selection fits rule {outcome.nearest.rule} yet: see what comes nearest."
    return "No program does all that is demonstrated: see why, and what may help."


def _step_for_outputs(cards: Sequence[Card]) -> Next | None:
    behind = [c for c in cards if c.output == "none" or c.stale]
    if behind:
        return Next(stage="review", say=f"Apply the program: {_count_assets(behind, 'is', 'are')} not up to date.")
    failed = [c for c in cards if c.output == "failed"]
    if failed:
        say = f"The program fails on {pluralize(len(failed), 'asset')}: fix what is named, then apply it again."
        return Next(stage="review", say=say, asset=failed[0].asset)
    return None


def _step_for_span(assessment: AssessmentView | None) -> Next | None:
    """To say whether a hull is to be split, while nothing is demonstrated that a split would change."""
    asked = assessment.question if assessment and not assessment.assets else None
    return Next(stage="learn", say=asked.text, asset=asked.asset) if asked and asked.kind == "span" else None


def _step_for_question(assessment: AssessmentView | None) -> Next | None:
    """To answer what makes most results right for a person's time, as long as some are held."""
    asked = assessment.question if assessment and assessment.held else None
    if not assessment or not asked:
        return None
    say = f"{_count_held(assessment)}: {_WHAT_TO_DO.get(asked.kind, 'answer the question')}."
    return Next(stage="review" if asked.kind == "result" else "learn", say=say, asset=asked.asset)


_WHAT_TO_DO = {
    "result": "look at one result",
    "demonstrate": "demonstrate one more asset",
    "span": "say whether a hull is to be split",
}


def _count_held(assessment: AssessmentView) -> str:
    return f"{assessment.held} of {len(assessment.assets)} held"


def _step_for_sign_off(cards: Sequence[Card], assessment: AssessmentView | None) -> Next | None:
    """What is left to be signed off, and nothing more where nothing is; where some were not looked at, None."""
    if not assessment or not assessment.assets or any(card.review == "wrong" for card in cards):
        return None
    if assessment.held:
        least = min((one for one in assessment.assets if one.state == "held"), key=lambda one: one.probability)
        say = f"{_count_held(assessment)}: look at them, first {least.asset}."
        return Next(stage="review", say=say, asset=least.asset)
    if assessment.unseen:
        return None
    return Next(stage="review", say=f"{pluralize(assessment.signed_off, 'result')} signed off: export.")


def _step_for_reviews(cards: Sequence[Card], sample: Sequence[str]) -> Next:
    wrong = [c for c in cards if c.review == "wrong"]
    if wrong:
        return Next(
            stage="review", say=f"{pluralize(len(wrong), 'result')} wrong: say what is right.", asset=wrong[0].asset
        )
    open_ = [c for c in cards if c.review is None]
    waiting = {c.asset for c in open_}
    best = [asset for asset in sample if asset in waiting]
    if best:  # before all others, as these show best whether the program is right
        what = pluralize(len(best), "result that shows", "results that show")
        say = f"Look at {what} best whether the program is right{', first' if len(best) > 1 else ':'} {best[0]}."
        return Next(stage="review", say=say, asset=best[0])
    if open_:
        say = f"Look through the results: {pluralize(len(open_), 'asset')} to judge."
        return Next(stage="review", say=say, asset=open_[0].asset)
    return Next(stage="review", say="All results are accepted: export them.")


def build_project_view(
    project: Project,
    cards: Iterable[Card],
    next_step: Next,
    problem: str | None,
    lost: tuple[str, ...],
    propagated: PropagationState | None = None,
    new: NewAssetsView | None = None,
) -> ProjectView:
    """The project as the page shows it. problem, lost, propagated, new: see the fields of `ProjectView`."""
    settings, orient = project.settings, project.orientation
    return ProjectView(
        name=settings.name,
        folder=str(project.folder),
        vocabulary=vocabulary_view(settings.vocabulary, cards),
        orient=settings.orient,
        orient_sentence=explain(orient) if orient else "",
        contact=settings.thresholds.contact,
        extremity=settings.thresholds.extremity,
        rules=_rule_lines(project),
        said=tuple(_list_feedback(project)),
        templates=project.template_names(),
        carried=propagated,
        next=next_step,
        new=new,
        problem=problem,
        lost=lost,
        left_out=project.found.left_out,
    )


def _rule_lines(project: Project) -> tuple[RuleLine, ...]:
    shown = set(project.layout.demonstration.ids)
    steps = [(asset, step) for asset in project.assets() if asset in shown for step in project.steps(asset)]
    count = max((step.rule for _, step in steps), default=0)
    return tuple(_rule_line(k, [row for row in steps if row[1].rule == k]) for k in range(1, count + 1))


def _rule_line(rule: int, steps: Sequence[tuple[str, Step]]) -> RuleLine:
    first = min(steps, key=lambda row: not row[1].select)[1]  # of equals the one that comes first
    return RuleLine(
        rule=rule,
        action=action_text(first.action, first.label),
        shown=tuple(asset for asset, step in steps if step.select),
        nothing=tuple(asset for asset, step in steps if step.select is not None and not step.select),
    )


def vocabulary_view(words: Sequence[str], cards: Iterable[Card]) -> tuple[VocabularyLabel, ...]:
    """The labels of the vocabulary, with how many hulls have each."""
    used = Counter(place for card in cards for place in card.labels)
    return tuple(VocabularyLabel(name=w, color=label_color(k), used=used[k]) for k, w in enumerate(words))


def _list_feedback(project: Project) -> Iterator[AnswerView]:
    said = project.feedback()
    for answer in said.answers.values():
        if answer.select is None:
            what = "neither of the choices"
        else:
            what = pluralize(len(answer.select), "hull") if answer.select else "nothing"
        text = f"rule {answer.rule} on {answer.asset} selects {what}"
        yield AnswerView(id=answer.id, kind="answer", asset=answer.asset, text=text)
    for line in said.fixes.values():
        is_or_not = f"is {line.to}, not {line.was or 'without a label'}" if line.accepted else f"is not {line.to}"
        text = f"{line.hull} of {line.asset} {is_or_not}"
        yield AnswerView(id=line.id, kind="confirmed" if line.accepted else "rejected", asset=line.asset, text=text)


def build_card(
    status: AssetStatus,
    vocabulary: Sequence[str],
    orient: str,
    check: str | None = None,
    faults: tuple[Fault, ...] | None = None,
) -> Card:
    """The card of an asset; orient: the orientation's text, in whose frame it is drawn; check, faults: see `Card`."""
    places = {label: k for k, label in enumerate(vocabulary)}
    labels = tuple(places.get(label.name, -1) if label else -1 for label in status.labels)
    picture = None if status.hulls is None else picture_digest(status.geometry, status.labels, orient)
    output, doubtful = status.output_digest, set(status.doubtful)
    return Card(
        asset=status.id,
        hulls=status.hulls,
        labels=labels,
        unsure=tuple(
            k  # the label is not sure, or was given to another geometry
            for k, (name, label) in enumerate(zip(status.names, status.labels, strict=True))
            if label and (label.confidence < UNSURE or name in doubtful)
        ),
        given=sum(label is not None and label.source in GIVEN_SOURCES for label in status.labels),
        demonstrated=status.demonstrated,
        output=status.output,
        after=status.after,
        after_labels=tuple(places.get(label, -1) if label else -1 for label in status.after_labels),
        stale=status.stale,
        error=status.error,
        flags=status.flags,
        review=status.review,
        note=status.review_note,
        excluded=status.excluded,
        corrections=status.corrections,
        sources=status.sources,
        prepared=status.prepared,
        spans=dict(status.spans),
        picture=picture,
        edited_picture=output_picture_digest(picture, output) if output and picture else None,
        check=check,
        faults=faults,
    )


def model_of(project: Project) -> Model | None:
    """The model that can be asked for labels; None where the settings name none, or cannot be read."""
    try:
        settings = project.settings.vlm
    except MeshForgeError:
        return None
    if not settings.model:
        return None
    host, why = "", None
    try:
        host = endpoint_of(settings).host
        check_vlm_settings(settings, project.vocabulary)
    except MeshForgeError as error:
        why = error.message
    if find_spec("openai") is None:
        why = "This needs the extra: pip install 'meshforge[vlm]'"
    return Model(name=settings.model, host=host, mode=settings.mode, max_cost=settings.max_cost, why=why)
