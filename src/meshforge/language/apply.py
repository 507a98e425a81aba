"""One action on one selection, every new shape verified; one rule on one mesh in the canonical frame; and the way into
that frame and back."""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Protocol, TypeVar

import numpy as np

from meshforge import geometry, symbolic
from meshforge.common import Plugin, blame, join_names
from meshforge.language.actions.base import Action
from meshforge.language.actions.edit import GroupEdit, HullGroup, NewShape, Template, check_templates
from meshforge.language.actions.registry import plugin_of
from meshforge.language.orient import orient_mesh
from meshforge.language.print import Rule
from meshforge.language.syntax import EXTREMITY, Orient, reference_length, select_mask

_NEW_SUFFIX = re.compile(r"~\d+$")
_CONVEXITY = 1e-7  # relative to the size

Value = TypeVar("Value")


class Memo(Protocol):
    """Gives what `make` makes for a mesh and a key; where that was asked before, what was made then."""

    def __call__(
        self, mesh: symbolic.SymbolicMesh, key: Hashable, kind: type[Value], make: Callable[[], Value]
    ) -> Value: ...


def make_anew(mesh: symbolic.SymbolicMesh, key: Hashable, kind: type[Value], make: Callable[[], Value]) -> Value:
    """The memo that keeps nothing."""
    return make()


@dataclass(frozen=True, eq=False, slots=True)
class ActionResult:
    """The outcome of one action.

    made: names of the made hulls; sources: for each of them, the names of the hulls it was made from.
    note: what a user should know; used: names that no later edit of the same run may give again.
    """

    mesh: symbolic.SymbolicMesh
    made: tuple[str, ...] = ()
    note: str | None = None
    sources: tuple[tuple[str, ...], ...] = ()
    used: frozenset[str] = frozenset()


def apply_action(
    mesh: symbolic.SymbolicMesh,
    selected_mask: int,
    action: Action,
    templates: Mapping[str, Template] | None = None,
    label: str | None = None,
    used: frozenset[str] = frozenset(),
) -> ActionResult:
    """Does an action to the hulls of a bit set, in the frame the mesh is in.

    label: for what is made, None takes over that of the largest hull; used: in a run of several actions, the names
    that the result before has. Kept hulls stay the same objects, made ones follow after them.
    Raises ProgramError for a missing template, GeometryError where no sound shape can be made, PluginError for what a
    plug-in does wrong.
    """
    templates = templates or {}
    check_templates(action.templates, templates)
    if not selected_mask:
        return ActionResult(mesh, note="nothing selected", used=used)
    plugin = plugin_of(action)
    with blame(plugin):
        groups = [
            HullGroup(
                tuple(mesh.hulls[index] for index in sorted(symbolic.bits_of(part))), reference_length(mesh), templates
            )
            for part in action.groups(mesh, selected_mask)
        ]
        edits = [action.edit(group) for group in groups]
        if plugin:
            _verify_edits(plugin, groups, edits)
    taken = set(used | names_in_use(mesh))
    made = [
        (_make_hull(m, label, taken, reference_length(mesh), is_alone=edit.replaces_one(m)), m)
        for edit in edits
        for m in edit.made
    ]
    gone = {hull.name for group, edit in zip(groups, edits, strict=True) if edit.removes for hull in group.hulls}
    renamed = _relabel(groups, edits, label)
    kept = [renamed.get(hull.name, hull) for hull in mesh.hulls if hull.name not in gone]
    notes = [action.note_on(mesh, selected_mask), *(edit.note for edit in edits)]
    notes += [*inheritance_notes((m for _, m in made), mesh), describe_lost_gaps(mesh, selected_mask, made)]
    return ActionResult(
        mesh.with_hulls([*kept, *(hull for hull, _ in made)]) if made or gone or renamed else mesh,
        tuple(hull.name for hull, _ in made),
        "; ".join(dict.fromkeys(note for note in notes if note)) or None,
        tuple(tuple(source.name for source in m.sources) for _, m in made),
        frozenset(taken),
    )


def _verify_edits(plugin: Plugin, groups: list[HullGroup], edits: list[GroupEdit]) -> None:
    """Raise PluginError for what a plug-in must not make of hulls: what is built in is trusted."""
    for group, edit in zip(groups, edits, strict=True):
        for made in edit.made:
            fault = geometry.find_fault(made.shape)
            if fault:
                what = f"made a hull of {join_names([hull.name for hull in made.sources], 3)} that"
                raise plugin.error(f"{what} {geometry.describe_fault(fault)}")
            if not {made.heir.name, *(hull.name for hull in made.sources)} <= {hull.name for hull in group.hulls}:
                raise plugin.error("named hulls that it was not given as the sources of one that it made")


