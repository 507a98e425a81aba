"""Writing an edited USD file: the authored bytes where nothing changed, else its root layer with the edit."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path, PurePosixPath
from typing import Any

from meshforge.asset import Asset
from meshforge.errors import AssetError
from meshforge.formats.base import Mass, Output
from meshforge.formats.collision_meshes import digest_of
from meshforge.formats.plain.parts import renaming
from meshforge.formats.usd.document import UsdDocument
from meshforge.formats.usd.library import usd
from meshforge.formats.usd.reading.bodies import Bodies
from meshforge.formats.usd.reading.read import sources_of
from meshforge.formats.usd.reading.stage import Scene
from meshforge.formats.usd.text import has_comments, patched
from meshforge.formats.usd.writing.bytes import is_crate, layer_bytes, wants_crate
from meshforge.formats.usd.writing.edit import Edit
from meshforge.formats.usd.writing.masses import keep_masses
from meshforge.formats.usd.writing.package import packed, unpacked

PACKAGE = ".usdz"
LAYERS = (".usd", ".usda", ".usdc")


def write_usd(asset: Asset, document: UsdDocument, name: str, mass: Mass) -> Output:
    """The files of an asset that was read from a USD file; without an edit, its own bytes.

    Raises AssetError: a file changed since the asset was read, or the edit cannot be told in its root layer.
    """
    suffix = PurePosixPath(name).suffix.lower()
    kept = {geom.name for geom in asset.geoms if geom.parent is None} | {piece.name for piece in asset.opaque}
    known = {piece for element in document.authored for piece in element.names}
    edited = not known <= kept or any(g.parent is not None or g.name not in known for g in asset.geoms)
    copies, far = _copies(asset)
    if not edited and suffix == asset.path.suffix.lower():
        return Output(document.source, copies=copies, notes=tuple(far))
    _refuse_changed(asset, document)
    with usd(str(asset.path)):
        from pxr import Sdf

        scene = Scene.open(asset.path)
        layer = Sdf.Layer.CreateAnonymous(".usda")
        layer.TransferContent(scene.stage.GetRootLayer())
        notes, names = list(far), dict[str, str]()
        if edited:
            bodies = Bodies(scene, document.physics)
            sources = list(sources_of(scene, bodies, document.physics, []))
            edit = Edit(scene, bodies, document, layer)
            edit.run(asset, sources)
            if mass == "keep":
                notes += keep_masses(edit, sources)
            notes += [*edit.notes, *renaming(edit.names)]
            names = edit.names
        return _output(layer, scene.stage.GetRootLayer(), asset, document, name, copies, notes, names)


def _text(layer: Any, original: Any, source: bytes, notes: list[str]) -> bytes:
    """A layer as text: the authored one with the edit where that can be done, else as the library writes it."""
    from pxr import Sdf, Tf

    after = layer.ExportToString()
    if is_crate(source):
        return bytes(after.encode())
    text = source.decode("utf-8", "replace")
    made = patched(text, original.ExportToString(), after)
    if made is not None and "\ufffd" not in text:
        check = Sdf.Layer.CreateAnonymous(".usda")
        try:
            if check.ImportFromString(made) and check.ExportToString() == after:
                return made.encode()
        except Tf.ErrorException:
            pass
    if has_comments(text):
        notes.append("comments in its text are not kept")
    return bytes(after.encode())


def _output(
    layer: Any,
    original: Any,
    asset: Asset,
    document: UsdDocument,
    name: str,
    copies: Mapping[str, Path],
    notes: list[str],
    names: dict[str, str],
) -> Output:
    """The files of an edited root layer, in the form that a name asks for."""
    suffix, was_package = PurePosixPath(name).suffix.lower(), asset.path.suffix.lower() == PACKAGE
    inside = unpacked(document.source) if was_package else {}
    first = next(iter(inside), "")
    root = inside.pop(first) if first else document.source
    if suffix != PACKAGE:
        crate = wants_crate(suffix, root)
        main = layer_bytes(layer, crate=True) if crate else _text(layer, original, root, notes)
        return Output(main, inside, dict(copies), tuple(notes), names)
    if not was_package:
        inside, first = _beside(copies, asset), f"{PurePosixPath(name).stem}.usdc"
    crate = wants_crate(PurePosixPath(first).suffix.lower(), root)
    main = layer_bytes(layer, crate=True) if crate else _text(layer, original, root, notes)
    return Output(packed({first: main, **inside}), {}, dict(copies) if was_package else {}, tuple(notes), names)


def _beside(copies: Mapping[str, Path], asset: Asset) -> dict[str, bytes]:
    """The files that go into a package. Raises AssetError: one lies outside of the folder."""
    for place in copies:
        if place.startswith(".."):
            raise AssetError(
                f"it refers to {place}, outside of its folder, which no package can hold",
                where=str(asset.path),
                remedy="Write another kind of USD file, or move that file.",
            )
    return {place: path.read_bytes() for place, path in copies.items()}


def _copies(asset: Asset) -> tuple[dict[str, Path], list[str]]:
    """The files that go along, by their place beside the main one; notes on those that stay where they are."""
    folder = Path(os.path.normpath(asset.path.absolute())).parent
    copies: dict[str, Path] = {}
    notes: list[str] = []
    outside = [file for file in asset.files if not file.is_relative_to(folder)]
    absolute = _absolute(asset) if outside else frozenset()
    for file in asset.files:
        if file in absolute:
            notes.append(f"{file.name} is referred to by an absolute path: it is used where it is, not copied")
        else:
            copies[Path(os.path.relpath(file, folder)).as_posix()] = file
    return copies, notes


def _absolute(asset: Asset) -> frozenset[Path]:
    """The files that the layers of an asset refer to by absolute paths."""
    with usd(str(asset.path)):
        from pxr import UsdUtils

        layers = [asset.path, *(file for file in asset.files if file.suffix.lower() in LAYERS)]
        texts = [text for layer in layers for kind in UsdUtils.ExtractExternalReferences(str(layer)) for text in kind]
    return frozenset(Path(os.path.normpath(text)) for text in texts if Path(text).is_absolute())


def _refuse_changed(asset: Asset, document: UsdDocument) -> None:
    for path, digest in document.digests:
        if not path.is_file() or digest_of(path) != digest:
            raise _changed(path, asset)
    if not asset.path.is_file() or asset.path.read_bytes() != document.source:
        raise _changed(asset.path, asset)


def _changed(path: Path, asset: Asset) -> AssetError:
    return AssetError(
        f"{path.name} has changed since the asset was read", where=str(asset.path), remedy="Read the asset again."
    )
