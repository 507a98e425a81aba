"""Reading a glTF file or GLB: from its bytes to an asset, with what it shows, notes and other names of colliders."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from urllib.parse import unquote

import numpy as np

from meshforge.common import AssetError, MeshForgeError, file_digest, pluralize
from meshforge.formats import collision_pieces, mesh_reader, references
from meshforge.formats.collision_pieces import CollisionElement, drop_repeats, geoms_of, non_convex_of, place_surface
from meshforge.formats.engine_names.conventions import godot_kind, unreal_kind
from meshforge.formats.engine_names.name_problems import find_name_problems
from meshforge.formats.gltf import physics
from meshforge.formats.gltf.colliders import CollisionReader, NodeCollision, convention_of, nodes_below_colliders
from meshforge.formats.gltf.document import BODY, Convention, GltfDocument, NodeRecord
from meshforge.formats.gltf.draft import name_of
from meshforge.formats.meshfile.gltf_document import Json, entries, entry, extension, report_damage
from meshforge.formats.meshfile.gltf_meshes import GltfMesh
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.formats.meshfile.surface import GAMMA
from meshforge.formats.visuals import LazySurfaces
from meshforge.geometry import Floats, Ints, Pose
from meshforge.symbolic import Asset, Body, FileNote, Mechanism, Mentions, NameProblem, Rgba, Surface, unique_names

_DAMAGE = (ValueError, LookupError, TypeError, AttributeError)

_HOW: dict[Convention, str] = {
    "khr": "its colliders are those of KHR_physics_rigid_bodies",
    "omi": "its colliders are those of OMI_physics_body",
    "unreal": "its collision is the nodes that Unreal takes by their names, UCX_ and the like",
    "godot": "its collision is the nodes that Godot takes by their names, -col and the like",
    "unity": "its collision is what lies below nodes called _colliders, as files for Unity have it",
}
_HARMLESS = ("KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "MSFT_texture_")
_KNOWN = ("KHR_draco_mesh_compression", "KHR_mesh_quantization")
_PHYSICS = ("KHR_physics_rigid_bodies", "KHR_implicit_shapes", "OMI_physics_body", "OMI_physics_shape")
_DRAFTS = {"OMI_collider": "OMI_physics_shape", "KHR_collision_shapes": "KHR_implicit_shapes"}
"""What physics extensions were called in drafts of them."""


def read_gltf(path: Path) -> Asset:
    """The asset in a glTF file or GLB.

    Raises AssetError: damaged, compressed in a way that is not read, a buffer is missing, or there is nothing in it.
    """
    source = mesh_reader.read_content(path)
    with report_damage(str(path)):
        scene = GltfScene.of(source, path)
        _refuse_drafts(scene.tree, path)
        reader = CollisionReader(scene)
        sources = reader.read()
        bodies = name_bodies(scene)
        nodes = [*(source.node for source in sources), *visible_nodes(scene, reader.convention)]
        fixed = not bodies or any(node not in bodies for node in nodes)  # something is part of no rigid body
        notes = [*collect_notes(scene, reader.convention), *reader.notes]
        authored = record_nodes(sources, bodies)
        mentions = [mentions_of_node(scene, source) for source in sources]
        pieces = (
            [CollisionElement(element.body, element.names) for element in authored],
            [s.parts for s in sources],
            mentions,
        )
        geoms = geoms_of(*pieces)
        hulls = {name: [geom.shape for geom in geoms if geom.body == name] for _, name in _nodes_of(bodies)}
        found = (physics.read_inertial(scene.placements[node], name, hulls[name]) for node, name in _nodes_of(bodies))
        masses = tuple(inertial for inertial in found if inertial is not None)
        digests = tuple((file, file_digest(file)) for file in scene.buffers.files() if file.is_file())
    if not sources:
        raise AssetError("there is no mesh and no collider in its scene", where=str(path))
    moving = [Body(name, physics.rigid_pose_of(scene.placements[node])) for node, name in _nodes_of(bodies)]
    owners = {node: name for node, (_, name) in bodies.items()}
    files, missing = _find_files(scene, path)
    return Asset(
        path=path,
        format="gltf",
        bodies=(*([Body(BODY, Pose.identity())] if fixed else []), *moving),
        geoms=geoms,
        document=GltfDocument(source, reader.convention, authored, _nodes_of(bodies), digests),
        non_convex=non_convex_of(*pieces),
        visuals=() if reader.convention == "plain" else SceneSurfaces(source, path, owners),
        files=files,
        missing=missing,
        notes=tuple(notes),
        mechanism=Mechanism(inertials=masses),
        up="y",
        name_problems=()
        if physics.physics_extension_of(scene)
        else tuple(_find_name_problems(scene, reader.convention, [geom.name for geom in geoms])),
    )


def _refuse_drafts(tree: Json, path: Path) -> None:
    used = entries(tree, "extensionsUsed")
    for name in (name for name in _DRAFTS if name in used or extension(tree, name) is not None):
        problem = f"its colliders are those of {name}, a draft of {_DRAFTS[name]}, which is not read"
        raise AssetError(problem, where=str(path), remedy=f"Export it with {_DRAFTS[name]}.")


def _find_name_problems(scene: GltfScene, marks: str, hulls: Sequence[str]) -> Iterator[NameProblem]:
    nodes = [placement.node for placement in scene.placements.values()]
    things = [[n, entry(scene.tree, "meshes", n["mesh"])] if "mesh" in n else [n] for n in nodes]
    names = [[name for one in own if isinstance(name := one.get("name"), str)] for own in things]
    bare = [own[0] for node, own in zip(nodes, names, strict=True) if own and "mesh" not in node]
    meshes = [own for node, own in zip(nodes, names, strict=True) if "mesh" in node]
    return find_name_problems(meshes, bare, marks, *hulls[:1])


def name_bodies(scene: GltfScene) -> dict[int, tuple[int, str]]:
    """For each node in a rigid body, the node that is the body, and the body's name."""
    owners = physics.body_nodes(scene)
    nodes = list(dict.fromkeys(owners.values()))
    own = [scene.placements[node].node.get("name") for node in nodes]
    wanted = [name if isinstance(name, str) and name else f"body{k}" for k, name in enumerate(own)]
    names = dict(zip(nodes, unique_names([BODY, *wanted])[1:], strict=True))
    return {node: (owner, names[owner]) for node, owner in owners.items()}


