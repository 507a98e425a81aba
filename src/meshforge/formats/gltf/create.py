"""Making a glTF file from an asset of another format: a node for each body and hull, with colliders of an extension,
plain, or named for an engine; for Godot, where anything moves, rigid bodies of OMI_physics_body."""

import copy
import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import PurePosixPath
from urllib.parse import quote

import numpy as np

from meshforge.common import join_names
from meshforge.formats import engine_names
from meshforge.formats.base import Loss, Output, nothing_collides_error
from meshforge.formats.gltf.document import BODY, GltfDocument
from meshforge.formats.gltf.draft import SceneDraft
from meshforge.formats.gltf.edit import EngineBodies, EngineBody, assign_names, has_triangles, name_bodies, style_of
from meshforge.formats.gltf.physics import KHR, mass_keys, motion_of
from meshforge.formats.gltf.physics_style import PhysicsStyle, pose_keys
from meshforge.formats.gltf.styles import NewPiece
from meshforge.formats.kinematic_tree import BodyTree, claim_name
from meshforge.formats.meshfile.gltf_document import Container, Json
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.formats.visuals import VisualSurfaces, linear_color, read_visual_surfaces
from meshforge.geometry import combine_inertias
from meshforge.symbolic import Asset, FeatureKind, Geom, Inertial, NonConvexPiece, Surface

_STILL = "in Godot, what stands still has none"
_STRAIGHT = [0.0, 0.0, 0.0, 1.0]
_JOINT = "join the bodies in Godot, by a HingeJoint3D, SliderJoint3D, PinJoint3D or Generic6DOFJoint3D"


def create_gltf(asset: Asset, name: str) -> Output:
    """Return the files of an asset that came from another format.

    Colliders of KHR_physics_rigid_bodies hold bodies and native shapes, shown by meshes where the asset shows nothing.
    """
    path = PurePosixPath(name)
    bodies = [body for body in asset.bodies if body.name != BODY]  # which all formats without bodies have
    motions = [{"extensions": {KHR: {"motion": motion_of(asset, body)}}} for body in bodies]
    places = [{"name": body.name, **pose_keys(body.pose)} for body in bodies]
    draft = _new_draft(asset, path, [place | motion for place, motion in zip(places, motions, strict=True)], [KHR])
    seen, lost = read_visual_surfaces(asset)
    style = PhysicsStyle(draft, "khr", drawn=not seen)
    nodes = {body.name: node for node, body in enumerate(bodies)}
    pieces: list[Geom | NonConvexPiece] = [*asset.geoms, *asset.non_convex]
    for piece in pieces:
        if isinstance(piece, Geom) or piece.plane or has_triangles(piece):
            own = piece.name.removeprefix(f"{piece.body}/") if nodes else piece.name
            style.add(NewPiece(piece, own, nodes.get(piece.body)))
    if not draft.expected:
        raise nothing_collides_error(asset)
    for body_name, surface in seen:
        holder, called = nodes.get(body_name), f"{body_name}-visual"
        points = draft.points_in(np.asarray(surface.vertices), holder)
        material = _add_material(draft, surface)
        mesh, middle = draft.add_surface_mesh(points, surface.faces, called, material, surface.texture)
        draft.add_node({"name": called, "mesh": mesh, "translation": middle.tolist()}, holder)
    document = GltfDocument(b"", "khr", (), tuple((node, body) for body, node in nodes.items()))
    return _pack_new(asset, draft, document, path, lost, renames=True)


def create_for_engine(asset: Asset, name: str, engine: engine_names.CollisionNames) -> Output:
    """Return the files of an asset with the names of an engine; for Godot, rigid bodies where anything moves."""
    if engine.engine != "godot":
        return _create_nodes(asset, name, engine)
    tree = BodyTree.of(asset)
    if not all(map(tree.is_static, tree.order)):
        return _create_rigid_bodies(asset, tree, PurePosixPath(name))
    made = _create_nodes(asset, name, engine)
    bodies, masses = [body.name for body in asset.bodies], [i.body for i in asset.mechanism.inertials]
    losses = [Loss(FeatureKind.MASSES, tuple(masses), _STILL)]
    if len(bodies) > 1:
        losses.append(Loss(FeatureKind.BODIES, tuple(bodies), "none of them moves", "written as nodes"))
    return replace(made, lost=(*made.lost, *(loss for loss in losses if loss.count)))