def names_in_use(mesh: symbolic.SymbolicMesh) -> frozenset[str]:
    """The names that a made hull must not take: those of the mesh and of the file it came from."""
    source = mesh.asset.geoms if mesh.asset else ()
    return frozenset([hull.name for hull in mesh.hulls] + [geom.name for geom in source])


def _make_hull(
    made: NewShape, label: str | None, taken: set[str], reference: float, *, is_alone: bool
) -> symbolic.Hull:
    """The hull of a made shape, verified and named; its name is added to those taken."""
    heir = made.heir
    shape = ensure_valid(made.shape, heir.name, geometry.FLATNESS * reference)
    stem = heir.name if heir.parent is None else _NEW_SUFFIX.sub("", heir.name)
    count = 1
    while f"{stem}~{count}" in taken:
        count += 1
    taken.add(f"{stem}~{count}")
    keeps_name = is_alone and (heir.parent is None or heir.keeps_name)
    return symbolic.Hull(
        f"{stem}~{count}", heir.body, shape, _label_of_new(heir, label), heir.parent or heir.name, keeps_name
    )


def _label_of_new(heir: symbolic.Hull, label: str | None) -> symbolic.Label | None:
    """The label of a made hull; one that the program sets is as sure as the program."""
    if label is not None:
        return symbolic.Label(label, source="edit")
    known = heir.annotation
    return symbolic.Label(known.name, known.confidence, "edit") if known else None


def _relabel(groups: list[HullGroup], edits: list[GroupEdit], label: str | None) -> dict[str, symbolic.Hull]:
    """The hulls of groups that an edit left whole (a merge of one), with the label that what is made would take."""
    if label is None:
        return {}
    whole = [g for g, edit in zip(groups, edits, strict=True) if not edit.removes and not edit.made]
    return {hull.name: hull.with_label(_label_of_new(hull, label)) for group in whole for hull in group.hulls}


def inheritance_notes(made: Iterable[NewShape], mesh: symbolic.SymbolicMesh) -> list[str]:
    """A sentence for each hull whose sources differ in contact attributes: it takes those of the largest."""
    known = {geom.name: dict(geom.contact) for geom in mesh.asset.geoms if geom.contact} if mesh.asset else {}
    return [note for one in made if known and (note := _inheritance_note(one, known))]


def _inheritance_note(made: NewShape, known: dict[str, dict[str, str]]) -> str | None:
    values = [known[name] for hull in made.sources if (name := hull.parent or hull.name) in known]
    names = dict.fromkeys(name for each in values for name in each)
    differing = [name for name in names if len({each.get(name) for each in values}) > 1]
    if not differing:
        return None
    return f"{join_names(differing)} as {made.heir.name} has it; the hulls beside it have another"


def describe_lost_gaps(
    mesh: symbolic.SymbolicMesh, selected_mask: int, made: Iterable[tuple[symbolic.Hull, NewShape]]
) -> str | None:
    """A sentence on the gaps to hulls beside a selection that made primitives narrow, by more than a tenth and by more
    than the contact distance; None where there is none."""
    beside = [hull for k, hull in enumerate(mesh.hulls) if not selected_mask >> k & 1]
    made = [(new, one) for new, one in made if new.primitive]
    if not beside or not made:
        return None
    lost, (low, high) = [], geometry.bounds([hull.aabb for hull in beside])
    for new, one in made:
        reach = new.aabb.diagonal  # a wider gap is no matter of this part
        apart = np.maximum(low - new.aabb.max, new.aabb.min - high).max(axis=1)
        near = [beside[k] for k in np.flatnonzero(apart < reach)]
        shapes = [new.shape, *(hull.shape for hull in one.sources), *(hull.shape for hull in near)]
        first = 1 + len(one.sources)
        pairs = geometry.close_pairs(shapes, reach, frozenset(range(first, len(shapes))))
        for k, hull in enumerate(near, first):
            was = min(pairs.get((source, k), reach) for source in range(1, first))
            now = pairs.get((0, k), reach)
            if was - now > max(was / 10, mesh.contact_distance):
                name = (new.keeps_name and new.parent) or new.name
                lost.append((was - now, was, now, name, hull.name))
    if not lost:
        return None
    _, was, now, name, other = max(lost)
    more = f" (and {len(lost) - 1} more)" if len(lost) > 1 else ""
    return f"the gap between {name} and {other} shrinks from {was:.3g} m to {now:.3g} m{more}"


