"""Reading a glTF file or GLB: from its bytes to an asset, with what it shows, notes, and names that mark nothing."""

import difflib
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from urllib.parse import unquote

import numpy as np

from meshforge.common import AssetError, MeshForgeError, file_digest, nearest_name, pluralize
from meshforge.formats import collision_pieces, mesh_reader, references
from meshforge.formats.collision_pieces import build_pieces, drop_repeats, place_surface
from meshforge.formats.engine_names import COLLIDERS, godot_kind, holds_colliders, unreal_kind
from meshforge.formats.gltf import physics
from meshforge.formats.gltf.colliders import CollisionReader, NodeCollision, convention_of, names_of, visible_nodes
from meshforge.formats.gltf.document import BODY, Convention, GltfDocument, NodeRecord
from meshforge.formats.gltf.draft import name_of
from meshforge.formats.meshfile.gltf_document import Json, entries, entry, extension, report_damage
from meshforge.formats.meshfile.gltf_meshes import GltfMesh
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.formats.visuals import LazySurfaces, screen_color
from meshforge.geometry import Floats, Ints, Pose
from meshforge.symbolic import Asset, Body, FileNote, Mentions, NameProblem, Rgba, Surface, unique_names

_HOW: dict[Convention, str] = {
    "khr": "its colliders are those of KHR_physics_rigid_bodies",
    "omi": "its colliders are those of OMI_physics_body",
    "unreal": "its collision is the nodes that Unreal takes by their names, UCX_ and the like",
    "godot": "its collision is the nodes that Godot takes by their names, -col and the like",
    "unity": "its collision is what lies below nodes called _colliders, as files for Unity have it",
}
_HARMLESS = ("KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "MSFT_texture_")
_KNOWN = ("KHR_draco_mesh_compression", "KHR_mesh_quantization")
_DRAFTS = {"OMI_collider": "OMI_physics_shape", "KHR_collision_shapes": "KHR_implicit_shapes"}
"""What physics extensions were called in drafts of them."""


def read_gltf(path: Path) -> Asset:
    """Return the asset in a glTF file or GLB.

    Raises AssetError: damaged, compressed in a way that is not read, a buffer is missing, or there is nothing in it.
    """
    source = mesh_reader.read_content(path)
    with report_damage(str(path)):
        scene = GltfScene.of(source, path)
        _refuse_drafts(scene.tree, path)
        reader = CollisionReader(scene)
        sources = reader.read()
        owners, bodies = _name_bodies(scene)
        nodes = [*(source.node for source in sources), *visible_nodes(scene, reader.convention)]
        fixed = not bodies or any(node not in owners for node in nodes)  # something is part of no rigid body
        notes = [*_collect_notes(scene, reader.convention), *reader.notes]
        authored = _record_nodes(sources, owners)
        mentions = [_mentions_of_node(scene, source) for source in sources]
        geoms, non_convex = build_pieces(authored, [source.parts for source in sources], mentions)
        digests = tuple((file, file_digest(file)) for file in scene.buffers.files() if file.is_file())
    if not sources:
        raise AssetError("there is no mesh and no collider in its scene", where=str(path))
    moving = [Body(name, physics.rigid_pose_of(scene.placements[node])) for node, name in bodies.items()]
    files, missing = _find_files(scene, path)
    is_named = reader.convention not in physics.EXTENSIONS
    problems = _find_name_problems(scene, reader.convention, [geom.name for geom in geoms[:1]]) if is_named else ()
    return Asset(
        path=path,
        format="gltf",
        bodies=(*([Body(BODY, Pose.identity())] if fixed else []), *moving),
        geoms=geoms,
        document=GltfDocument(source, reader.convention, authored, tuple(bodies.items()), digests),
        non_convex=non_convex,
        visuals=() if reader.convention == "plain" else SceneSurfaces(source, path),
        files=files,
        missing=missing,
        notes=tuple(notes),
        up="y",
        name_problems=tuple(problems),
    )


def _find_name_problems(scene: GltfScene, marks: str, first: Sequence[str]) -> Iterator[NameProblem]:
    names = [("mesh" in one.node, names_of(scene.tree, one.node)) for one in scene.placements.values()]
    bare = [own[0] for has_mesh, own in names if own and not has_mesh]
    return find_name_problems([own for has_mesh, own in names if has_mesh], bare, marks, *first)


def _refuse_drafts(tree: Json, path: Path) -> None:
    used = entries(tree, "extensionsUsed")
    for name in (name for name in _DRAFTS if name in used or extension(tree, name) is not None):
        problem = f"its colliders are those of {name}, a draft of {_DRAFTS[name]}, which is not read"
        raise AssetError(problem, where=str(path), remedy=f"Export it with {_DRAFTS[name]}.")


def _name_bodies(scene: GltfScene) -> tuple[dict[int, str], dict[int, str]]:
    """Return the body of each node in a rigid body, and that of each node that is one, by their names."""
    owners = physics.body_nodes(scene)
    nodes = list(dict.fromkeys(owners.values()))
    wanted = [name_of(scene.placements[node].node) or f"body{k}" for k, node in enumerate(nodes)]
    names = dict(zip(nodes, unique_names([BODY, *wanted])[1:], strict=True))
    return {node: names[owner] for node, owner in owners.items()}, names


def _record_nodes(sources: Sequence[NodeCollision], bodies: Mapping[int, str]) -> tuple[NodeRecord, ...]:
    """The sources with the names of their pieces; names begin with the body where the file has rigid bodies."""
    own = [bodies.get(source.node, BODY) for source in sources]
    named = [(body if bodies else None, s.name, len(s.parts)) for body, s in zip(own, sources, strict=True)]
    return tuple(
        NodeRecord(body, names, source.node, source.owner)
        for source, body, names in zip(sources, own, collision_pieces.name_element_pieces(named), strict=True)
    )


def _find_files(scene: GltfScene, path: Path) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    found = references.find_companions(path)
    uris = [e.get("uri") for key in ("buffers", "images") for e in entries(scene.tree, key) if isinstance(e, dict)]
    named = [uri for uri in uris if isinstance(uri, str) and not uri.startswith("data:")]
    there = {(path.parent / key).resolve() for key in found}
    missing = [uri for uri in named if (path.parent / unquote(uri)).resolve() not in there]
    return tuple(dict.fromkeys(found.values())), tuple(dict.fromkeys(missing))


class SceneSurfaces(LazySurfaces):
    """The visible surfaces of a file, none where it is damaged.

    unmarked: whether meshes are seen that are taken for collision as nothing is marked.
    """

    def __init__(self, source: bytes, path: Path, *, unmarked: bool = False) -> None:
        self._source, self._path, self._unmarked = source, path, unmarked

    def _make(self) -> list[Surface]:
        found = []
        try:
            with report_damage(str(self._path)):
                scene = GltfScene.of(self._source, self._path)
                bodies, _ = _name_bodies(scene)
                shown = [k for k, placement in scene.placements.items() if "mesh" in placement.node]
                for index in shown if self._unmarked else visible_nodes(scene, convention_of(scene)):
                    if "skin" in scene.placements[index].node:
                        continue
                    mesh, linear, offset = scene.place_mesh(scene.placements[index])
                    for vertices, faces, rgba in _split_by_color(scene, scene.placements[index].node["mesh"], mesh):
                        surface = place_surface(vertices, faces, linear, offset, bodies.get(index))
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
    return screen_color(np.asarray(factor[:3], dtype=np.float64).tolist(), float(factor[3]))


def _mentions_of_node(scene: GltfScene, source: NodeCollision) -> list[Mentions]:
    """What is said of each piece of a node with collision; nothing where that is damaged, which hurts no one."""
    placement = scene.placements[source.node]
    node, parent, count = placement.node, placement.parent, len(source.parts)
    try:
        mesh = entry(scene.tree, "meshes", node["mesh"]) if "mesh" in node else {}
        above = name_of(scene.placements[parent].node) if parent is not None else ""
        common = [("node", name_of(node)), ("mesh", name_of(mesh)), ("node", above)]
        materials = [name_of(material) for material in _materials(scene.tree, mesh)]
        of_piece = [materials] * count
        if source.owner is not None and mesh:
            patches = scene.mesh(node["mesh"]).patches
            of_face = np.repeat([patch.index for patch in patches], [len(patch.faces) for patch in patches])
            if len(of_face) == len(source.owner):
                used = [np.unique(of_face[source.owner == part]).tolist() for part in range(count)]
                of_piece = [[materials[k] for k in own] for own in used]
        return [drop_repeats([*common, *(("material", name) for name in names)]) for names in of_piece]
    except (ValueError, LookupError, TypeError, AttributeError):
        return [()] * count


def _materials(tree: Json, mesh: Json) -> Iterator[Json]:
    for part in entries(mesh, "primitives"):
        yield entry(tree, "materials", part["material"]) if "material" in part else {}


def _collect_notes(scene: GltfScene, convention: Convention) -> Iterator[str]:
    if convention in _HOW:
        yield FileNote(_HOW[convention])
    elif "Texture" in str(entries(scene.tree, "materials")):  # else it is a mesh file as any other
        yield "no node is marked as collision: all meshes are taken for it"
    placements, tree = scene.placements, scene.tree
    colliders = [(extension(one.node, physics.KHR) or {}).get("collider") or {} for one in placements.values()]
    shapes = {(collider.get("geometry") or {}).get("node") for collider in colliders}  # their meshes collide
    nodes = entries(tree, "nodes")
    outside = [k for k, node in enumerate(nodes) if k not in placements and k not in shapes and "mesh" in node]
    if outside:
        are = "is left as it is" if len(outside) == 1 else "are left as they are"
        yield FileNote(f"{pluralize(len(outside), 'node')} with a mesh outside of the scene {are}")
    if len(entries(tree, "scenes")) > 1:
        default = "the default one" if "scene" in tree else "the first, as none is the default"
        yield f"of {len(entries(tree, 'scenes'))} scenes it is {default} that is read"
    triggers = sum(
        any("trigger" in (extension(one.node, name) or {}) for name in (physics.KHR, physics.OMI))
        for one in placements.values()
    )
    if triggers:
        yield FileNote(f"{pluralize(triggers, 'trigger')} detect bodies without colliding: they are left as they are")
    if heavy := sum(physics.says_mass(one.node) for one in placements.values()):
        yield FileNote(f"not read: {pluralize(heavy, 'mass', 'masses')}; in checks the hulls have the density of water")
    shown = [placement.node for placement in placements.values() if "mesh" in placement.node]
    if skinned := sum("skin" in node for node in shown):
        yield f"what skins move is not read, and left as it is: {pluralize(skinned, 'mesh', 'meshes')}"
    meshes = [entries(entry(tree, "meshes", node["mesh"]), "primitives") for node in shown]
    if morphed := sum(any(part.get("targets") for part in parts) for parts in meshes):
        yield f"{pluralize(morphed, 'mesh', 'meshes')} with morph targets are taken without them"
    known = (*_KNOWN, *(name for one in physics.EXTENSIONS.values() for name in (one.name, one.shapes)))
    for name in entries(tree, "extensionsRequired"):
        if name not in known and not str(name).startswith(_HARMLESS):
            yield f"the file asks for {name}, which is not known: its geometry may be meant otherwise"


_ALIKE = 0.82  # how alike the end of a name and a mark are, from which on it was meant: `colony` and `colonly` are 0.92
_GODOT = ("convcolonly", "colonly", "convcol")
_UNREAL = re.compile(r"(?:UCX|UBX|UXC|UXB)(?=[^a-z])")
_MARKS: Mapping[str, Callable[[str], object]] = {"unreal": unreal_kind, "godot": godot_kind, "unity": holds_colliders}
_CHANGED = re.compile(r"[^\w-]+")  # in Unreal an underscore
_REMEDY = "Is {} meant? Spell it so."


def find_name_problems(
    meshes: Iterable[Sequence[str]], parents: Collection[str] = (), marks: str = "", hull: str = ""
) -> Iterator[NameProblem]:
    """Yield what is wrong with the names of meshes and of their nodes, several of one thing, and of nodes without a
    mesh. marks: the engine whose marks are read, if any; hull: the first hull by them."""
    things = [names for names in meshes if names]
    every = [*parents, *(name for names in things for name in names)]
    for engine in (one for one, bears in _MARKS.items() if marks in _MARKS and not any(map(bears, every))):
        title = engine.capitalize()
        problem = f"{title} takes no mark of {marks.capitalize()}, so that nothing collides by it"
        remedy = f"Mark it for {title}: meshforge convert FILE OUT --names {engine}."
        yield NameProblem(engine, hull, problem, remedy, is_hull=True)
    seen = [name for names in things if not any(map(unreal_kind, names)) for name in names]
    known = {_CHANGED.sub("_", name.lower()) for name in seen}
    for own in (next(filter(unreal_kind, names)) for names in things if any(map(unreal_kind, names))):
        whole = _CHANGED.sub("_", own[4:])
        wanted = whole.rpartition("_")[0] or whole
        if known.isdisjoint((whole.lower(), wanted.lower())):
            nearest = nearest_name(wanted, seen) or next(iter(seen), wanted)
            problem = f"no mesh is called {wanted}, so that in Unreal nothing collides by it"
            rename = f"The nearest mesh is {nearest}: call it {own[:4]}{nearest}_00."
            remedy = rename if seen else f"There is no mesh to be seen: add {wanted}."
            yield NameProblem("unreal", own, problem, remedy, is_hull=True)
    for name in filter(_UNREAL.match, dict.fromkeys(seen)):
        yield NameProblem("unreal", name, remedy=_REMEDY.format("UCX_" if "C" in name[:3] else "UBX_"))
    for names in things:
        meant = [mark for name in names for mark in _find_meant(name, _GODOT) if not any(map(godot_kind, names))]
        yield from (NameProblem("godot", names[0], remedy=_REMEDY.format(f"-{mark}")) for mark in meant[:1])
    for name in parents:
        if not holds_colliders(name) and _find_meant(name, [COLLIDERS[1:]]):
            yield NameProblem("unity", name, remedy=_REMEDY.format(COLLIDERS))


def _find_meant(name: str, marks: Sequence[str]) -> list[str]:
    words = re.split(r"[-_$. ]+", re.sub(r"[0-9\x00-\x20_.]+\Z", "", name).lower())
    ends = ["".join(words[-2:]), words[-1]] if len(words) > 1 else []
    close = [mark for end in ends for mark in difflib.get_close_matches(end, marks, 1, _ALIKE)]
    return close or [mark for mark in marks if words[-1].endswith(mark)]