def _create_nodes(asset: Asset, name: str, engine: engine_names.CollisionNames) -> Output:
    """The files of an asset whose nodes say by their names what collides; no node is scaled.

    For Unreal, the meshes of a body are in its frame, since its importers have not always obeyed the
    places of nodes with collision; for others they lie about their own middle, so that single precision is fine.
    """
    path = PurePosixPath(name)
    found = name_bodies(asset, engine, path.stem)
    draft = _draft_bodies(asset, found.each, path)
    for node, family in enumerate(found.each):
        if family.surfaces:
            draft.node(node)["mesh"] = _add_visuals(draft, family, node)
    style = style_of(engine.engine, draft, path.stem)
    for node, family in enumerate(found.each):
        for piece, own in family.pieces:
            style.add(NewPiece(piece, own, node))
    return _pack_new(asset, draft, GltfDocument(b"", engine.engine, ()), path, found.lost, found.notes)


def _create_rigid_bodies(asset: Asset, tree: BodyTree, path: PurePosixPath) -> Output:
    """The files of an asset that moves. A body that only fixed joints hold is part of the one above."""
    carriers = {name: name for name in tree.order}
    for name in tree.order:  # each after its parent
        joints = tree.joints[name]
        if joints and all(joint.kind == "fixed" for joint in joints) and not tree.is_static(name):
            carriers[name] = carriers[joints[0].parent]
    welded = _weld_bodies(asset, carriers)
    moving = {name for name in tree.order if not tree.is_static(name)}
    found = name_bodies(welded, engine_names.GodotBodyNames(), path.stem)
    draft = _draft_bodies(welded, found.each, path)
    notes, pieces = _add_bodies(draft, welded, found, moving)
    bodies = tuple((node, family.body.name) for node, family in enumerate(found.each))
    document = GltfDocument(b"", "omi", (), bodies)
    kept = tuple(name for name in tree.order if carriers[name] != name)
    why = join_names([f"{name} to {carriers[name]}" for name in kept], 3)
    still = tuple(i.body for i in welded.mechanism.inertials if i.body not in moving)
    losses = (
        *found.lost,
        *_list_joints(asset),
        Loss(FeatureKind.NON_CONVEX, tuple(pieces), "in Godot a mesh that is no hull cannot move"),
        Loss(FeatureKind.MASSES, still, _STILL),
        Loss(FeatureKind.BODIES, kept, f"fixed joints hold {why}", "written as parts of others"),
    )
    return _pack_new(welded, draft, document, path, [loss for loss in losses if loss.count], (*found.notes, *notes))


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
        non_convex=tuple(replace(piece, body=carriers[piece.body]) for piece in asset.non_convex),
        visuals=visuals,
        mechanism=replace(asset.mechanism, inertials=tuple(sums)),
    )


def _add_bodies(draft: SceneDraft, asset: Asset, found: EngineBodies, moving: set[str]) -> tuple[list[str], list[str]]:
    """Add what Godot's importer (modules/gltf/extensions/physics) takes of bodies; notes, and pieces that it does not.

    It joins shapes to the body right above, lets a body's own mesh go, and takes inertias about the body's axes only.
    """
    style, names = PhysicsStyle(draft, "omi"), engine_names.GodotBodyNames()
    taken, notes, lost = {family.name.lower() for family in found.each}, list[str](), list[str]()
    draft.declare_extension(style.marks.name)
    draft.declare_extension(style.marks.shapes)
    for node, family in enumerate(found.each):
        motion: Json = {"type": "static"}
        if moves := family.body.name in moving:
            motion = {"type": "dynamic", **_weigh(asset, family, notes)}
        draft.node(node)["extensions"] = {style.marks.name: {"motion": motion}}
        if family.surfaces:
            seen = _add_visuals(draft, family, node)
            draft.add_node({"name": f"{family.name}_visual", "mesh": seen}, node)
        for piece, own in family.pieces:
            if moves and isinstance(piece, NonConvexPiece):
                lost.append(piece.name)
            else:
                style.add(NewPiece(piece, claim_name(own, taken, names.body, str.lower, "-"), node))
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