def ensure_valid(shape: geometry.Shape, name: str, thickness: float) -> geometry.Shape:
    """The shape itself where it is sound, else the convex hull of its points, thickened to `thickness` [m].

    Raises GeometryError naming `name` where no sound shape can be made of it.
    """
    is_sound = geometry.find_fault(shape, _CONVEXITY) is None
    return shape if is_sound else geometry.convex_hull(shape.vertices, name=name, thicken=thickness)


@dataclass(frozen=True, slots=True)
class RuleTrace:
    """What one rule did on a mesh; rule: its number from 1; selected, made: names of hulls.

    sources: for each made hull, the names of the hulls it was made from; note: what a user should know.
    """

    rule: int
    selected: tuple[str, ...]
    made: tuple[str, ...] = ()
    note: str | None = None
    sources: tuple[tuple[str, ...], ...] = ()


def to_canonical_frame(
    mesh: symbolic.SymbolicMesh, orient: Orient | None, contact: float | None = None, memo: Memo = make_anew
) -> tuple[symbolic.SymbolicMesh, geometry.Pose]:
    """The mesh as the first rule sees it: oriented, with L fixed; and the pose oriented_T_incoming.

    contact: the program's epsilon, None keeps the mesh's.
    """
    staged, pose = memo(mesh, (orient, contact), tuple, lambda: _to_canonical_frame(mesh, orient, contact))
    return staged, pose


def _to_canonical_frame(
    mesh: symbolic.SymbolicMesh, orient: Orient | None, contact: float | None
) -> tuple[symbolic.SymbolicMesh, geometry.Pose]:
    oriented, pose = orient_mesh(mesh, orient)
    staged = replace(oriented, epsilon=mesh.epsilon if contact is None else contact, scale=oriented.diagonal)
    if oriented.known_graph is not None and staged.contact_distance == oriented.contact_distance:
        staged.set_known_graph(oriented.known_graph)  # the same shapes and reach
    return staged, pose


def from_canonical_frame(
    incoming: symbolic.SymbolicMesh, staged: symbolic.SymbolicMesh, pose: geometry.Pose
) -> symbolic.SymbolicMesh:
    """An edited mesh back in the frame it came in; pose: oriented_T_incoming. The inverse of `to_canonical_frame`."""
    back = pose.inverse()
    turned = not np.array_equal(pose.rotation, np.eye(3))
    hulls = tuple(_restore_hull(incoming, hull, back if turned else None) for hull in staged.hulls)
    same = incoming.scale is None and len(hulls) == len(incoming.hulls)
    if same and all(a is b for a, b in zip(hulls, incoming.hulls, strict=True)):
        return incoming
    return replace(incoming, hulls=hulls, scale=None)


def apply_rule(
    mesh: symbolic.SymbolicMesh,
    rule: Rule,
    templates: Mapping[str, Template] | None = None,
    extremity: float | None = None,
    used: frozenset[str] = frozenset(),
    memo: Memo = make_anew,
) -> tuple[tuple[str, ...], ActionResult]:
    """Names of the hulls that a rule selects in a staged mesh, and what its action makes of them."""
    mask = select_mask(rule.extractor, mesh, EXTREMITY if extremity is None else extremity)
    return mesh.names_of(mask), apply_to_selection(mesh, mask, rule, templates or {}, used, memo)


def apply_to_selection(
    mesh: symbolic.SymbolicMesh,
    mask: int,
    rule: Rule,
    templates: Mapping[str, Template],
    used: frozenset[str],
    memo: Memo = make_anew,
) -> ActionResult:
    """What the action of a rule makes of the hulls of a bit set, whatever its extractor selects."""

    def applied() -> ActionResult:
        return apply_action(mesh, mask, rule.action, templates, rule.label, used)

    wanted = rule.action.templates
    if not mask or any(name not in templates for name in wanted):  # nothing to do, or it fails
        return applied()
    made_of = tuple(templates[name].digest for name in wanted)
    return memo(mesh, (mask, rule.action, rule.label, used, made_of), ActionResult, applied)


def _restore_hull(incoming: symbolic.SymbolicMesh, hull: symbolic.Hull, back: geometry.Pose | None) -> symbolic.Hull:
    """A hull in the incoming frame: the original where it was kept, relabelled where the program did so."""
    if hull.name in incoming.index:
        original = incoming.hull_of(hull.name)
        return original if original.annotation == hull.annotation else original.with_label(hull.annotation)
    return hull.move(back) if back else hull
