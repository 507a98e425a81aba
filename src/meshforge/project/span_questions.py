"""Questions of a review about hulls that likely span parts, as was found last, and what becomes of the answers."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace

from meshforge.common import ProjectError
from meshforge.project.hull_mapping import describe_replaced
from meshforge.project.span_splits import mark_as_one_part, split_as_found
from meshforge.signoff import Assessment, Doubt, HullPlace, ReviewChoice, SpanQuestion
from meshforge.signoff.prices import YES_OR_NO
from meshforge.signoff.question import NO, YES, identify
from meshforge.store import SpanLine, Store, hull_digests
from meshforge.symbolic import SymbolicMesh

_NOT_MEANT = 0.5  # the probability that not all parts are meant where a demonstration named their hull


def ask_about_spans(
    store: Store, meshes: Mapping[str, SymbolicMesh], found: Assessment, has_program: bool
) -> Assessment:
    """An assessment whose question is about a hull that likely spans parts, where that is worth most.

    meshes: those of the family, by id. While there is no program these questions come first: what is demonstrated on a
    hull that spans parts has to be demonstrated anew once it is split.
    """
    spans = list_span_questions(store, meshes, found.excluded)
    asked = (
        sorted([*found.questions, *spans], key=lambda one: -one.worth) if has_program else [*spans, *found.questions]
    )
    return replace(found, questions=tuple(asked))


def add_span_doubts(
    store: Store, meshes: Mapping[str, SymbolicMesh], found: Assessment, seen: Collection[str]
) -> Assessment:
    """The same, where an edit is right at most as probably as that no hull of the asset spans parts.

    meshes: those of the family, by id; seen: assets of which a person saw what the edit makes of them.
    """
    spans, assets = store.spans(), dict(found.assets)
    for asset in sorted(spans.assets.keys() & meshes.keys() & assets.keys() - set(seen)):
        likely = spans.likely(asset, hull_digests(meshes[asset]))
        doubts = [Doubt("label", line.told, (hull,), share=line.chance) for hull, line in likely.items()]
        assets[asset] = assets[asset].with_doubts(doubts)
    return replace(found, assets=assets)


def add_demonstration_doubts(store: Store, found: Assessment, looked_at: Collection[str]) -> Assessment:
    """The same, where a program is learned from a demonstration that was carried to the parts of a hull, and nobody has
    looked whether all of them are meant.

    looked_at: assets whose result a person found right, or mended.
    """
    texts = {asset: [*describe_replaced(store, asset)] for asset in store.demonstration_ids() if asset in found.assets}
    if not any(texts.values()):
        return found
    assets = dict(found.assets)
    for asset in assets.keys() - set(looked_at):
        told = (text if one == asset else f"{one}: {text}" for one, own in texts.items() for text in own)
        assets[asset] = assets[asset].with_doubts(Doubt("reading", text, share=_NOT_MEANT) for text in told)
    unseen = {asset for asset, own in texts.items() if own} - set(looked_at)
    return replace(found, assets=assets, looked_at=found.looked_at - unseen)


def can_ask_about_spans(store: Store) -> bool:
    """Whether there may be such a question: hulls that span parts were found."""
    return bool(store.spans().assets)


def list_span_questions(
    store: Store, meshes: Mapping[str, SymbolicMesh], excluded: Collection[str] = ()
) -> list[SpanQuestion]:
    """The questions about hulls that likely span parts, the likeliest first.

    meshes: those of the family, by id; excluded: those that nothing is asked about.
    """
    snoozed = set(store.feedback().snoozed)
    asked = [one for one in _list_questions(store, meshes) if one.id not in snoozed and one.asset not in excluded]
    return sorted(asked, key=lambda one: (-one.gain, one.asset, one.hulls))


def _list_questions(store: Store, meshes: Mapping[str, SymbolicMesh]) -> Iterator[SpanQuestion]:
    """A question for each hull that likely spans parts, is as it was when that was found, and can be divided."""
    spans = store.spans()
    for asset in sorted(spans.assets.keys() & meshes.keys()):
        for hull, span in spans.likely(asset, hull_digests(meshes[asset])).items():
            if span.parts:
                yield _ask(asset, hull, span)


def _ask(asset: str, hull: str, span: SpanLine) -> SpanQuestion:
    text = f"{hull} of {asset} {span.told.removeprefix(f'{hull} ')}: split so?"
    choices = (
        ReviewChoice(NO, "no, it is one part"),
        ReviewChoice(YES, f"split so: {span.parts_told}"),
    )
    place = HullPlace(asset, hull)
    draft = SpanQuestion(text, YES_OR_NO, span.chance, asset, hulls=(place,), choices=choices)
    return identify(draft, [span.geometry])


def answer_span(store: Store, question: SpanQuestion, choice: ReviewChoice) -> None:
    """Split the hull that a question is about, or keep that it is one part.

    Raises ProjectError where the hull is not as it was when it was asked about.
    """
    (place,) = question.hulls
    if choice.id == NO:
        mark_as_one_part(store, place.asset, place.hull)
        return
    result = split_as_found(store, place.asset, place.hull)
    if result.problems:
        raise ProjectError(result.problems[0], where=place.asset)