def _new_draft(asset: Asset, path: PurePosixPath, nodes: list[Json], extensions: Sequence[str] = ()) -> SceneDraft:
    scene = {"nodes": list(range(len(nodes)))} if nodes else {}
    tree = {"asset": {"version": "2.0", "generator": "MeshForge"}, "scene": 0, "scenes": [scene]}
    tree |= {"extensionsUsed": list(extensions)} if extensions else {}
    tree |= {"nodes": nodes} if nodes else {}
    return SceneDraft(GltfScene(copy.deepcopy(tree), None, asset.path), tree, b"" if _is_binary(path) else None)


def _draft_bodies(asset: Asset, bodies: Sequence[EngineBody], path: PurePosixPath) -> SceneDraft:
    return _new_draft(asset, path, [{"name": family.name, **pose_keys(family.body.pose)} for family in bodies])


def _add_visuals(draft: SceneDraft, family: EngineBody, node: int) -> int:
    """Add one mesh of all that is seen of a body, a part for each surface."""
    parts = []
    for surface in family.surfaces:
        points = draft.points_in(np.asarray(surface.vertices), node)
        parts.append(draft.build_primitive(points, surface.faces, _add_material(draft, surface), surface.texture))
    return draft.add_mesh({"name": family.name, "primitives": parts})


def _add_material(draft: SceneDraft, surface: Surface) -> int | None:
    """The number of a material of the colour or picture of a surface, which is added where it is not there yet."""
    shading: Json = {"metallicFactor": 0.0}
    wanted: Json = {"pbrMetallicRoughness": shading}
    if surface.texture is not None:
        picture = surface.texture.picture  # a PNG, which is in the buffer once
        if picture not in draft.pictures:
            image = {"bufferView": draft.geometry.add_bytes(picture), "mimeType": "image/png"}
            draft.pictures[picture] = _number_of(draft.tree, "images", image)
        texture = _number_of(draft.tree, "textures", {"source": draft.pictures[picture]})
        shading["baseColorTexture"] = {"index": texture}
    elif surface.rgba is not None:
        shading["baseColorFactor"] = [*linear_color(surface.rgba), float(surface.rgba[3])]
        if surface.rgba[3] < 1:
            wanted["alphaMode"] = "BLEND"
    else:
        return None
    return _number_of(draft.tree, "materials", wanted)


def _number_of(tree: Json, key: str, wanted: Json) -> int:
    found: list[Json] = tree.setdefault(key, [])
    if wanted not in found:
        found.append(wanted)
    return found.index(wanted)


def _pack_new(
    asset: Asset,
    draft: SceneDraft,
    document: GltfDocument,
    path: PurePosixPath,
    lost: Sequence[Loss],
    notes: Sequence[str] = (),
    *,
    renames: bool = False,
) -> Output:
    """Return the files of a new scene, with the names that hulls read back as; renames: as for `assign_names`."""
    hulls, buffer = {geom.name for geom in asset.geoms}, f"{path.stem}.bin"
    names = {old: now for old, now in assign_names(draft, document, renames=renames).items() if old in hulls}
    draft.geometry.finish(embed=False, uri=quote(buffer))
    if _is_binary(path):
        text = json.dumps(draft.tree, separators=(",", ":")).encode()
        main, made = Container(text, True).with_text(text, draft.geometry.chunk).as_bytes(), {}
    else:
        main = (json.dumps(draft.tree, indent=2) + "\n").encode()
        made = {buffer: bytes(draft.geometry.added)}
    return Output(main, made, names=names, lost=tuple(lost), notes=tuple(notes))


def _is_binary(path: PurePosixPath) -> bool:
    return path.suffix.lower() == ".glb"
