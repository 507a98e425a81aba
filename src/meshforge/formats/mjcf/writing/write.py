"""Writing an edited MJCF: the authored files with other geoms, all else byte for byte as it was."""

from __future__ import annotations

from pathlib import Path

from meshforge.asset import Asset
from meshforge.errors import AssetError
from meshforge.formats.base import Mass, Output
from meshforge.formats.mjcf.document import MjcfDocument
from meshforge.formats.mjcf.files.sources import Tree
from meshforge.formats.mjcf.reading.model import Reading
from meshforge.formats.mjcf.writing.compiling import again, part, plain, whole
from meshforge.formats.mjcf.writing.context import Context
from meshforge.formats.mjcf.writing.copies import copied, places
from meshforge.formats.mjcf.writing.edit import Edit
from meshforge.formats.mjcf.writing.hull_meshes import HullMeshes
from meshforge.formats.mjcf.writing.kept_masses import always_from_geoms
from meshforge.formats.mjcf.writing.made import Maker
from meshforge.formats.mjcf.writing.places import is_edited
from meshforge.formats.mjcf.writing.plan import Plan
from meshforge.formats.mjcf.writing.same import difference
from meshforge.words import listed


def write_mjcf(asset: Asset, document: MjcfDocument, name: str, mass: Mass) -> Output:
    """The files of an asset that was read from an MJCF; without an edit, their own bytes.

    MuJoCo compiles what is written, and finds what it found before but for the edited geoms.
    Raises AssetError: a hull that cannot be removed or made, a reference to a geom that goes, a file that MuJoCo
    refuses.
    """
    tree = document.tree
    copies, notes = copied(asset, tree)
    if not is_edited(asset, document):
        return _output(tree, [source.raw for source in tree.sources], {}, copies, notes, {})
    before = whole(tree) if document.refusal else again(tree, is_whole=True)
    is_whole = before is not None
    before = before or part(tree)
    authored = plain(tree, before) if is_whole else before
    context = Context(tree)
    meshes = HullMeshes(asset, context, Path(name).stem)
    plan = Plan(asset, document, before, authored, Maker(context, meshes))
    edit = Edit(plan, meshes, authored, is_whole)
    if mass == "keep":
        edit.keep_masses()
        if edit.weighs and always_from_geoms(tree):
            bodies = listed([authored.body_names[k] for k in edit.weighs], 3)
            notes.append(f"inertiafromgeom is 'auto' now, so that <inertial> keeps the masses of {bodies}")
    names = _checked(edit, before, mass)
    return _output(tree, edit.build_texts(), meshes.files.made, copies, notes, names)


def _checked(edit: Edit, before: Reading, mass: Mass) -> dict[str, str]:
    """The names that hulls cannot have.

    Raises AssetError where MuJoCo refuses the edited file, or finds in it what the edit does not say.
    """
    try:
        after, names = edit.name_geoms()
        if mass == "recompute":  # a free body may stand on its centre of mass
            before, after = edit.authored, edit.read_back_unscaled()
    except AssetError as error:
        remedy = "Keep the masses (--mass keep)." if mass == "recompute" else error.remedy
        raise AssetError(
            f"of the edited file: {error.problem}", where=str(edit.tree.main.path), remedy=remedy
        ) from None
    wrong = difference(before, after, edit.expected, masses=mass == "keep", is_whole=edit.is_whole)
    if wrong is not None:
        raise AssetError(
            f"the edited file would differ from the authored one in more than the edit says: {wrong}",
            where=str(edit.tree.main.path),
            remedy="This is a fault of MeshForge; please report it. Nothing was written.",
        )
    return names


def _output(
    tree: Tree,
    texts: list[bytes],
    made: dict[str, bytes],
    copies: dict[str, Path],
    notes: list[str],
    names: dict[str, str],
) -> Output:
    """The output of all files; the included ones go where they were, from the main one."""
    included = zip(places(tree)[1:], texts[1:], tree.sources[1:], strict=True)
    files = dict(made)
    for place, text, source in included:
        if place is None:
            notes.append(f"{source.reference!r} is an absolute reference: the file is used where it is, not copied")
        else:
            files[place] = text
    return Output(texts[0], files, copies, tuple(notes), names)
