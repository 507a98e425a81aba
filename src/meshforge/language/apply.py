"""One action on one selection, every new shape verified."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from meshforge import geometry
from meshforge.common import Plugin, blame, join_names
from meshforge.language.actions.base import Action
from meshforge.language.actions.edit import GroupEdit, HullGroup, NewShape, Template, check_templates
from meshforge.language.actions.misfit import Misfit, describe_misfits, find_misfits
from meshforge.language.hull_table import reference_length
from meshforge.symbolic import Hull, Label, SymbolicMesh, bits_of

_NEW_SUFFIX = re.compile(r"~\d+$")
_CONVEXITY = 1e-7  # relative to the size


@dataclass(frozen=True, eq=False, slots=True)
class ActionResult:
    """The outcome of one action.

    mesh: None where it stayed the same; made: names of the made hulls; sources: for each of them, the names of the
    hulls it was made from; note: what a user should know; used: names that no later edit may give again; misfits: of
    made primitives.
    """

    mesh: SymbolicMesh | None
    made: tuple[str, ...] = ()
    note: str | None = None
    sources: tuple[tuple[str, ...], ...] = ()
    used: frozenset[str] = frozenset()
    misfits: tuple[Misfit, ...] = ()


def apply_action(
    mesh: SymbolicMesh,
    selected_mask: int,
    action: Action,
    templates: Mapping[str, Template] | None = None,
    label: str | None = None,
    used: frozenset[str] = frozenset(),
) -> ActionResult:
    """Do an action to the hulls of a bit set, in the frame the mesh is in.

    label: for what is made, None takes over that of the largest hull; used: in a run of several actions, the names
    that the result before has. Kept hulls stay the same objects, made ones follow after them.
    Raises ProgramError for a missing template, GeometryError where no sound shape can be made, PluginError for what a
    plug-in does wrong.
    """
    templates = templates or {}
    check_templates(action.templates, templates)
    if not selected_mask:
        return ActionResult(None, note="nothing selected", used=used)
    plugin = action.plugin
    with blame(plugin):
        groups = [
            HullGroup(tuple(mesh.hulls[index] for index in sorted(bits_of(part))), mesh, templates)
            for part in action.groups(mesh, selected_mask)
        ]
        edits = [action.edit(group) for group in groups]
        if plugin:
            _verify_edits(plugin, groups, edits)
    source = mesh.asset.geoms if mesh.asset else ()
    taken = {*used, *(hull.name for hull in mesh.hulls), *(geom.name for geom in source)}
    made = [
        (_make_hull(m, label, taken, reference_length(mesh), is_alone=edit.replaces_one(m)), m)
        for edit in edits
        for m in edit.made
    ]
    gone = {hull.name for group, edit in zip(groups, edits, strict=True) if edit.removes for hull in group.hulls}
    renamed = _relabel(groups, edits, label)
    kept = [renamed.get(hull.name, hull) for hull in mesh.hulls if hull.name not in gone]
    notes = [action.note_on(mesh, selected_mask), *(edit.note for edit in edits)]
    misfits = find_misfits(mesh, selected_mask, made)
    notes += [*inheritance_notes((m for _, m in made), mesh), *describe_misfits(misfits)]
    return ActionResult(
        mesh.with_hulls([*kept, *(hull for hull, _ in made)]) if made or gone or renamed else None,
        tuple(hull.name for hull, _ in made),
        "; ".join(dict.fromkeys(note for note in notes if note)) or None,
        tuple(tuple(source.name for source in m.sources) for _, m in made),
        frozenset(taken),
        misfits,
    )


def _verify_edits(plugin: Plugin, groups: list[HullGroup], edits: list[GroupEdit]) -> None:
    """Raise PluginError for what a plug-in must not make of hulls: what is built in is trusted."""
    for group, edit in zip(groups, edits, strict=True):
        for made in edit.made:
            fault = geometry.find_fault(made.shape)
            if fault:
                what = f"made a hull of {join_names([hull.name for hull in made.sources], 3)} that"
                raise plugin.error(f"{what} {geometry.describe_fault(fault)}")
            if not {made.main_source.name, *(one.name for one in made.sources)} <= {one.name for one in group.hulls}:
                raise plugin.error("named hulls that it was not given as the sources of one that it made")


def _make_hull(made: NewShape, label: str | None, taken: set[str], reference: float, *, is_alone: bool) -> Hull:
    """The hull of a made shape, verified and named; its name is added to those taken."""
    main_source = made.main_source
    shape = ensure_valid(made.shape, main_source.name, geometry.FLATNESS * reference)
    stem = main_source.name if main_source.parent is None else _NEW_SUFFIX.sub("", main_source.name)
    count = 1
    while f"{stem}~{count}" in taken:
        count += 1
    taken.add(f"{stem}~{count}")
    keeps_name = is_alone and (main_source.parent is None or main_source.keeps_name)
    return Hull(
        f"{stem}~{count}",
        main_source.body,
        shape,
        _label_of_new(main_source, label),
        main_source.parent or main_source.name,
        keeps_name,
    )


def _label_of_new(main_source: Hull, label: str | None) -> Label | None:
    """The label of a made hull; one that the program sets is as sure as the program."""
    if label is not None:
        return Label(label, source="edit")
    known = main_source.annotation
    return Label(known.name, known.confidence, "edit") if known else None


def _relabel(groups: list[HullGroup], edits: list[GroupEdit], label: str | None) -> dict[str, Hull]:
    """The hulls of groups that an edit left whole (a merge of one), with the label that what is made would take."""
    if label is None:
        return {}
    whole = [g for g, edit in zip(groups, edits, strict=True) if edit.fits and not edit.removes and not edit.made]
    return {hull.name: hull.with_label(_label_of_new(hull, label)) for group in whole for hull in group.hulls}


def inheritance_notes(made: Iterable[NewShape], mesh: SymbolicMesh) -> list[str]:
    """Return a sentence for each hull whose sources differ in contact attributes: it takes those of the largest."""
    known = {geom.name: dict(geom.contact) for geom in mesh.asset.geoms if geom.contact} if mesh.asset else {}
    return [note for one in made if known and (note := _inheritance_note(one, known))]


def _inheritance_note(made: NewShape, known: dict[str, dict[str, str]]) -> str | None:
    values = [known[name] for hull in made.sources if (name := hull.parent or hull.name) in known]
    names = dict.fromkeys(name for each in values for name in each)
    differing = [name for name in names if len({each.get(name) for each in values}) > 1]
    if not differing:
        return None
    return f"{join_names(differing)} as {made.main_source.name} has it; the hulls beside it have another"


def ensure_valid(shape: geometry.Shape, name: str, thickness: float) -> geometry.Shape:
    """Return the shape itself where it is sound, else the convex hull of its points, thickened to `thickness` [m].

    Raises GeometryError naming `name` where no sound shape can be made of it.
    """
    is_sound = geometry.find_fault(shape, _CONVEXITY) is None
    return shape if is_sound else geometry.convex_hull(shape.vertices, name=name, thicken=thickness)
