"""Making a glTF file for Godot from an asset that moves: one rigid body of several shapes for each part that moves, by
the extensions OMI_physics_body and OMI_physics_shape."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import PurePosixPath

import numpy as np

from meshforge.common import join_names
from meshforge.formats.base import Loss, Output
from meshforge.formats.engine_names.bodies import EngineBody, name_bodies
from meshforge.formats.engine_names.conventions import CollisionNames, GodotBodyNames
from meshforge.formats.gltf.create import EngineCreator, create_for_engine
from meshforge.formats.gltf.document import GltfDocument
from meshforge.formats.gltf.edit_physics import write_mesh_geometry
from meshforge.formats.gltf.physics import OMI, OMI_SHAPES, mass_keys
from meshforge.formats.kinematic_tree import BodyTree
from meshforge.formats.meshfile.gltf_document import Json
from meshforge.formats.visuals import VisualSurfaces
from meshforge.symbolic import Asset, FeatureKind, Inertial, Surface

_STILL = "in Godot, what stands still has none"
_STRAIGHT = [0.0, 0.0, 0.0, 1.0]
_JOINT = "join the bodies in Godot, by a HingeJoint3D, SliderJoint3D, PinJoint3D or Generic6DOFJoint3D"


def create_for_godot(asset: Asset, name: str, names: CollisionNames) -> Output:
    """The files of an asset: rigid bodies where anything moves, else nodes that Godot knows by their names."""
    tree = BodyTree.of(asset)
    if not all(map(tree.is_static, tree.order)):
        return _create_rigid_bodies(asset, tree, PurePosixPath(name))
    made = create_for_engine(asset, name, names)
    bodies, masses = [body.name for body in asset.bodies], [i.body for i in asset.mechanism.inertials]
    losses = [Loss(FeatureKind.MASSES, tuple(masses), _STILL)]
    if len(bodies) > 1:
        losses.append(Loss(FeatureKind.BODIES, tuple(bodies), "none of them moves", "written as nodes"))
    return replace(made, lost=(*made.lost, *(loss for loss in losses if loss.count)))


def _create_rigid_bodies(asset: Asset, tree: BodyTree, path: PurePosixPath) -> Output:
    """The files of an asset that moves. A body that only fixed joints hold is part of the one above."""
    carriers = {name: name for name in tree.order}
    for name in tree.order:  # each after its parent
        joints = tree.joints[name]
        if joints and all(joint.kind == "fixed" for joint in joints) and not tree.is_static(name):
            carriers[name] = carriers[joints[0].parent]
    welded = _weld_bodies(asset, carriers)
    moving = {name for name in tree.order if not tree.is_static(name)}
    names = GodotBodyNames()
    found = name_bodies(welded, names, path.stem)
    creator = _RigidBodyCreator(welded, found, names, path.suffix.lower() == ".glb")
    losses = [*creator.found.lost, *_list_joints(asset), *creator.add_motions(moving)]
    main, made, read = creator.build_files(path.stem)
    held = tuple(name for name in tree.order if carriers[name] != name)
    why = join_names([f"{name} to {carriers[name]}" for name in held], 3)
    losses.append(Loss(FeatureKind.BODIES, held, f"fixed joints hold {why}", "written as parts of others"))
    return Output(main, made, names=read, lost=tuple(loss for loss in losses if loss.count), notes=tuple(creator.notes))


def _list_joints(asset: Asset) -> list[Loss]:
    joints = [joint for joint in asset.mechanism.joints if joint.kind != "fixed"]
    free = [joint for joint in joints if joint.kind == "floating"]
    balls = [joint for joint in joints if joint.kind == "ball"]
    others = [joint for joint in joints if joint.kind not in ("floating", "ball")]
    rows = (
        (FeatureKind.JOINTS, free, "a rigid body moves freely without one"),
        (FeatureKind.BALL_JOINTS, balls, _JOINT),
        (FeatureKind.JOINTS, others, _JOINT),
    )
    return [
        Loss(kind, tuple(j.name for j in own if j.name), why, unnamed=sum(not j.name for j in own))
        for kind, own, why in rows
    ]


def _weld_bodies(asset: Asset, carriers: Mapping[str, str]) -> Asset:
    if isinstance(asset.visuals, VisualSurfaces):
        shown = (replace(visual, body=carriers.get(visual.body, visual.body)) for visual in asset.visuals.visuals)
        visuals: Sequence[Surface] = VisualSurfaces(tuple(shown))
    else:
        visuals = tuple(replace(s, body=carriers.get(s.body or "", s.body)) for s in asset.visuals)
    known = {inertial.body: inertial for inertial in asset.mechanism.inertials}
    heavy = {geom.body for geom in asset.geoms} | known.keys()
    groups: dict[str, list[str]] = {}
    for body in asset.bodies:
        groups.setdefault(carriers[body.name], []).append(body.name)
    sums = [
        _add_inertials(carrier, [known[name] for name in own if name in known])
        for carrier, own in groups.items()
        if any(name in known for name in own) and all(name in known for name in own if name in heavy)
    ]
    return replace(
        asset,
        bodies=tuple(body for body in asset.bodies if carriers[body.name] == body.name),
        geoms=tuple(replace(geom, body=carriers[geom.body]) for geom in asset.geoms),
        opaque=tuple(replace(piece, body=carriers[piece.body]) for piece in asset.opaque),
        visuals=visuals,
        mechanism=replace(asset.mechanism, inertials=tuple(sums)),
    )


def _add_inertials(body: str, parts: Sequence[Inertial]) -> Inertial:
    if len(parts) == 1:
        return replace(parts[0], body=body)
    mass = sum(part.mass for part in parts)
    centre = np.sum([part.mass * part.centre for part in parts], axis=0) / mass
    arms = [part.centre - centre for part in parts]
    shifted = [
        part.inertia + part.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        for part, arm in zip(parts, arms, strict=True)
    ]
    return Inertial(body, mass, centre, np.sum(shifted, axis=0))


class _RigidBodyCreator(EngineCreator):
    """What Godot's importer (modules/gltf/extensions/physics) takes: it joins shapes to the body right above them, lets
    a body's own mesh go, and takes moments of inertia about the axes of the body only."""

    notes: list[str]

    def add_motions(self, moving: set[str]) -> list[Loss]:
        """Make bodies of the nodes; what Godot does not take of them."""
        self.notes = list(self.found.notes)
        for name in (OMI, OMI_SHAPES):
            self.draft.declare_extension(name)
        lost, kept = list[Loss](), list[EngineBody]()
        for node, family in enumerate(self.found.each):
            name = family.body.name
            motion: Json = {"type": "dynamic" if name in moving else "static"}
            if name in moving:
                motion |= self._weigh(family)
                if family.opaque:
                    pieces = tuple(piece.name for piece in family.opaque.values())
                    lost.append(Loss(FeatureKind.OPAQUE, pieces, "in Godot a mesh that is no hull cannot move"))
                    family = replace(family, opaque={})
            self.draft.node(node)["extensions"] = {OMI: {"motion": motion}}
            kept.append(family)
        still = [i.body for i in self.asset.mechanism.inertials if i.body not in moving]
        lost.append(Loss(FeatureKind.MASSES, tuple(still), _STILL))
        self.found = replace(self.found, each=tuple(kept))
        return lost

    def _weigh(self, family: EngineBody) -> Json:
        motion = mass_keys(self.asset, family.body)
        if not motion:
            self.notes.append(f"the mass of {family.name} is not known: Godot takes 1 kg")
        if motion.pop("inertiaOrientation", _STRAIGHT) != _STRAIGHT:
            del motion["inertiaDiagonal"]
            why = "it takes none about turned axes"
            self.notes.append(f"Godot computes the moments of inertia of {family.name} from its shapes: {why}")
        return motion

    def _build_document(self) -> GltfDocument:
        bodies = tuple((node, family.body.name) for node, family in enumerate(self.found.each))
        return GltfDocument(b"", "omi", (), bodies)

    def _show(self, family: EngineBody, node: int, mesh: int) -> None:
        self.draft.add_node({"name": f"{family.name}_visual", "mesh": mesh}, node)

    def _build_collider(self, mesh: int, known: str) -> Json:
        hulled = any(geom.name == known for geom in self.asset.geoms)
        shape = write_mesh_geometry(self.draft, "omi", mesh, None, hulled=hulled, like={})
        return {"extensions": {OMI: {"collider": {"shape": shape}}}}
