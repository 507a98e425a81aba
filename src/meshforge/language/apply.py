"""One action on one selection: the edited mesh, and what was made of what."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from meshforge.geometry import FLATNESS
from meshforge.language.actions import Action, Edit, Group, Made
from meshforge.language.evaluate import length
from meshforge.language.inheritance import inheritance_notes
from meshforge.language.sound import sound
from meshforge.language.template import Template, check_templates
from meshforge.symbolic import Hull, Label, SymbolicMesh, bits

_MADE = re.compile(r"~\d+$")


@dataclass(frozen=True, eq=False, slots=True)
class Applied:
    """The outcome of one action.

    made: names of the made hulls; sources: for each of them, the names of the hulls it was made from.
    note: what a user should know; used: names that no later edit of the same run may give again.
    """

    mesh: SymbolicMesh
    made: tuple[str, ...] = ()
    note: str | None = None
    sources: tuple[tuple[str, ...], ...] = ()
    used: frozenset[str] = frozenset()


def apply_action(
    mesh: SymbolicMesh,
    selected_mask: int,
    action: Action,
    templates: Mapping[str, Template] | None = None,
    label: str | None = None,
    used: frozenset[str] = frozenset(),
) -> Applied:
    """Does an action to the hulls of a bit set, in the frame the mesh is in.

    label: for what is made, None takes over that of the largest hull; used: as of the `Applied` before, in a run
    of several. Kept hulls stay the same objects, made ones follow after them.
    Raises ProgramError for a missing template, GeometryError where no sound shape can be made.
    """
    templates = templates or {}
    check_templates(action.templates, templates)
    if not selected_mask:
        return Applied(mesh, note="nothing selected", used=used)
    groups = [_group(mesh, part, templates) for part in action.groups(mesh, selected_mask)]
    edits = [action.edit(group) for group in groups]
    taken = set(used | used_names(mesh))
    made = [(hull, m) for edit in edits for m in edit.made for hull in [_born(m, label, taken, length(mesh))]]
    gone = {hull.name for group, edit in zip(groups, edits, strict=True) if edit.removes for hull in group.hulls}
    renamed = _relabelled(groups, edits, label)
    kept = [renamed.get(hull.name, hull) for hull in mesh.hulls if hull.name not in gone]
    inherited = inheritance_notes((m for _, m in made), mesh)
    notes = dict.fromkeys([*(edit.note for edit in edits if edit.note), *inherited])
    changed = bool(made or gone or renamed)
    return Applied(
        mesh.with_hulls([*kept, *(hull for hull, _ in made)]) if changed else mesh,
        tuple(hull.name for hull, _ in made),
        "; ".join(notes) or None,
        tuple(tuple(source.name for source in m.sources) for _, m in made),
        frozenset(taken),
    )


def used_names(mesh: SymbolicMesh) -> frozenset[str]:
    """The names that a made hull must not take: those of the mesh and of the file it came from."""
    source = mesh.asset.geoms if mesh.asset else ()
    return frozenset([hull.name for hull in mesh.hulls] + [geom.name for geom in source])


def _group(mesh: SymbolicMesh, mask: int, templates: Mapping[str, Template]) -> Group:
    return Group(tuple(mesh.hulls[index] for index in sorted(bits(mask))), length(mesh), templates)


def _born(made: Made, label: str | None, taken: set[str], reference: float) -> Hull:
    """The hull of a made shape, verified and named; its name is added to those taken."""
    heir = made.heir
    shape = sound(made.shape, heir.name, FLATNESS * reference)
    stem = heir.name if heir.parent is None else _MADE.sub("", heir.name)
    count = 1
    while f"{stem}~{count}" in taken:
        count += 1
    taken.add(f"{stem}~{count}")
    return Hull(f"{stem}~{count}", heir.body, shape, _annotation(heir, label), heir.parent or heir.name)


def _annotation(heir: Hull, label: str | None) -> Label | None:
    """The label of a made hull; one that the program sets is as sure as the program."""
    if label is not None:
        return Label(label, source="edit")
    known = heir.annotation
    return Label(known.name, known.confidence, "edit") if known else None


def _relabelled(groups: list[Group], edits: list[Edit], label: str | None) -> dict[str, Hull]:
    """The hulls of groups that an edit left whole (a merge of one), with the label that what is made would take."""
    if label is None:
        return {}
    whole = [g for g, edit in zip(groups, edits, strict=True) if not edit.removes and not edit.made]
    return {hull.name: hull.with_label(_annotation(hull, label)) for group in whole for hull in group.hulls}
