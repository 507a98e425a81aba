"""Making a USD stage from an asset of another format: a prim for each body, below it its hulls and what it shows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import PurePosixPath
from typing import Any

import numpy as np

from meshforge.common import join_names, pluralize
from meshforge.formats.base import Loss, Output
from meshforge.formats.kinematic_tree import BodyTree, claim_name
from meshforge.formats.libraries import pxr
from meshforge.formats.usd import prims
from meshforge.formats.usd.colliders import apply_schemas
from meshforge.formats.usd.looks import StageLooks
from meshforge.formats.usd.stage import BODY, export_layer, is_crate_wanted, pack_usdz, usd
from meshforge.formats.visuals import linear_color, read_visual_surfaces
from meshforge.geometry import Pose
from meshforge.symbolic import Asset, Geom, Inertial, Joint, Opaque, Surface

_ROOT = prims.PrimSpace(np.eye(3), np.zeros(3))
_LIGHT = 1e-3  # [kg] of a link that stands between joints; engines cannot do with much less beside others
_WORLDS = (BODY, "world")


def create_usd(asset: Asset, name: str) -> Output:
    """The files of an asset that came from another format.

    Bodies become rigid bodies side by side, hulls native shapes or convex meshes below them, in metres with Z up; what
    is part of no moving body collides without one. Hulls are hidden, unless the asset shows nothing else.
    """
    with usd(name):
        return _Creator(asset, PurePosixPath(name)).build_output()


class _Creator:
    def __init__(self, asset: Asset, name: PurePosixPath) -> None:
        self.asset, self.name = asset, name
        self.links = StageLinks.of(asset)
        self.layer = pxr.Sdf.Layer.CreateAnonymous(".usda")
        self.root = prims.add_prim(self.layer.pseudoRoot, prims.free_prim_name(name.stem, ()), "Xform")
        self.bodies: dict[str, Any] = {}
        self.names: dict[str, str] = {}
        self.lost: list[Loss] = []
        self.drawn = not len(asset.visuals)
        self.looks = StageLooks(self.root, name.stem)

    def build_output(self) -> Output:
        self.layer.defaultPrim = self.root.name
        for key, value in (("metersPerUnit", 1.0), ("kilogramsPerUnit", 1.0), ("upAxis", "Z")):
            self.layer.pseudoRoot.SetInfo(key, value)
        for link, pose in self.links.poses.items():
            self._add_body(link, pose)
        for geom in self.asset.geoms:
            self._add_hull(geom)
        for piece in self.asset.opaque:
            self._add_opaque(piece)
        self._add_visuals()
        self._add_joints()
        suffix, stem = self.name.suffix.lower(), self.name.stem
        main = export_layer(self.layer, crate=is_crate_wanted(suffix, None))
        pictures = self.looks.files
        if suffix == ".usdz":
            main, pictures = pack_usdz({f"{stem}.usdc": main, **pictures}), {}
        return Output(main, pictures, notes=tuple(self._collect_notes()), names=self.names, lost=tuple(self.lost))

    def _add_body(self, link: str, pose: Pose) -> None:
        spec = prims.add_prim(self.root, self._free_name(self.root, link), "Xform")
        prims.set_place(spec, pose.translation, pose.rotation)
        apply_schemas(spec, ["PhysicsRigidBodyAPI"])
        self.bodies[link] = spec
        inertial = next((known for known in self.asset.mechanism.inertials if known.body == link), None)
        if link in self.links.between:
            inertial = Inertial(link, _LIGHT, pose.translation, _LIGHT * 1e-3 * np.eye(3))
        if inertial is not None and inertial.mass > 0:
            prims.write_mass(spec, inertial, self._space(link))

    def _add_hull(self, geom: Geom) -> None:
        holder, name = self._find_holder(geom.name, geom.body)
        space = self._space(geom.body)
        spec, approximation = prims.add_native(holder, name, geom.shape, space), None
        if spec is None:
            points = np.asarray(geom.shape.vertices)
            spec, approximation = prims.add_mesh(holder, name, points, geom.shape.faces, space), "convexHull"
        prims.mark_collider(spec, approximation, drawn=self.drawn)
        body = self.bodies.get(geom.body)
        own = str(spec.path).removeprefix(f"{body.path if body else self.root.path}/")
        read = f"{body.name if body else BODY}/{own}" if self.bodies else own
        if read != geom.name:
            self.names[geom.name] = read

    def _add_opaque(self, piece: Opaque) -> None:
        """Add a piece as its triangles, or as a plane; the report names one that is neither."""
        if piece.plane is not None:  # which USD does not let move
            spec = prims.add_prim(self.root, self._free_name(self.root, piece.name.rsplit("/", 1)[-1]), "Plane")
            prims.set_place(spec, piece.plane.translation, piece.plane.rotation)
            prims.mark_collider(spec, None)
            return
        holder, name = self._find_holder(piece.name, piece.body)
        space = self._space(piece.body)
        if piece.surface is not None and len(piece.surface.faces):
            spec = prims.add_mesh(holder, name, np.asarray(piece.surface.vertices), piece.surface.faces, space)
            prims.mark_collider(spec, "convexDecomposition" if piece.body in self.bodies else "none", drawn=self.drawn)

    def _find_holder(self, name: str, body: str) -> tuple[Any, str]:
        """The spec below which a hull goes, and its name there; what its name has of folders becomes scopes."""
        holder = self.bodies.get(body, self.root)
        *above, own = name.removeprefix(f"{body}/").split("/")
        for k, part in enumerate(above):
            found = holder.nameChildren.get(prims.free_prim_name(part, ()))
            if found is not None and found.typeName != "Scope":
                own = "_".join([*above[k:], own])
                break
            holder = found or prims.add_prim(holder, prims.free_prim_name(part, ()), "Scope")
        return holder, self._free_name(holder, own)

    def _add_visuals(self) -> None:
        shown, lost = read_visual_surfaces(self.asset)
        for body, surface in shown:
            holder = self.bodies.get(body, self.root)
            spec = add_visual(holder, self._free_name(holder, "visual"), surface, self._space(body))
            if surface.texture is not None:
                self.looks.put_on(spec, surface.texture)
        self.lost += lost

    def _add_joints(self) -> None:
        paths = {link: str(spec.path) for link, spec in self.bodies.items()}
        joints = [j for j in self.links.joints if not (j.kind == "floating" and j.parent not in paths)]
        if not joints:
            return
        holder = prims.add_prim(self.root, self._free_name(self.root, "joints"), "Scope")
        for joint in joints:
            name = self._free_name(holder, joint.name or f"{joint.child}_joint")
            spec = prims.add_joint(holder, name, joint, paths, dict(self.links.poses))
            if joint.kind == "fixed" and joint.parent not in paths and self._has_children(joint.child):
                apply_schemas(spec, ["PhysicsArticulationRootAPI"])
        held = {joint.child for joint in joints}
        for link in self.bodies.keys() - held:
            if self._has_children(link):
                apply_schemas(self.bodies[link], ["PhysicsArticulationRootAPI"])

    def _has_children(self, link: str) -> bool:
        """Whether something hangs on a link."""
        return any(joint.parent == link for joint in self.links.joints)

    def _collect_notes(self) -> Iterator[str]:
        held = {joint.child for joint in self.links.joints if joint.kind != "floating"}
        loose = [link for link in self.bodies if link not in held]
        if loose:
            yield (
                f"{pluralize(len(loose), 'body', 'bodies')} free to fall ({join_names(loose, 3)}): for one that "
                "stands fast, join it to the world with a PhysicsFixedJoint"
            )
        many = [
            joint.name or joint.child
            for joint in self.links.joints
            if joint.kind == "planar" or (joint.kind == "floating" and joint.parent in self.bodies)
        ]
        if many:
            yield f"joints of several degrees of freedom ({join_names(many, 3)}) are written, and not read again"
        if self.links.between:
            yield f"links of {_LIGHT:g} kg stand between joints of one body ({join_names(self.links.between, 3)})"

    def _space(self, body: str) -> prims.PrimSpace:
        pose = self.links.poses.get(body)
        return prims.PrimSpace(pose.rotation, pose.translation) if pose else _ROOT

    @staticmethod
    def _free_name(holder: Any, wanted: str) -> str:
        return prims.free_prim_name(wanted, [child.name for child in holder.nameChildren])


@dataclass(frozen=True, slots=True)
class StageLinks:
    """The rigid bodies of a new stage, and what joins them.

    poses: root_T_link of each; joints: one for each pair; between: links that stand for no body, between several
    joints of one.
    """

    poses: Mapping[str, Pose]
    joints: tuple[Joint, ...]
    between: tuple[str, ...]

    @staticmethod
    def of(asset: Asset) -> StageLinks:
        """The links of an asset; the body of what never moves is none, nor is the world of MuJoCo."""
        tree, weights = BodyTree.of(asset), {inertial.body for inertial in asset.mechanism.inertials}
        fixed = {root for root in tree.roots if root in _WORLDS and root not in weights}
        poses = {body.name: body.pose for body in asset.bodies if body.name not in fixed}
        taken, joints, between = set(asset.body_poses), list[Joint](), list[str]()
        for body in tree.order:
            own = tree.joints[body]
            parent = own[0].parent if own else ""
            for k, joint in enumerate(own):
                child = body if k == len(own) - 1 else claim_name(f"{body}_link", taken)
                if child != body:
                    between.append(child)
                    poses[child] = asset.body_poses[body]
                joints.append(replace(joint, parent=parent, child=child))
                parent = child
        return StageLinks(poses, tuple(joints), tuple(between))


def add_visual(holder: Any, name: str, surface: Surface, space: prims.PrimSpace) -> Any:
    """A mesh that is seen and does not collide, with its display colour."""
    spec = prims.add_mesh(holder, name, np.asarray(surface.vertices), surface.faces, space)
    color = surface.rgba
    if color is None:
        return spec
    prims.set_value(
        spec, "primvars:displayColor", "Color3fArray", pxr.Vt.Vec3fArray([pxr.Gf.Vec3f(*linear_color(color))])
    )
    if color[3] < 1:
        prims.set_value(spec, "primvars:displayOpacity", "FloatArray", pxr.Vt.FloatArray([float(color[3])]))
    return spec
