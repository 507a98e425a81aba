"""What a user should know about how a glTF scene was read."""

from __future__ import annotations

from collections.abc import Iterator

from meshforge.formats.gltf.document import Convention
from meshforge.formats.gltf.reading.physics import is_trigger
from meshforge.formats.meshfile.gltf import Scene
from meshforge.formats.meshfile.gltf.items import entries, entry
from meshforge.words import counted

_HOW: dict[Convention, str] = {
    "khr": "its colliders are those of KHR_physics_rigid_bodies",
    "omi": "its colliders are those of OMI_physics_body",
    "omi collider": "its colliders are those of OMI_collider",
    "unreal": "its collision is the nodes that Unreal takes by their names, UCX_ and the like",
    "godot": "its collision is the nodes that Godot takes by their names, -col and the like",
    "unity": "its collision is what lies below nodes called _colliders, as files for Unity have it",
}
_HARMLESS = ("KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "MSFT_texture_")
_KNOWN = ("KHR_draco_mesh_compression", "KHR_mesh_quantization", "EXT_mesh_gpu_instancing")
_PHYSICS = ("KHR_physics_rigid_bodies", "KHR_implicit_shapes", "OMI_physics_body", "OMI_physics_shape", "OMI_collider")


def scene_notes(scene: Scene, convention: Convention) -> Iterator[str]:
    """The notes on a scene, whose collision was read by a convention."""
    if convention in _HOW:
        yield _HOW[convention]
    elif "Texture" in str(entries(scene.tree, "materials")):  # else it is a mesh file as any other
        yield "no node is marked as collision: all meshes are taken for it, so that edits change what is seen"
    placements, tree = scene.placements, scene.tree
    outside = [k for k, node in enumerate(entries(tree, "nodes")) if k not in placements and "mesh" in node]
    if outside:
        yield f"{counted(len(outside), 'node')} with a mesh outside of the scene are left as they are"
    if len(entries(tree, "scenes")) > 1:
        default = "the default one" if "scene" in tree else "the first, as none is the default"
        yield f"of {len(entries(tree, 'scenes'))} scenes it is {default} that is read"
    triggers = sum(is_trigger(placement.node, tree) for placement in placements.values())
    if triggers:
        yield f"{counted(triggers, 'trigger')} detect bodies without colliding: they are left as they are"
    shown = [placement.node for placement in placements.values() if "mesh" in placement.node]
    if skinned := sum("skin" in node for node in shown):
        yield f"{counted(skinned, 'skinned mesh', 'skinned meshes')} are taken in the pose that the file has"
    if morphed := sum(_morphs(scene, node["mesh"]) for node in shown):
        yield f"{counted(morphed, 'mesh', 'meshes')} with morph targets are taken without them"
    for name in entries(tree, "extensionsRequired"):
        if name not in (*_KNOWN, *_PHYSICS) and not str(name).startswith(_HARMLESS):
            yield f"the file asks for {name}, which is not known: its geometry may be meant otherwise"


def _morphs(scene: Scene, mesh: object) -> bool:
    return any(part.get("targets") for part in entries(entry(scene.tree, "meshes", mesh), "primitives"))
