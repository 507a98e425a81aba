"""Making a USD stage from an asset of another format: a prim for each body, below it its hulls and what it shows."""

from pathlib import PurePosixPath
from typing import Any

import numpy as np

from meshforge.common import join_names, pluralize
from meshforge.formats.base import Loss, Output
from meshforge.formats.kinematic_tree import BodyTree
from meshforge.formats.libraries import pxr
from meshforge.formats.usd import prims
from meshforge.formats.usd.colliders import HULL_NAME, apply_schemas
from meshforge.formats.usd.stage import BODY, PACKAGE_SUFFIX, export_layer, is_crate_wanted, pack_usdz, usd
from meshforge.formats.visuals import linear_color, read_visual_surfaces
from meshforge.geometry import Pose
from meshforge.symbolic import Asset, Geom, NonConvexPiece

_ROOT = prims.PrimSpace(np.eye(3), np.zeros(3))
_WORLDS = (BODY, "world")


def create_usd(asset: Asset, name: str) -> Output:
    """Return the files of an asset that came from another format.

    Bodies become rigid bodies side by side, hulls native shapes or convex meshes below them, in metres with Z up; what
    is part of the world collides without one. Hulls are hidden, unless the asset shows nothing else.
    """
    with usd(name):
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
        suffix, stem = self.name.suffix.lower(), self.name.stem
        main = export_layer(self.layer, crate=is_crate_wanted(suffix, None))
        if suffix == PACKAGE_SUFFIX:
            main = pack_usdz({f"{stem}.usdc": main})
        which = f"{pluralize(len(self.bodies), 'body', 'bodies')} free to fall ({join_names(list(self.bodies), 3)})"
        note = f"{which}: for one that stands fast, join it to the world with a PhysicsFixedJoint"
        return Output(main, notes=(note,) if self.bodies else (), names=self.names, lost=tuple(lost))

    def _add_body(self, body: str, pose: Pose) -> None:
        spec = prims.add_prim(self.root, prims.free_prim_name(self.root, body), "Xform")
        prims.set_place(spec, pose.translation, pose.rotation)
        apply_schemas(spec, ["PhysicsRigidBodyAPI"])
        self.bodies[body] = spec
        inertial = next((known for known in self.asset.mechanism.inertials if known.body == body), None)
        if inertial is not None and inertial.mass > 0:
            prims.write_mass(spec, inertial, self._space(body))

    def _add_hull(self, geom: Geom) -> None:
        holder = self.bodies.get(geom.body, self.root)
        spec, approximation = prims.add_shape(holder, self._free_name(holder, geom), geom.shape, self._space(geom.body))
        prims.mark_collider(spec, approximation, drawn=self.drawn)
        own = self._keep_name(spec, geom)
        read = f"{holder.name if geom.body in self.bodies else BODY}/{own}" if self.bodies else own
        if read != geom.name:
            self.names[geom.name] = read

    def _free_name(self, holder: Any, piece: Geom | NonConvexPiece) -> str:
        return prims.free_prim_name(holder, piece.name.rsplit("/", 1)[-1])

    def _keep_name(self, spec: Any, piece: Geom | NonConvexPiece) -> str:
        """Author the name of a piece without its body's where that is not the name of the prim; it is returned."""
        own = piece.name.removeprefix(f"{piece.body}/") if self.bodies else piece.name
        if own != spec.name:
            spec.SetInfoDictionaryValue("customData", HULL_NAME, own)
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
