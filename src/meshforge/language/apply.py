"""One action on one selection: the edited mesh, what was made of what, every new shape verified."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from meshforge.common import join_names
from meshforge.geometry import FLATNESS, Polytope, Shape, convex_hull, is_closed, is_convex, is_outward, spans_volume
from meshforge.language.actions.base import Action
from meshforge.language.actions.edit import GroupEdit, HullGroup, NewShape, Template, check_templates
from meshforge.language.syntax import reference_length
from meshforge.symbolic import Hull, Label, SymbolicMesh, bits_of

_NEW_SUFFIX = re.compile(r"~\d+$")

_CONVEXITY = 1e-7  # relative to the size


@dataclass(frozen=True, eq=False, slots=True)
class ActionResult:
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
) -> ActionResult:
    """Does an action to the hulls of a bit set, in the frame the mesh is in.

    label: for what is made, None takes over that of the largest hull; used: as of the `ActionResult` before, in a run
    of several. Kept hulls stay the same objects, made ones follow after them.
    Raises ProgramError for a missing template, GeometryError where no sound shape can be made.
    """
    templates = templates or {}
    check_templates(action.templates, templates)
    if not selected_mask:
        return ActionResult(mesh, note="nothing selected", used=used)
    groups = [_make_group(mesh, part, templates) for part in action.groups(mesh, selected_mask)]
    edits = [action.edit(group) for group in groups]
    taken = set(used | names_in_use(mesh))
    made = [
        (hull, m) for edit in edits for m in edit.made for hull in [_make_hull(m, label, taken, reference_length(mesh))]
    ]
    gone = {hull.name for group, edit in zip(groups, edits, strict=True) if edit.removes for hull in group.hulls}
    renamed = _relabel(groups, edits, label)
    kept = [renamed.get(hull.name, hull) for hull in mesh.hulls if hull.name not in gone]
    inherited = inheritance_notes((m for _, m in made), mesh)
    notes = dict.fromkeys([*(edit.note for edit in edits if edit.note), *inherited])
    changed = bool(made or gone or renamed)
    return ActionResult(
        mesh.with_hulls([*kept, *(hull for hull, _ in made)]) if changed else mesh,
        tuple(hull.name for hull, _ in made),
        "; ".join(notes) or None,
        tuple(tuple(source.name for source in m.sources) for _, m in made),
        frozenset(taken),
    )


def names_in_use(mesh: SymbolicMesh) -> frozenset[str]:
    """The names that a made hull must not take: those of the mesh and of the file it came from."""
    source = mesh.asset.geoms if mesh.asset else ()
    return frozenset([hull.name for hull in mesh.hulls] + [geom.name for geom in source])


def _make_group(mesh: SymbolicMesh, mask: int, templates: Mapping[str, Template]) -> HullGroup:
    return HullGroup(tuple(mesh.hulls[index] for index in sorted(bits_of(mask))), reference_length(mesh), templates)


def _make_hull(made: NewShape, label: str | None, taken: set[str], reference: float) -> Hull:
    """The hull of a made shape, verified and named; its name is added to those taken."""
    heir = made.heir
    shape = ensure_valid(made.shape, heir.name, FLATNESS * reference)
    stem = heir.name if heir.parent is None else _NEW_SUFFIX.sub("", heir.name)
    count = 1
    while f"{stem}~{count}" in taken:
        count += 1
    taken.add(f"{stem}~{count}")
    return Hull(f"{stem}~{count}", heir.body, shape, _label_of_new(heir, label), heir.parent or heir.name)


def _label_of_new(heir: Hull, label: str | None) -> Label | None:
    """The label of a made hull; one that the program sets is as sure as the program."""
    if label is not None:
        return Label(label, source="edit")
    known = heir.annotation
    return Label(known.name, known.confidence, "edit") if known else None


def _relabel(groups: list[HullGroup], edits: list[GroupEdit], label: str | None) -> dict[str, Hull]:
    """The hulls of groups that an edit left whole (a merge of one), with the label that what is made would take."""
    if label is None:
        return {}
    whole = [g for g, edit in zip(groups, edits, strict=True) if not edit.removes and not edit.made]
    return {hull.name: hull.with_label(_label_of_new(hull, label)) for group in whole for hull in group.hulls}


def inheritance_notes(made: Iterable[NewShape], mesh: SymbolicMesh) -> list[str]:
    """A sentence for each hull whose sources differ in contact attributes: it takes those of the largest."""
    known = {geom.name: dict(geom.contact) for geom in mesh.asset.geoms if geom.contact} if mesh.asset else {}
    return [note for one in made if known and (note := _inheritance_note(one, known))]


def _inheritance_note(made: NewShape, known: dict[str, dict[str, str]]) -> str | None:
    values = [known[name] for hull in made.sources if (name := hull.parent or hull.name) in known]
    names = dict.fromkeys(name for each in values for name in each)
    differing = [name for name in names if len({each.get(name) for each in values}) > 1]
    return (
        f"{join_names(differing)} as {made.heir.name} has it; the hulls beside it have another" if differing else None
    )


def ensure_valid(shape: Shape, name: str, thickness: float) -> Shape:
    """The shape itself where it is sound, else the convex hull of its points, thickened to `thickness` [m].

    Raises GeometryError naming `name` where no sound shape can be made of it.
    """
    return shape if is_valid(shape) else convex_hull(shape.vertices, name=name, thicken=thickness)


def is_valid(shape: Shape) -> bool:
    """Whether a shape is finite, closed, convex, and spans a volume."""
    with np.errstate(all="ignore"):
        vertices, volume = shape.vertices, shape.volume
    if not np.isfinite(vertices).all() or not (np.isfinite(volume) and volume > 0):
        return False
    return spans_volume(vertices) and (not isinstance(shape, Polytope) or _is_valid_polytope(shape))


def _is_valid_polytope(shape: Polytope) -> bool:
    vertices, faces = shape.vertices, shape.faces
    return is_closed(faces) and is_outward(vertices, faces) and is_convex(vertices, faces, _CONVEXITY)
