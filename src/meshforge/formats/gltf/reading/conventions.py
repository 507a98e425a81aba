"""By which convention a scene tells its collision."""

from __future__ import annotations

from meshforge.formats.gltf.document import Convention
from meshforge.formats.gltf.reading.physics import physics_of
from meshforge.formats.meshfile.gltf import Placement, Scene
from meshforge.formats.meshfile.gltf.items import entry
from meshforge.formats.naming.marks import godot_kind, holds_colliders, unreal_kind


def convention_of(scene: Scene) -> Convention:
    """The first convention of collision that a node of the scene keeps to."""
    physics = physics_of(scene)
    if physics is not None:
        return physics
    shown = [placement.node for placement in scene.placements.values() if "mesh" in placement.node]
    names = [node.get("name") for node in shown]
    names += [entry(scene.tree, "meshes", node["mesh"]).get("name") for node in shown]
    if any(unreal_kind(name) for name in names):
        return "unreal"
    if any(godot_kind(name) for name in names):
        return "godot"
    colliding = any("mesh" in scene.placements[index].node for index in below_colliders(scene))
    return "unity" if colliding else "plain"


def below_colliders(scene: Scene) -> frozenset[int]:
    """The nodes below those whose name says, for a script in Unity, that what they hold collides."""
    found: set[int] = set()
    for index, placement in scene.placements.items():
        above = placement.parent
        if above is not None and (above in found or holds_colliders(scene.placements[above].node.get("name"))):
            found.add(index)
    return frozenset(found)


def source_name(scene: Scene, placement: Placement, convention: Convention) -> str | None:
    """The name of a node that is collision by a convention: its own, or that of its mesh where that one counts."""
    own = placement.node.get("name")
    if convention not in ("unreal", "godot", "unity", "plain"):
        return own if isinstance(own, str) else None
    if "mesh" not in placement.node:
        return None
    names = [own, entry(scene.tree, "meshes", placement.node["mesh"]).get("name")]
    counts = {"unreal": unreal_kind, "godot": godot_kind}.get(convention, bool)
    return next((name for name in names if isinstance(name, str) and counts(name)), None)
