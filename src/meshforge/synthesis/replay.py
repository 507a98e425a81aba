"""Replays demonstrations: the mesh as each rule meets it, after all rules before it.

What was worked out about a mesh is memoized for as long as the mesh lives: a program is learned anew after every
answer, from the same meshes, and most of its rules stay what they were.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, replace
from typing import TypeVar
from weakref import WeakKeyDictionary

from meshforge.common import DemonstrationError, MeshForgeError, nearest_name
from meshforge.language import (
    EXTREMITY,
    ActionResult,
    Each,
    Orient,
    Rule,
    Template,
    apply_action,
    select_mask,
    to_canonical_frame,
)
from meshforge.symbolic import SymbolicMesh, mask_of, split_by_contact
from meshforge.synthesis.demonstration import Demonstration, Example, RuleSpec

Value = TypeVar("Value")
_memo: WeakKeyDictionary[SymbolicMesh, dict[Hashable, object]] = WeakKeyDictionary()


@dataclass(frozen=True, eq=False, slots=True)
class Replay:
    """A demonstration in the midst of its replay.

    mesh: in the canonical frame, edited by the rules so far; used: names that no made hull may take again.
    """

    name: str
    demo: Demonstration
    mesh: SymbolicMesh
    used: frozenset[str] = frozenset()


def begin_replay(name: str, demo: Demonstration, orient: Orient | None, contact: float | None) -> Replay:
    """A demonstration before its first rule. Raises ProgramError where the orientation fails on its mesh."""
    try:
        mesh = memoize(
            demo.mesh, (orient, contact), SymbolicMesh, lambda: to_canonical_frame(demo.mesh, orient, contact)[0]
        )
    except MeshForgeError as error:
        raise error.at(name) from None
    return Replay(name, demo, mesh)


def example_of(replay: Replay, rule: RuleSpec) -> Example | None:
    """What the demonstration says about the next rule, None where it says nothing.

    Raises DemonstrationError for a hull that is not there, and where `Each` would do something else than was shown.
    """
    step = replay.demo.step(rule.number)
    if step is None:
        return None
    selection = _mask_of_step(replay, rule.number)
    if rule.each_in and step.shown and not isinstance(step.action, Each):
        _check_single(replay, rule, selection)
    return Example(replay.name, replay.mesh, selection)


def advance(
    replay: Replay, number: int, rule: Rule, templates: Mapping[str, Template], extremity: float | None = None
) -> Replay:
    """The replay after one more rule: on the hulls that were shown, or where nothing was shown on those it selects."""
    is_given = replay.demo.step(number) is not None
    delta = EXTREMITY if extremity is None else extremity
    mask = _mask_of_step(replay, number) if is_given else select_mask(rule.extractor, replay.mesh, delta)
    try:
        applied = _apply(replay, mask, rule, templates)
    except MeshForgeError as error:
        raise error.at(f"{replay.name}, rule {number}") from None
    return replace(replay, mesh=applied.mesh, used=applied.used)


def _apply(replay: Replay, mask: int, rule: Rule, templates: Mapping[str, Template]) -> ActionResult:
    def applied() -> ActionResult:
        return apply_action(replay.mesh, mask, rule.action, templates, rule.label, replay.used)

    wanted = rule.action.templates
    if not mask or any(name not in templates for name in wanted):  # nothing to do, or it fails
        return applied()
    made_of = tuple(templates[name].digest for name in wanted)
    return memoize(replay.mesh, (mask, rule.action, rule.label, replay.used, made_of), ActionResult, applied)


def _mask_of_step(replay: Replay, number: int) -> int:
    """The hulls of a step by their names, as a bit set."""
    step = replay.demo.step(number)
    wanted = sorted(step.select) if step and step.select else []
    for name in wanted:
        if name not in replay.mesh.index:
            raise _unknown_hull_error(replay, number, name)
    return mask_of(replay.mesh.index[name] for name in wanted)


def _unknown_hull_error(replay: Replay, number: int, name: str) -> DemonstrationError:
    where = f"{replay.name}, rule {number}"
    if name in replay.demo.mesh.index or name in replay.used:
        return DemonstrationError(
            f"the hull {name!r} is gone: an earlier rule removed or replaced it",
            where=where,
            remedy="Select what that rule made, or change the order of the steps.",
        )
    like = nearest_name(name, replay.mesh.index)
    return DemonstrationError(
        f"there is no hull {name!r}", where=where, remedy=f"Did you mean {like!r}?" if like else None
    )


def _check_single(replay: Replay, rule: RuleSpec, selection: int) -> None:
    parts = len(split_by_contact(replay.mesh, selection))
    if parts > 1:
        shown = replay.demo.step(rule.number)
        assert shown
        raise DemonstrationError(
            f"rule {rule.number} does {shown.action} in {replay.name} on {parts} parts that do not touch, "
            f"but {rule.action} in {rule.each_in}",
            remedy=f"Make it {rule.action} in {replay.name}, or {shown.action} in {rule.each_in}.",
        )


def memoize(mesh: SymbolicMesh, key: Hashable, kind: type[Value], make: Callable[[], Value]) -> Value:
    """What `make` gives for the mesh and the key, made once.

    It must not hold on to the mesh itself, which would then live for ever; errors are not remembered.
    """
    known = _memo.setdefault(mesh, {})
    found = known.get((kind, key))
    if isinstance(found, kind):
        return found
    made = make()
    known[kind, key] = made
    return made