def record_nodes(sources: Sequence[NodeCollision], bodies: Mapping[int, tuple[int, str]]) -> tuple[NodeRecord, ...]:
    """The sources with the names of their pieces; names begin with the body where the file has rigid bodies."""
    own = [bodies[source.node][1] if source.node in bodies else BODY for source in sources]
    named = [
        (body if bodies else None, source.name, len(source.parts)) for body, source in zip(own, sources, strict=True)
    ]
    return tuple(
        NodeRecord(source.node, body, names, source.owner)
        for source, body, names in zip(sources, own, collision_pieces.name_element_pieces(named), strict=True)
    )


def _nodes_of(bodies: Mapping[int, tuple[int, str]]) -> tuple[tuple[int, str], ...]:
    return tuple(dict.fromkeys(bodies.values()))


def _find_files(scene: GltfScene, path: Path) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    found = references.find_companions(path)
    uris = [e.get("uri") for key in ("buffers", "images") for e in entries(scene.tree, key) if isinstance(e, dict)]
    named = [uri for uri in uris if isinstance(uri, str) and not uri.startswith("data:")]
    there = {(path.parent / key).resolve() for key in found}
    missing = [uri for uri in named if (path.parent / unquote(uri)).resolve() not in there]
    return tuple(dict.fromkeys(found.values())), tuple(dict.fromkeys(missing))


def read_scene_surfaces(asset: Asset, document: GltfDocument) -> SceneSurfaces:
    """What a scene shows in which all meshes are taken for collision."""
    with report_damage(str(asset.path)):
        bodies = name_bodies(GltfScene.of(document.source, asset.path))
    owners = {node: name for node, (_, name) in bodies.items()}
    return SceneSurfaces(document.source, asset.path, owners, unmarked=True)


class SceneSurfaces(LazySurfaces):
    """The visible surfaces of a file, none where it is damaged; bodies: the body of each node that is in one.

    unmarked: whether meshes are seen that are taken for collision as nothing is marked.
    """

    def __init__(self, source: bytes, path: Path, bodies: dict[int, str], *, unmarked: bool = False) -> None:
        self._source, self._path, self._bodies, self._unmarked = source, path, bodies, unmarked

    def _make(self) -> list[Surface]:
        found = []
        try:
            with report_damage(str(self._path)):
                scene = GltfScene.of(self._source, self._path)
                shown = [k for k, placement in scene.placements.items() if "mesh" in placement.node]
                for index in shown if self._unmarked else visible_nodes(scene, convention_of(scene)):
                    mesh, linear, offset = scene.place_mesh(scene.placements[index])
                    for vertices, faces, rgba in _split_by_color(scene, scene.placements[index].node["mesh"], mesh):
                        surface = place_surface(vertices, faces, linear, offset, self._bodies.get(index))
                        found.append(replace(surface, rgba=rgba))
        except MeshForgeError:
            return []
        return found


def _split_by_color(scene: GltfScene, mesh: int, whole: GltfMesh) -> Iterator[tuple[Floats, Ints, Rgba | None]]:
    materials = list(_materials(scene.tree, entry(scene.tree, "meshes", mesh)))
    colors = [_read_color(materials[patch.index]) for patch in whole.patches]
    if len(set(colors)) == 1:
        yield whole.vertices, whole.faces, colors[0]
        return
    start = 0
    for patch, rgba in zip(whole.patches, colors, strict=True):
        yield whole.vertices[start : start + len(patch.points)], patch.faces, rgba
        start += len(patch.points)


