"""Replays demonstrations: the meshes as each rule meets them, after all rules before it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from meshforge.errors import DemonstrationError, MeshForgeError, nearest
from meshforge.language import (
    EXTREMITY,
    Applied,
    Each,
    Orient,
    Rule,
    Template,
    apply_action,
    select_mask,
    stage,
)
from meshforge.symbolic import SymbolicMesh, components, mask_of
from meshforge.synthesis.agreement import Agreed
from meshforge.synthesis.demonstration import Demonstration
from meshforge.synthesis.example import Example
from meshforge.synthesis.remember import remembered


@dataclass(frozen=True, eq=False, slots=True)
class Replay:
    """A demonstration in the midst of its replay.

    mesh: in the canonical frame, edited by the rules so far; used: names that no made hull may take again.
    """

    name: str
    demo: Demonstration
    mesh: SymbolicMesh
    used: frozenset[str] = frozenset()


def begun(name: str, demo: Demonstration, orient: Orient | None, contact: float | None) -> Replay:
    """A demonstration before its first rule. Raises ProgramError where the orientation fails on its mesh."""
    try:
        mesh = remembered(demo.mesh, (orient, contact), SymbolicMesh, lambda: stage(demo.mesh, orient, contact)[0])
    except MeshForgeError as error:
        raise error.at(name) from None
    return Replay(name, demo, mesh)


def example(replay: Replay, rule: Agreed) -> Example | None:
    """What the demonstration says about the next rule, None where it says nothing.

    Raises DemonstrationError for a hull that is not there, and where `Each` would do something else than was shown.
    """
    step = replay.demo.step(rule.number)
    if step is None:
        return None
    selection = _shown(replay, rule.number)
    if rule.each_in and step.shown and not isinstance(step.action, Each):
        _check_single(replay, rule, selection)
    return Example(replay.name, replay.mesh, selection)


def advanced(
    replay: Replay, number: int, rule: Rule, templates: Mapping[str, Template], extremity: float | None = None
) -> Replay:
    """The replay after one more rule: on the hulls that were shown, or where nothing was said on those it selects."""
    said = replay.demo.step(number) is not None
    delta = EXTREMITY if extremity is None else extremity
    mask = _shown(replay, number) if said else select_mask(rule.extractor, replay.mesh, delta)
    try:
        applied = _applied(replay, mask, rule, templates)
    except MeshForgeError as error:
        raise error.at(f"{replay.name}, rule {number}") from None
    return replace(replay, mesh=applied.mesh, used=applied.used)


def _applied(replay: Replay, mask: int, rule: Rule, templates: Mapping[str, Template]) -> Applied:
    def applied() -> Applied:
        return apply_action(replay.mesh, mask, rule.action, templates, rule.label, replay.used)

    wanted = rule.action.templates
    if not mask or any(name not in templates for name in wanted):  # nothing to do, or it fails
        return applied()
    made_of = tuple(templates[name].digest for name in wanted)
    return remembered(replay.mesh, (mask, rule.action, rule.label, replay.used, made_of), Applied, applied)


def _shown(replay: Replay, number: int) -> int:
    """The hulls of a step by their names, as a bit set."""
    step = replay.demo.step(number)
    wanted = sorted(step.select) if step and step.select else []
    for name in wanted:
        if name not in replay.mesh.index:
            raise _unknown(replay, number, name)
    return mask_of(replay.mesh.index[name] for name in wanted)


def _unknown(replay: Replay, number: int, name: str) -> DemonstrationError:
    where = f"{replay.name}, rule {number}"
    if name in replay.demo.mesh.index or name in replay.used:
        return DemonstrationError(
            f"the hull {name!r} is gone: an earlier rule removed or replaced it",
            where=where,
            remedy="Select what that rule made, or change the order of the steps.",
        )
    like = nearest(name, replay.mesh.index)
    return DemonstrationError(
        f"there is no hull {name!r}", where=where, remedy=f"Did you mean {like!r}?" if like else None
    )


def _check_single(replay: Replay, rule: Agreed, selection: int) -> None:
    parts = len(components(replay.mesh, selection))
    if parts > 1:
        shown = replay.demo.step(rule.number)
        assert shown
        raise DemonstrationError(
            f"rule {rule.number} does {shown.action} in {replay.name} on {parts} parts that do not touch, "
            f"but {rule.action} in {rule.each_in}",
            remedy=f"Make it {rule.action} in {replay.name}, or {shown.action} in {rule.each_in}.",
        )
