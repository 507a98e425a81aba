"""Writing an edited USD file: its bytes where nothing changed, else the edited root layer, masses of bodies kept; and a
new stage of an asset of another format: a prim for each body, below it its hulls and what it shows."""

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np

from meshforge.common import AssetError, join_names, pluralize
from meshforge.formats import collision_pieces
from meshforge.formats.base import Loss, Mass, Output, note_renames, nothing_collides_error
from meshforge.formats.kinematic_tree import BodyTree
from meshforge.formats.libraries import pxr
from meshforge.formats.usd import colliders, prims, stage
from meshforge.formats.usd.edit_stage import ColliderEdit, HullEdit
from meshforge.formats.usd.mechanism import centre_of, moments_of, read_number, weigh
from meshforge.formats.usd.read import read_collisions
from meshforge.formats.visuals import linear_color, read_visual_surfaces
from meshforge.geometry import Pose
from meshforge.symbolic import Asset, FeatureKind, Geom, NonConvexPiece

_ROOT = prims.PrimSpace(np.eye(3), np.zeros(3))
_WORLDS = (stage.BODY, "world")

LayerAuthor = Callable[[stage.UsdStage, Any], tuple[list[str], dict[str, str]]]
"""Edits a copy of the root layer of a stage; returns notes, and what hulls read back as under another name."""


def write_usd(asset: Asset, document: stage.UsdDocument, name: str, mass: Mass) -> Output:
    """Return the files of an asset that was read from a USD file; without an edit, its own bytes.

    Raises AssetError: a file changed since the asset was read, or the edit cannot be made in its root layer.
    """
    suffix = PurePosixPath(name).suffix.lower()
    edited, pairs = document.is_edited(asset), asset.mechanism.added
    if not edited and not pairs and suffix == asset.path.suffix.lower():
        copies, far = _list_copies(asset)
        return Output(document.source, copies=copies, notes=tuple(far))

    def author(scene: stage.UsdStage, layer: Any) -> tuple[list[str], dict[str, str]]:
        bodies = colliders.StageBodies(scene, document.physics)
        edit, sources = HullEdit(scene, layer, document, bodies), list[colliders.PrimCollision]()
        if edited:
            sources = list(read_collisions(scene, bodies, document.physics, []))
            edit.run(asset, sources)
        own = {name: bodies.prims[path] for path, name in bodies.names.items()}
        for one, other in pairs:
            if not own.keys() >= {one, other}:
                raise AssetError(f"{one}:{other}: USD filters pairs of rigid bodies", where=str(asset.path))
            prims.filter_pair(edit.spec_of(own[one]), own[other].GetPath())
        notes = _keep_masses(edit, sources) if mass == "keep" else []
        return [*notes, *edit.notes, *note_renames(edit.names)], edit.names

    return _edit_root(asset, document, PurePosixPath(name), author if edited or pairs else None)


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

    return _edit_root(asset, document, PurePosixPath(name), author)


def _edit_root(asset: Asset, document: stage.UsdDocument, name: PurePosixPath, author: LayerAuthor | None) -> Output:
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


def create_usd(asset: Asset, name: str) -> Output:
    """Return the files of an asset that came from another format.

    Bodies become rigid bodies side by side, hulls native shapes or convex meshes below them, in metres with Z up; what
    is part of the world collides without one. Hulls are hidden, unless the asset shows nothing else. They have their
    labels, and what is shown those of all hulls of its body.
    """
    with stage.usd(name):
        return _Creator(asset, PurePosixPath(name)).build_output()


