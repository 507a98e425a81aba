"""Hulls written beside an unmarked stage: its prims stay as they are, and new ones below a scope collide."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import Any

import numpy as np

from meshforge.formats.base import Output, note_shapes_as_hulls, nothing_collides_error
from meshforge.formats.collision_pieces import names_to_keep
from meshforge.formats.libraries import pxr
from meshforge.formats.usd import colliders, prims
from meshforge.formats.usd.edit import edit_root_layer
from meshforge.formats.usd.edit_stage import NO_SHAPE, holds_volume
from meshforge.formats.usd.stage import UsdDocument, UsdStage
from meshforge.symbolic import Asset, Geom, NonConvexPiece

_SCOPE = "collision"


def add_usd_colliders(asset: Asset, document: UsdDocument, name: str) -> Output:
    """The files of a stage with the hulls of an asset beside it, hidden and marked by UsdPhysics.

    Raises AssetError: a file changed since the asset was read, or there is no hull to write.
    """

    def author(scene: UsdStage, layer: Any) -> tuple[list[str], dict[str, str]]:
        writer = _ColliderWriter(scene, layer, document, asset)
        pieces: list[Geom | NonConvexPiece] = [*asset.geoms, *asset.non_convex]
        for piece in pieces:
            writer.add(piece)
        if not writer.count:
            raise nothing_collides_error(asset)
        return note_shapes_as_hulls(writer.hulled, NO_SHAPE), {}

    return edit_root_layer(asset, document, PurePosixPath(name), author)


class _ColliderWriter:
    """Adds pieces to a copy of a root layer; hulled: the kinds of shapes that are hulls as USD lacks them."""

    def __init__(self, scene: UsdStage, layer: Any, document: UsdDocument, asset: Asset) -> None:
        self.scene, self.layer = scene, layer
        self.kept = names_to_keep(asset)
        self.paths = {name: element.path for element in document.authored for name in element.names}
        self.scopes: dict[str, Any] = {}
        self.hulled: list[str] = []
        self.count = 0

    def add(self, piece: Geom | NonConvexPiece) -> None:
        """Add a piece below the scope of what it moves with; one that is neither triangles nor a plane is left out."""
        parent = piece.parent if isinstance(piece, Geom) else None
        carrier = self._find_carrier(self.paths.get(piece.name if piece.name in self.kept else parent or ""))
        space, spec, how = self._space_of(carrier), None, None
        if isinstance(piece, Geom):
            spec, how = prims.add_shape(*self._place_of(carrier, piece), piece.shape, space)
            self.hulled += [piece.shape.kind] if how and piece.shape.is_primitive else []
        elif piece.plane is not None and (place := space.split_pose(piece.plane)) is not None:
            spec = prims.add_plane(*self._place_of(carrier, piece), *place[:2])
        elif piece.surface is not None and len(piece.surface.faces):
            points, how = np.asarray(piece.surface.vertices), "none"
            spec = prims.add_mesh(*self._place_of(carrier, piece), points, piece.surface.faces, space)
        if spec is None:
            return
        prims.mark_collider(spec, how)
        spec.SetInfoDictionaryValue("customData", colliders.HULL_NAME, piece.name)
        self.count += 1

    def _place_of(self, carrier: Any, piece: Geom | NonConvexPiece) -> tuple[Any, str]:
        """The scope below a prim, and the name of a piece in it: the last part of its own."""
        holder = self._scope_of(carrier)
        taken = [child.name for child in holder.nameChildren]
        return holder, prims.free_prim_name(piece.name.rsplit("/", 1)[-1], taken)

    def _find_carrier(self, path: str | None) -> Any:
        """The prim that a piece moves with: the nearest animated one at or above where it comes from, else the default
        prim; the root of the stage where below neither a prim could be."""
        scene = self.scene
        prim = scene.stage.GetPrimAtPath(path) if path else None
        while prim and not prim.IsPseudoRoot():
            moves = pxr.UsdGeom.Xformable(prim) and pxr.UsdGeom.Xformable(prim).TransformMightBeTimeVarying()
            if moves and _can_hold(scene, prim):
                return prim
            prim = prim.GetParent()
        default = scene.stage.GetDefaultPrim()
        return default if default and _can_hold(scene, default) else scene.stage.GetPseudoRoot()

    def _scope_of(self, carrier: Any) -> Any:
        """The spec of the scope below a prim, which is made where there is none yet.

        Below geometry no other may be: beside an animated mesh it is a group that moves as that does.
        """
        path = str(carrier.GetPath())
        if path not in self.scopes:
            beside = carrier.IsA(pxr.UsdGeom.Gprim) and not carrier.GetParent().IsPseudoRoot()
            above = carrier.GetParent() if beside else carrier
            is_root = above.IsPseudoRoot()
            holder = self.layer.pseudoRoot if is_root else pxr.Sdf.CreatePrimInLayer(self.layer, above.GetPath())
            taken = [child.GetName() for child in above.GetAllChildren()]
            taken += [child.name for child in holder.nameChildren]
            spec = prims.add_prim(holder, prims.free_prim_name(_SCOPE, taken), "Xform" if beside else "Scope")
            if beside:
                _copy_movement(carrier, spec)
            self.scopes[path] = spec
        return self.scopes[path]

    def _space_of(self, carrier: Any) -> prims.PrimSpace:
        if carrier.IsPseudoRoot():
            return prims.PrimSpace(self.scene.metres * np.eye(3), np.zeros(3))
        return prims.PrimSpace(*self.scene.placement(carrier))


def _copy_movement(prim: Any, spec: Any) -> None:
    """Author on a new prim where another one is below its parent, at all times."""
    names = ["xformOpOrder", *(op.GetOpName() for op in pxr.UsdGeom.Xformable(prim).GetOrderedXformOps())]
    for name in dict.fromkeys(name.removeprefix("!invert!") for name in names):
        attribute = prim.GetAttribute(name)
        if not attribute or not attribute.HasAuthoredValue():
            continue
        made = pxr.Sdf.AttributeSpec(spec, name, attribute.GetTypeName(), attribute.GetVariability())
        if attribute.GetNumTimeSamples() == 0:
            made.default = attribute.Get()
        for time in attribute.GetTimeSamples():
            spec.layer.SetTimeSample(made.path, time, attribute.Get(time))


def _can_hold(scene: UsdStage, prim: Any) -> bool:
    """Whether a prim can be put below another one, and keeps its volume there; an instance shares what is below it."""
    return not (prim.IsInstance() or prim.IsInstanceProxy()) and holds_volume(scene, prim)
