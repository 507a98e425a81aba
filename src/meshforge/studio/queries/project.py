"""The project as a whole and the cards of its assets, as the page shows them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from importlib.util import find_spec

from meshforge.common import MeshForgeError, pluralize
from meshforge.labels import check_vlm_settings, endpoint_of
from meshforge.language import explain
from meshforge.project import AssetStatus, Project
from meshforge.rendering import UNSURE, label_color
from meshforge.store import action_text
from meshforge.studio.queries.assets import output_picture_digest, picture_digest
from meshforge.studio.wire.asset import Fault
from meshforge.studio.wire.family import Card, Next, ProjectView, RuleLine, Said, VocabularyLabel
from meshforge.studio.wire.jobs import CarriedOver, Model
from meshforge.symbolic import GIVEN_SOURCES
from meshforge.synthesis import Step


def build_project_view(
    project: Project,
    cards: Iterable[Card],
    next_step: Next,
    problem: str | None,
    lost: tuple[str, ...],
    propagated: CarriedOver | None = None,
) -> ProjectView:
    """The project as the page shows it. problem, lost, propagated: see the fields of `ProjectView`."""
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
        problem=problem,
        lost=lost,
    )


def _rule_lines(project: Project) -> tuple[RuleLine, ...]:
    """What is demonstrated, by rule."""
    shown = set(project.layout.ids_with("demonstrations"))
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


def _list_feedback(project: Project) -> Iterator[Said]:
    kept = project.answers()
    for answer in kept.answers:
        if answer.select is None:
            what = "neither of the choices"
        else:
            what = pluralize(len(answer.select), "hull") if answer.select else "nothing"
        text = f"rule {answer.rule} on {answer.asset} selects {what}"
        yield Said(id=answer.id, kind="answer", asset=answer.asset, text=text)
    for line in kept.confirmed:
        text = f"{line.hull} of {line.asset} is {line.to}, not {line.was or 'without a label'}"
        yield Said(id=line.id, kind="confirmed", asset=line.asset, text=text)
    for wrong in kept.rejected:
        text = f"{wrong.hull} of {wrong.asset} is not {wrong.to}"
        yield Said(id=wrong.id, kind="rejected", asset=wrong.asset, text=text)


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
        corrections=status.corrections,
        sources=status.sources,
        prepared=status.prepared,
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
