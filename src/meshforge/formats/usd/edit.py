"""Writing an edited USD file: the authored bytes where nothing changed, else its root layer with the edit, in which
bodies keep their masses."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

from meshforge.common import AssetError
from meshforge.formats import collision_pieces
from meshforge.formats.base import Mass, Output, note_renames
from meshforge.formats.libraries import pxr
from meshforge.formats.usd import colliders, edit_stage, prims, stage
from meshforge.formats.usd.mechanism import centre_of, moments_of, read_number
from meshforge.formats.usd.read import PrimCollision, read_collisions
from meshforge.geometry import Polytope, Shape, combine_inertias, inertia, is_closed
from meshforge.symbolic import Asset, Inertial

PACKAGE_SUFFIX = ".usdz"
LAYER_SUFFIXES = (".usd", ".usda", ".usdc")

LayerEdit = Callable[[stage.UsdStage, Any], tuple[list[str], dict[str, str]]]
"""Edits a copy of the root layer of a stage; returns notes, and what hulls read back as under another name."""

_COMMENTS = re.compile(
    r'"""(?:[^\\]|\\.)*?"""|"(?:[^"\\\n]|\\.)*"'
    r"|'''(?:[^\\]|\\.)*?'''|'(?:[^'\\\n]|\\.)*'"
    r"|@@@.*?@@@|@[^@\n]*@|(#[^\n]*|//[^\n]*|/\*.*?\*/)",
    re.S,
)
"""Finds comments outside of texts and references; of these nothing."""
_DENSITY = 1000.0  # [kg/m^3], where nothing says another one


def write_usd(asset: Asset, document: stage.UsdDocument, name: str, mass: Mass) -> Output:
    """The files of an asset that was read from a USD file; without an edit, its own bytes.

    Raises AssetError: a file changed since the asset was read, or the edit cannot be made in its root layer.
    """
    suffix = PurePosixPath(name).suffix.lower()
    edited = is_stage_edited(asset, document)
    if not edited and suffix == asset.path.suffix.lower():
        copies, far = _list_copies(asset)
        return Output(document.source, copies=copies, notes=tuple(far))

    def author(scene: stage.UsdStage, layer: Any) -> tuple[list[str], dict[str, str]]:
        bodies = colliders.StageBodies(scene, document.physics)
        sources = list(read_collisions(scene, bodies, document.physics, []))
        edit = edit_stage.UsdEdit(scene, bodies, document, layer)
        edit.run(asset, sources)
        notes = keep_masses(edit, sources) if mass == "keep" else []
        return [*notes, *edit.notes, *note_renames(edit.names)], edit.names

    return edit_root_layer(asset, document, PurePosixPath(name), author if edited else None)


def is_stage_edited(asset: Asset, document: stage.UsdDocument) -> bool:
    """Whether the hulls of an asset are not those of its stage."""
    return collision_pieces.is_edited(asset, (piece for element in document.authored for piece in element.names))


def edit_root_layer(asset: Asset, document: stage.UsdDocument, name: PurePosixPath, author: LayerEdit | None) -> Output:
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


def _layer_text(layer: Any, source: bytes, notes: list[str]) -> bytes:
    """A layer as text, as the library writes it: comments of an authored one are lost, with a note."""
    comments = [] if stage.is_crate(source) else [*filter(None, _COMMENTS.findall(source.decode("utf-8", "replace")))]
    if len(comments) > 1:  # the first is the line that says what the file is
        notes.append("comments in its text are lost: USD's library writes an edited layer anew")
    return stage.export_layer(layer, crate=False)


def _build_output(
    layer: Any,
    asset: Asset,
    document: stage.UsdDocument,
    name: PurePosixPath,
    copies: Mapping[str, Path],
    notes: list[str],
    names: dict[str, str],
) -> Output:
    suffix, was_package = name.suffix.lower(), asset.path.suffix.lower() == PACKAGE_SUFFIX
    inside = stage.unpack_usdz(document.source) if was_package else {}
    first = next(iter(inside), "")
    root = inside.pop(first) if first else document.source
    if suffix != PACKAGE_SUFFIX:
        crate = stage.is_crate_wanted(suffix, root)
        main = stage.export_layer(layer, crate=True) if crate else _layer_text(layer, root, notes)
        return Output(main, inside, dict(copies), tuple(notes), names)
    if not was_package:
        inside, first = _read_files_beside(copies, asset), f"{name.stem}.usdc"
    crate = stage.is_crate_wanted(PurePosixPath(first).suffix.lower(), root)
    main = stage.export_layer(layer, crate=True) if crate else _layer_text(layer, root, notes)
    package, beside = stage.pack_usdz({first: main, **inside}), dict(copies) if was_package else {}
    return Output(package, {}, beside, tuple(notes), names)


def _read_files_beside(copies: Mapping[str, Path], asset: Asset) -> dict[str, bytes]:
    for place in copies:
        if place.startswith(".."):
            raise AssetError(
                f"it refers to {place}, outside of its folder, which no package can hold",
                where=str(asset.path),
                remedy="Write another kind of USD file, or move that file.",
            )
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
        layers = [asset.path, *(file for file in asset.files if file.suffix.lower() in LAYER_SUFFIXES)]
        texts = [
            text for layer in layers for kind in pxr.UsdUtils.ExtractExternalReferences(str(layer)) for text in kind
        ]
    return frozenset(Path(os.path.normpath(text)) for text in texts if Path(text).is_absolute())


def keep_masses(edit: edit_stage.UsdEdit, sources: Sequence[PrimCollision]) -> list[str]:
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
            spec, space = pxr.Sdf.CreatePrimInLayer(edit.layer, path), prims.PrimSpace(*edit.scene.placement(prim))
            prims.write_mass(spec, found, space, edit.scene.metres, edit.scene.kilograms)
    return notes


def weigh(scene: stage.UsdStage, prim: Any, body: str, sources: Sequence[PrimCollision]) -> Inertial | None:
    """What a body weighs by all that its stage says, colliders included; None where a volume is not known."""
    pieces = [(source, _solids_of(source.parts)) for source in sources]
    solids = [(source, shapes) for source, shapes in pieces if shapes]
    if not solids or any(shapes is None for _, shapes in pieces):
        return None
    masses = [(shapes, _mass_of(scene, prim, source, shapes)) for source, shapes in solids]
    weights = [(mass, *inertia(shapes, mass)) for shapes, mass in masses]
    total, centre, summed = combine_inertias(weights, centre_of(scene, prim))
    authored_value, moments = read_number(scene, prim, "physics:mass"), moments_of(scene, prim)
    mass = authored_value * scene.kilograms if authored_value is not None and authored_value > 0 else total
    return Inertial(body, mass, centre, mass / total * summed if moments is None else moments)


def _solids_of(parts: Sequence[collision_pieces.CollisionPiece]) -> list[Shape] | None:
    """The solids of a prim's pieces, of closed non-convex ones too; None where one has no volume that is known."""
    found: list[Shape] = []
    for part in parts:
        if part.shape is not None:
            found.append(part.shape)
        elif part.surface is not None and len(part.surface.faces) and is_closed(part.surface.faces):
            found.append(Polytope(part.surface.vertices, part.surface.faces))
        else:
            return None
    return found if all(shape.volume > 0 for shape in found) else None


def _mass_of(scene: stage.UsdStage, body: Any, source: PrimCollision, shapes: Sequence[Shape]) -> float:
    """The mass [kg] of a collider: its own, else by density, its own, its body's or its material's."""
    volume = sum(shape.volume for shape in shapes)
    own = read_number(scene, source.prim, "physics:mass") if source.prim != body else None
    if own is not None and own > 0:
        return own * scene.kilograms
    material = colliders.physics_material(source.prim)
    for prim in (source.prim, body, *([material] if material else [])):
        density = read_number(scene, prim, "physics:density")
        if density is not None and density > 0:
            return volume * density * scene.kilograms / scene.metres**3
    return volume * _DENSITY