def _read_color(material: Json) -> Rgba | None:
    """The base colour of a material; None where it says none, or has a picture."""
    shading = material.get("pbrMetallicRoughness", {})
    factor = shading.get("baseColorFactor")
    if factor is None or len(factor) != 4 or "baseColorTexture" in shading:
        return None
    red, green, blue = (np.clip(np.asarray(factor[:3], dtype=np.float64), 0, 1) ** (1 / GAMMA)).tolist()
    return round(red, 4), round(green, 4), round(blue, 4), float(factor[3])


def visible_nodes(scene: GltfScene, convention: Convention) -> list[int]:
    """The nodes of meshes that are there to be seen; none where all meshes are taken for collision."""
    if convention == "plain":
        return []
    colliding = nodes_below_colliders(scene) if convention == "unity" else frozenset()
    return [
        index
        for index, placement in scene.placements.items()
        if "mesh" in placement.node and index not in colliding and not _is_only_collision(scene, index, convention)
    ]


def _is_only_collision(scene: GltfScene, index: int, convention: Convention) -> bool:
    node = scene.placements[index].node
    names = [node.get("name"), entry(scene.tree, "meshes", node["mesh"]).get("name")]
    if convention == "unreal":
        return any(unreal_kind(name) for name in names)
    kind = next((kind for kind in map(godot_kind, names) if kind), None)
    return convention == "godot" and kind in ("colonly", "convcolonly")


def mentions_of_node(scene: GltfScene, source: NodeCollision) -> list[Mentions]:
    """What is said of each piece of a node with collision; nothing where that is damaged, which hurts no one."""
    try:
        return _collect_mentions(scene, source)
    except _DAMAGE:
        return [()] * len(source.parts)


def _collect_mentions(scene: GltfScene, source: NodeCollision) -> list[Mentions]:
    placement = scene.placements[source.node]
    node, parent = placement.node, placement.parent
    common = [("node", name_of(node))]
    mesh = entry(scene.tree, "meshes", node["mesh"]) if "mesh" in node else {}
    common += [("mesh", name_of(mesh))]
    common += [("node", name_of(scene.placements[parent].node))] if parent is not None else []
    materials = [name_of(material) for material in _materials(scene.tree, mesh)]
    own = _materials_of_pieces(scene, source, node, materials)
    return [drop_repeats([*common, *(("material", name) for name in names)]) for names in own]


def _materials_of_pieces(
    scene: GltfScene, source: NodeCollision, node: Json, materials: Sequence[str]
) -> list[list[str]]:
    if source.owner is None or "mesh" not in node:
        return [list(materials)] * len(source.parts)
    patches = scene.mesh(node["mesh"]).patches
    of_face = np.repeat([patch.index for patch in patches], [len(patch.faces) for patch in patches])
    if len(of_face) != len(source.owner):
        return [list(materials)] * len(source.parts)
    return [[materials[k] for k in np.unique(of_face[source.owner == part])] for part in range(len(source.parts))]


def _materials(tree: Json, mesh: Json) -> Iterator[Json]:
    for part in entries(mesh, "primitives"):
        yield entry(tree, "materials", part["material"]) if "material" in part else {}


def collect_notes(scene: GltfScene, convention: Convention) -> Iterator[str]:
    """The notes on a scene, whose collision was read by a convention."""
    if convention in _HOW:
        yield FileNote(_HOW[convention])
    elif "Texture" in str(entries(scene.tree, "materials")):  # else it is a mesh file as any other
        yield "no node is marked as collision: all meshes are taken for it"
    placements, tree = scene.placements, scene.tree
    colliders = [
        (extension(placement.node, physics.KHR) or {}).get("collider") or {} for placement in placements.values()
    ]
    shapes = {(collider.get("geometry") or {}).get("node") for collider in colliders}  # their meshes collide
    nodes = entries(tree, "nodes")
    outside = [k for k, node in enumerate(nodes) if k not in placements and k not in shapes and "mesh" in node]
    if outside:
        are = "is left as it is" if len(outside) == 1 else "are left as they are"
        yield FileNote(f"{pluralize(len(outside), 'node')} with a mesh outside of the scene {are}")
    if len(entries(tree, "scenes")) > 1:
        default = "the default one" if "scene" in tree else "the first, as none is the default"
        yield f"of {len(entries(tree, 'scenes'))} scenes it is {default} that is read"
    triggers = sum(physics.is_trigger(placement.node) for placement in placements.values())
    if triggers:
        yield FileNote(f"{pluralize(triggers, 'trigger')} detect bodies without colliding: they are left as they are")
    shown = [placement.node for placement in placements.values() if "mesh" in placement.node]
    if skinned := sum("skin" in node for node in shown):
        yield f"{pluralize(skinned, 'skinned mesh', 'skinned meshes')} are taken in the pose that the file has"
    meshes = [entries(entry(tree, "meshes", node["mesh"]), "primitives") for node in shown]
    if morphed := sum(any(part.get("targets") for part in parts) for parts in meshes):
        yield f"{pluralize(morphed, 'mesh', 'meshes')} with morph targets are taken without them"
    for name in entries(tree, "extensionsRequired"):
        if name not in (*_KNOWN, *_PHYSICS) and not str(name).startswith(_HARMLESS):
            yield f"the file asks for {name}, which is not known: its geometry may be meant otherwise"
