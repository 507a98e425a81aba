"""The project as a whole, as the page shows it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence

from meshforge.language import explain
from meshforge.project import Project, action_text
from meshforge.studio.wire.family import Card, Next, ProjectView, RuleLine, Said, VocabularyLabel
from meshforge.studio.wire.labelling import CarriedOver
from meshforge.synthesis import Step
from meshforge.views import label_color
from meshforge.words import counted


def project_view(
    project: Project,
    cards: Iterable[Card],
    following: Next,
    problem: str | None,
    lost: tuple[str, ...],
    carried: CarriedOver | None = None,
) -> ProjectView:
    """The project. following: the next sensible step; problem, lost: as of `meshforge.project.Status`."""
    settings, orient = project.settings, project.orientation
    return ProjectView(
        name=settings.name,
        folder=str(project.folder),
        vocabulary=vocabulary_view(settings.vocabulary, cards),
        orient=settings.orient,
        orient_sentence=explain(orient) if orient else "",
        contact=settings.thresholds.contact,
        extremity=settings.thresholds.extremity,
        rules=rule_lines(demonstrated(project)),
        describe=tuple(_said(project)),
        templates=project.template_names(),
        carried=carried,
        next=following,
        problem=problem,
        lost=lost,
    )


def demonstrated(project: Project) -> dict[str, tuple[Step, ...]]:
    """The steps of every asset on which something was demonstrated."""
    shown = set(project.layout.ids_with("demonstrations"))
    return {asset: project.steps(asset) for asset in project.assets() if asset in shown}


def rule_lines(shown: Mapping[str, Sequence[Step]]) -> tuple[RuleLine, ...]:
    """What is demonstrated, by rule."""
    count = max((step.rule for steps in shown.values() for step in steps), default=0)
    return tuple(_rule_line(rule, shown) for rule in range(1, count + 1))


def _rule_line(rule: int, shown: Mapping[str, Sequence[Step]]) -> RuleLine:
    said = [(asset, step) for asset, steps in shown.items() for step in steps if step.rule == rule]
    first = min(said, key=lambda row: not row[1].select)[1]  # of equals the one that comes first
    return RuleLine(
        rule=rule,
        action=action_text(first.action, first.label),
        shown=tuple(asset for asset, step in said if step.select),
        nothing=tuple(asset for asset, step in said if step.select is not None and not step.select),
    )


def vocabulary_view(words: Sequence[str], cards: Iterable[Card]) -> tuple[VocabularyLabel, ...]:
    """The labels of the vocabulary, with how many hulls have each."""
    used = Counter(place for card in cards for place in card.labels)
    return tuple(VocabularyLabel(name=w, color=label_color(k), used=used[k]) for k, w in enumerate(words))


def _said(project: Project) -> Iterator[Said]:
    kept = project.answers()
    for answer in kept.answers:
        if answer.select is None:
            what = "neither of the choices"
        else:
            what = counted(len(answer.select), "hull") if answer.select else "nothing"
        text = f"rule {answer.rule} on {answer.asset} selects {what}"
        yield Said(id=answer.id, kind="answer", asset=answer.asset, text=text)
    for line in kept.confirmed:
        text = f"{line.hull} of {line.asset} is {line.to}, not {line.was or 'without a label'}"
        yield Said(id=line.id, kind="confirmed", asset=line.asset, text=text)
    for wrong in kept.rejected:
        text = f"{wrong.hull} of {wrong.asset} is not {wrong.to}"
        yield Said(id=wrong.id, kind="rejected", asset=wrong.asset, text=text)
