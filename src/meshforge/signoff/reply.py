"""What is known of a family after a reply, and what of that is to be learned from."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from meshforge.label_model import FamilyPosterior
from meshforge.signoff.question import ASIDE, RIGHT, ReviewQuestion, ReviewReply, ReviewState, Selections
from meshforge.signoff.slips import ON_PURPOSE, correct_selection
from meshforge.symbolic import Label, LabelSource
from meshforge.synthesis import Answer

TEACHES = 0.8
"""A result that was mended is learned from where the labels of the hulls that were mended are right with this
probability; elsewhere the labels may be at fault, and no rule."""


def apply_reply(
    state: ReviewState, question: ReviewQuestion, reply: ReviewReply, done: Selections | None = None
) -> ReviewState:
    """What is known after a reply; done: what the rules select on the asset whose result was asked about."""
    choice = None if reply.choice is None else question.choices[reply.choice]
    if reply.later:
        return replace(state, later=state.later | {question.id})
    if question.kind == "result":
        return _apply_verdict(state, question, reply, done)
    if question.kind == "selection":
        if choice is None or choice.select is None or choice.text == ON_PURPOSE:
            return replace(state, later=state.later | {question.id})
        return correct_selection(state, question, choice.select)
    if question.rule is not None and any(one.select is not None for one in question.choices):
        refused = [one.select for one in question.choices if one.select is not None] if choice is None else []
        answer = Answer(question.rule, question.asset, None if choice is None else choice.select, refused)
        return replace(state, answers=(*state.answers, answer))
    if question.kind == "orientation" and choice is not None:
        put_off = state.later | {question.id}
        return replace(state, frame=replace(state.frame, orient=choice.orient or state.frame.orient), later=put_off)
    if choice is None and not reply.exceptions:
        return replace(state, later=state.later | {question.id})
    return _apply_labels(state, question, reply)


def _apply_verdict(
    state: ReviewState, question: ReviewQuestion, reply: ReviewReply, done: Selections | None
) -> ReviewState:
    said = None if reply.choice is None else question.choices[reply.choice].text
    if said == ASIDE:
        return replace(state, aside=state.aside | {question.asset})
    if said == RIGHT and done is not None:
        return replace(state, accepted={**state.accepted, question.asset: done})
    if reply.mended is not None:
        failed = {**state.failed, question.asset: done} if done is not None else state.failed
        return replace(state, mended={**state.mended, question.asset: reply.mended}, failed=failed)
    return state


def _apply_labels(state: ReviewState, question: ReviewQuestion, reply: ReviewReply) -> ReviewState:
    """Labels that a person gave, to hulls of a group or to one."""
    choice = None if reply.choice is None else question.choices[reply.choice]
    given = dict.fromkeys(question.hulls, choice.label) if choice is not None and choice.label else {}
    source: LabelSource = "repair" if question.kind == "repair" else "user"
    meshes = dict(state.meshes)
    for place, label in {**given, **reply.exceptions}.items():
        meshes[place.asset] = meshes[place.asset].with_labels({place.hull: Label(str(label), 1.0, source)})
    asked = {question.id} if question.kind == "repair" else set[str]()  # who keeps a label is not asked for it again
    return replace(state, meshes=meshes, later=state.later | asked)


def list_answers(state: ReviewState, posterior: FamilyPosterior) -> Iterator[Answer]:
    """What is to be learned from besides demonstrations; later answers count before earlier ones."""
    for name, done in state.accepted.items():
        yield from _number(name, done)
    yield from state.answers
    for place, name in enumerate(state.meshes):
        if name in state.mended and _trust(state, posterior, name, place) >= TEACHES:
            yield from _number(name, state.mended[name])


def _number(asset: str, selections: Selections) -> Iterator[Answer]:
    yield from (Answer(rule, asset, select) for rule, select in enumerate(selections, 1))


def _trust(state: ReviewState, posterior: FamilyPosterior, asset: str, place: int) -> float:
    """The probability that the labels of the hulls that were mended on an asset are right; of all, if these are not
    known."""
    pairs = zip(state.mended[asset], state.failed.get(asset, ()), strict=False)
    mended = frozenset[str]().union(*(wanted ^ done for wanted, done in pairs))
    columns = {label: column for column, label in enumerate(posterior.seen.labels)}
    rows = zip(state.meshes[asset].hulls, posterior.chances_of(place), strict=True)
    shares = [
        float(row[columns[hull.label]]) if hull.label in columns else 0.0
        for hull, row in rows
        if not mended or hull.name in mended
    ]
    return float(np.prod(shares))