class _Creator:
    def __init__(self, asset: Asset, name: PurePosixPath) -> None:
        self.asset, self.name = asset, name
        weights = {inertial.body for inertial in asset.mechanism.inertials}
        fixed = {root for root in BodyTree.of(asset).roots if root in _WORLDS and root not in weights}
        self.poses = {body.name: body.pose for body in asset.bodies if body.name not in fixed}
        self.layer = pxr.Sdf.Layer.CreateAnonymous(".usda")
        self.root = prims.add_prim(self.layer.pseudoRoot, prims.prim_name(name.stem), "Xform")
        self.bodies: dict[str, Any] = {}
        self.names: dict[str, str] = {}
        self.drawn = not len(asset.visuals)

    def build_output(self) -> Output:
        self.layer.defaultPrim = self.root.name
        for key, value in (("metersPerUnit", 1.0), ("kilogramsPerUnit", 1.0), ("upAxis", "Z")):
            self.layer.pseudoRoot.SetInfo(key, value)
        for body, pose in self.poses.items():
            self._add_body(body, pose)
        for geom in self.asset.geoms:
            self._add_hull(geom)
        for piece in self.asset.non_convex:
            self._add_non_convex(piece)
        lost = self._add_visuals()
        for one, other in self.asset.mechanism.apart:
            if self.bodies.keys() >= {one, other}:
                prims.filter_pair(self.bodies[one], self.bodies[other].path)
            else:
                why = "USD filters pairs of bodies that can move"
                lost.append(Loss(FeatureKind.PAIRS, (f"{one}:{other}",), why))
        suffix, stem = self.name.suffix.lower(), self.name.stem
        main = stage.export_layer(self.layer, crate=stage.is_crate_wanted(suffix, None))
        if suffix == stage.PACKAGE_SUFFIX:
            main = stage.pack_usdz({f"{stem}.usdc": main})
        which = f"{pluralize(len(self.bodies), 'body', 'bodies')} free to fall ({join_names(list(self.bodies), 3)})"
        note = f"{which}: for one that stands fast, join it to the world with a PhysicsFixedJoint"
        return Output(main, notes=(note,) if self.bodies else (), names=self.names, lost=tuple(lost))

    def _add_body(self, body: str, pose: Pose) -> None:
        spec = prims.add_prim(self.root, prims.free_prim_name(self.root, body), "Xform")
        prims.set_place(spec, pose.translation, pose.rotation)
        colliders.apply_schemas(spec, ["PhysicsRigidBodyAPI"])
        self.bodies[body] = spec
        inertial = next((known for known in self.asset.mechanism.inertials if known.body == body), None)
        if inertial is not None and inertial.mass > 0:
            prims.write_mass(spec, inertial, self._space(body))

    def _add_hull(self, geom: Geom) -> None:
        holder = self.bodies.get(geom.body, self.root)
        spec, approximation = prims.add_shape(holder, self._free_name(holder, geom), geom.shape, self._space(geom.body))
        prims.mark_collider(spec, approximation, drawn=self.drawn)
        prims.set_labels(spec, [geom.label])
        own = self._keep_name(spec, geom)
        read = f"{holder.name if geom.body in self.bodies else stage.BODY}/{own}" if self.bodies else own
        if read != geom.name:
            self.names[geom.name] = read

    def _free_name(self, holder: Any, piece: Geom | NonConvexPiece) -> str:
        return prims.free_prim_name(holder, piece.name.rsplit("/", 1)[-1])

    def _keep_name(self, spec: Any, piece: Geom | NonConvexPiece) -> str:
        """Author the name of a piece without its body's where that is not the name of the prim; it is returned."""
        own = piece.name.removeprefix(f"{piece.body}/") if self.bodies else piece.name
        if own != spec.name:
            spec.SetInfoDictionaryValue("customData", colliders.HULL_NAME, own)
        return own

    def _add_non_convex(self, piece: NonConvexPiece) -> None:
        """Add a piece as its triangles, or as a plane; the report names one that is neither."""
        if piece.plane is not None:  # which USD does not let move
            name = self._free_name(self.root, piece)
            spec = prims.add_plane(self.root, name, piece.plane.translation, piece.plane.rotation)
            prims.mark_collider(spec, None)
            return
        if piece.surface is not None and len(piece.surface.faces):
            holder, points = self.bodies.get(piece.body, self.root), np.asarray(piece.surface.vertices)
            name, space = self._free_name(holder, piece), self._space(piece.body)
            spec = prims.add_mesh(holder, name, points, piece.surface.faces, space)
            self._keep_name(spec, piece)
            prims.mark_collider(spec, "convexDecomposition" if piece.body in self.bodies else "none", drawn=self.drawn)

    def _add_visuals(self) -> list[Loss]:
        """Add meshes that are seen and do not collide, with their display colours; what cannot be read."""
        shown, lost = read_visual_surfaces(self.asset)
        for body, surface in shown:
            holder = self.bodies.get(body, self.root)
            points, name = np.asarray(surface.vertices), prims.free_prim_name(holder, "visual")
            spec = prims.add_mesh(holder, name, points, surface.faces, self._space(body))
            prims.set_labels(spec, (geom.label for geom in self.asset.geoms if body in (geom.body, None)))
            if surface.rgba is not None:
                color = pxr.Vt.Vec3fArray([pxr.Gf.Vec3f(*linear_color(surface.rgba))])
                prims.set_value(spec, "primvars:displayColor", "Color3fArray", color)
                if surface.rgba[3] < 1:
                    opacity = pxr.Vt.FloatArray([float(surface.rgba[3])])
                    prims.set_value(spec, "primvars:displayOpacity", "FloatArray", opacity)
        return lost

    def _space(self, body: str) -> prims.PrimSpace:
        pose = self.poses.get(body)
        return prims.PrimSpace(pose.rotation, pose.translation) if pose else _ROOT
