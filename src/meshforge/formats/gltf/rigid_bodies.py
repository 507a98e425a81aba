"""Making a glTF file for Godot from an asset that moves: one rigid body of several shapes for each part that moves, by
the extensions OMI_physics_body and OMI_physics_shape."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import PurePosixPath

from meshforge.common import join_names
from meshforge.formats.base import Loss, Output
from meshforge.formats.engine_names.bodies import EngineBodies, EngineBody, name_bodies
from meshforge.formats.engine_names.conventions import CollisionNames, GodotBodyNames, claim_name
from meshforge.formats.gltf.create import add_visuals, create_for_engine, draft_bodies, pack_new
from meshforge.formats.gltf.document import GltfDocument
from meshforge.formats.gltf.draft import SceneDraft
from meshforge.formats.gltf.physics import mass_keys
from meshforge.formats.gltf.physics_style import PhysicsStyle
from meshforge.formats.gltf.styles import NewPiece
from meshforge.formats.kinematic_tree import BodyTree
from meshforge.formats.meshfile.gltf_document import Json
from meshforge.formats.visuals import VisualSurfaces
from meshforge.geometry import combine_inertias
from meshforge.symbolic import Asset, FeatureKind, Inertial, Opaque, Surface

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
    found = name_bodies(welded, GodotBodyNames(), path.stem)
    draft = draft_bodies(welded, found.each, path)
    notes, pieces = _add_bodies(draft, welded, found, moving)
    bodies = tuple((node, family.body.name) for node, family in enumerate(found.each))
    document = GltfDocument(b"", "omi", (), bodies)
    held = tuple(name for name in tree.order if carriers[name] != name)
    why = join_names([f"{name} to {carriers[name]}" for name in held], 3)
    still = tuple(i.body for i in welded.mechanism.inertials if i.body not in moving)
    losses = (
        *found.lost,
        *_list_joints(asset),
        Loss(FeatureKind.OPAQUE, tuple(pieces), "in Godot a mesh that is no hull cannot move"),
        Loss(FeatureKind.MASSES, still, _STILL),
        Loss(FeatureKind.BODIES, held, f"fixed joints hold {why}", "written as parts of others"),
    )
    return pack_new(welded, draft, document, path, [loss for loss in losses if loss.count], (*found.notes, *notes))


def _list_joints(asset: Asset) -> list[Loss]:
    losses = []
    for joint in (joint for joint in asset.mechanism.joints if joint.kind != "fixed"):
        kind = FeatureKind.BALL_JOINTS if joint.kind == "ball" else FeatureKind.JOINTS
        why = "a rigid body moves freely without one" if joint.kind == "floating" else _JOINT
        losses.append(Loss(kind, (joint.name,) if joint.name else (), why, unnamed=not joint.name))
    return losses  # which the report joins where they are alike


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
    sums = []
    for carrier, own in groups.items():
        parts = [known[name] for name in own if name in known]
        if parts and all(name in known for name in own if name in heavy):
            weights = [(part.mass, part.centre, part.inertia) for part in parts]
            sums.append(Inertial(carrier, *(combine_inertias(weights) if len(weights) > 1 else weights[0])))
    return replace(
        asset,
        bodies=tuple(body for body in asset.bodies if carriers[body.name] == body.name),
        geoms=tuple(replace(g, body=carriers[g.body], shape=g.shape.tessellate()) for g in asset.geoms),
        opaque=tuple(replace(piece, body=carriers[piece.body]) for piece in asset.opaque),
        visuals=visuals,
        mechanism=replace(asset.mechanism, inertials=tuple(sums)),
    )


def _add_bodies(draft: SceneDraft, asset: Asset, found: EngineBodies, moving: set[str]) -> tuple[list[str], list[str]]:
    """Add what Godot's importer (modules/gltf/extensions/physics) takes of bodies; notes, and pieces that it does not.

    It joins shapes to the body right above them, lets a body's own mesh go, and takes moments of inertia about the axes
    of the body only.
    """
    style, names = PhysicsStyle(draft, "omi"), GodotBodyNames()
    taken, notes, lost = {family.name.lower() for family in found.each}, list[str](), list[str]()
    draft.declare_extension(style.marks.name)
    draft.declare_extension(style.marks.shapes)
    for node, family in enumerate(found.each):
        motion: Json = {"type": "static"}
        if moves := family.body.name in moving:
            motion = {"type": "dynamic", **_weigh(asset, family, notes)}
        draft.node(node)["extensions"] = {style.marks.name: {"motion": motion}}
        if family.surfaces:
            seen = add_visuals(draft, family, node)
            draft.add_node({"name": f"{family.name}_visual", "mesh": seen}, node)
        for piece, own in family.pieces:
            if moves and isinstance(piece, Opaque):
                lost.append(piece.name)
            else:
                style.add(NewPiece(piece, claim_name(names.body, own, taken), node))
    return notes, lost


def _weigh(asset: Asset, family: EngineBody, notes: list[str]) -> Json:
    motion = mass_keys(asset, family.body)
    if not motion:
        notes.append(f"the mass of {family.name} is not known: Godot takes 1 kg")
    if motion.pop("inertiaOrientation", _STRAIGHT) != _STRAIGHT:
        del motion["inertiaDiagonal"]
        why = "it takes none about turned axes"
        notes.append(f"Godot computes the moments of inertia of {family.name} from its shapes: {why}")
    return motion
