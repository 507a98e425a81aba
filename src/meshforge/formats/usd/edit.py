"""Writing an edited USD file: its bytes where nothing changed, else the edited root layer, masses of bodies kept."""

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

from meshforge.common import AssetError
from meshforge.formats import collision_pieces
from meshforge.formats.base import Mass, Output, note_renames, nothing_collides_error
from meshforge.formats.libraries import pxr
from meshforge.formats.usd import colliders, prims, stage
from meshforge.formats.usd.edit_stage import ColliderEdit, HullEdit
from meshforge.formats.usd.mechanism import centre_of, moments_of, read_number, weigh
from meshforge.formats.usd.read import read_collisions
from meshforge.symbolic import Asset, Geom, NonConvexPiece

LayerAuthor = Callable[[stage.UsdStage, Any], tuple[list[str], dict[str, str]]]
"""Edits a copy of the root layer of a stage; returns notes, and what hulls read back as under another name."""


def write_usd(asset: Asset, document: stage.UsdDocument, name: str, mass: Mass) -> Output:
    """Return the files of an asset that was read from a USD file; without an edit, its own bytes.

    Raises AssetError: a file changed since the asset was read, or the edit cannot be made in its root layer.
    """
    suffix = PurePosixPath(name).suffix.lower()
    edited = document.is_edited(asset)
    if not edited and suffix == asset.path.suffix.lower():
        copies, far = _list_copies(asset)
        return Output(document.source, copies=copies, notes=tuple(far))

    def author(scene: stage.UsdStage, layer: Any) -> tuple[list[str], dict[str, str]]:
        bodies = colliders.StageBodies(scene, document.physics)
        sources = list(read_collisions(scene, bodies, document.physics, []))
        edit = HullEdit(scene, layer, document, bodies)
        edit.run(asset, sources)
        notes = _keep_masses(edit, sources) if mass == "keep" else []
        return [*notes, *edit.notes, *note_renames(edit.names)], edit.names

    return _edit_root_layer(asset, document, PurePosixPath(name), author if edited else None)


def add_usd_colliders(asset: Asset, document: stage.UsdDocument, name: str) -> Output:
    """Return the files of a stage with the hulls of an asset beside it, hidden and marked by UsdPhysics.

    Raises AssetError: a file changed since the asset was read, or there is no hull to write.
    """

    def author(scene: stage.UsdStage, layer: Any) -> tuple[list[str], dict[str, str]]:
        edit = ColliderEdit(scene, layer, document)
        pieces: list[Geom | NonConvexPiece] = [*asset.geoms, *asset.non_convex]
        for piece in pieces:
            edit.add(piece)
        if not edit.count:
            raise nothing_collides_error(asset)
        return edit.notes, {}

    return _edit_root_layer(asset, document, PurePosixPath(name), author)


def _edit_root_layer(
    asset: Asset, document: stage.UsdDocument, name: PurePosixPath, author: LayerAuthor | None
) -> Output:
    """The files of a stage with an edit of a copy of its root layer; without one, the same in the form of a name.

    Raises AssetError: a file changed since the asset was read.
    """
    copies, far = _list_copies(asset)
    collision_pieces.refuse_changed_files(document.digests, str(asset.path))
    if not asset.path.is_file() or asset.path.read_bytes() != document.source:
        raise collision_pieces.change_error(asset.path.name, str(asset.path))
    with stage.usd(str(asset.path)):
        scene = stage.UsdStage.open(asset.path)
        layer = pxr.Sdf.Layer.CreateAnonymous(".usda")
        layer.TransferContent(scene.stage.GetRootLayer())
        notes, names = author(scene, layer) if author else ([], {})
        return _build_output(layer, asset, document, name, copies, [*far, *notes], names)


def _build_output(
    layer: Any,
    asset: Asset,
    document: stage.UsdDocument,
    name: PurePosixPath,
    copies: Mapping[str, Path],
    notes: list[str],
    names: dict[str, str],
) -> Output:
    suffix, was_package = name.suffix.lower(), asset.path.suffix.lower() == stage.PACKAGE_SUFFIX
    inside = stage.unpack_usdz(document.source) if was_package else {}
    first = next(iter(inside), f"{name.stem}.usdc")
    root, is_package = inside.pop(first, document.source), suffix == stage.PACKAGE_SUFFIX
    if is_package and not was_package:
        inside = _read_files_beside(copies, asset)
    crate = stage.is_crate_wanted(PurePosixPath(first).suffix.lower() if is_package else suffix, root)
    main = stage.export_layer(layer, crate=crate)
    is_text = not crate and not stage.is_crate(root)
    if is_text and sum(b"#" in line for line in root.splitlines()) > 1:  # the first names the format
        notes.append("comments in its text are lost, if there are any: USD's library writes an edited layer anew")
    if not is_package:
        return Output(main, inside, dict(copies), tuple(notes), names)
    package = stage.pack_usdz({first: main, **inside})
    return Output(package, {}, dict(copies) if was_package else {}, tuple(notes), names)


def _read_files_beside(copies: Mapping[str, Path], asset: Asset) -> dict[str, bytes]:
    for place in copies:
        if place.startswith(".."):
            problem = f"it refers to {place}, outside of its folder, which no package can hold"
            remedy = "Write another kind of USD file, or move that file."
            raise AssetError(problem, where=str(asset.path), remedy=remedy)
    return {place: path.read_bytes() for place, path in copies.items()}


def _list_copies(asset: Asset) -> tuple[dict[str, Path], list[str]]:
    """The files that go along, by their place beside the main one; notes on those that stay where they are."""
    folder = Path(os.path.normpath(asset.path.absolute())).parent
    copies: dict[str, Path] = {}
    notes: list[str] = []
    outside = [file for file in asset.files if not file.is_relative_to(folder)]
    absolute = _find_absolute_references(asset) if outside else frozenset()
    for file in asset.files:
        if file in absolute:
            notes.append(f"{file.name} is referred to by an absolute path: it is used where it is, not copied")
        else:
            copies[Path(os.path.relpath(file, folder)).as_posix()] = file
    return copies, notes


def _find_absolute_references(asset: Asset) -> frozenset[Path]:
    with stage.usd(str(asset.path)):
        files = [asset.path, *(file for file in asset.files if file.suffix.lower() in stage.LAYER_SUFFIXES)]
        texts = [text for file in files for kind in pxr.UsdUtils.ExtractExternalReferences(str(file)) for text in kind]
    return frozenset(Path(os.path.normpath(text)) for text in texts if Path(text).is_absolute())


def _keep_masses(edit: HullEdit, sources: Sequence[colliders.PrimCollision]) -> list[str]:
    """Author the masses of the bodies that an edit changed, where they came from colliders; notes on those unknown."""
    notes = []
    for path, name in edit.bodies.names.items():
        prim = edit.bodies.prims[path]
        if name not in edit.changed:
            continue
        own = read_number(edit.scene, prim, "physics:mass") or 0.0
        if own > 0 and centre_of(edit.scene, prim) is not None and moments_of(edit.scene, prim) is not None:
            continue  # it says all of its mass itself
        found = weigh(edit.scene, prim, name, [source for source in sources if source.body == name])
        if found is None:
            notes.append(f"the mass of {name!r} is left to its colliders: of one of them the volume is not known")
        else:
            space = prims.PrimSpace.of(edit.scene, prim)
            prims.write_mass(edit.spec_of(prim), found, space, edit.scene.metres, edit.scene.kilograms)
    return notes
