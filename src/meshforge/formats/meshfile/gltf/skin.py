"""Skinned meshes in the pose that the file has them in."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from meshforge.formats.meshfile.gltf.items import Json, entries, entry
from meshforge.formats.meshfile.gltf.meshes import Patch, Triangles
from meshforge.geometry import Floats

if TYPE_CHECKING:
    from meshforge.formats.meshfile.gltf.scene import Scene


def posed(scene: Scene, node: Json, mesh: Triangles) -> Triangles:
    """The triangles of a node's skinned mesh in the root frame. Raises ValueError: its skin is damaged."""
    bones = _bones(scene, entry(scene.tree, "skins", node["skin"]))
    parts = entries(entry(scene.tree, "meshes", node["mesh"]), "primitives")
    moved = [_moved(scene, patch, parts[patch.index]["attributes"], bones) for patch in mesh.patches]
    return replace(mesh, vertices=np.concatenate([np.empty((0, 3)), *moved]))


def _bones(scene: Scene, skin: Json) -> Floats:
    """What each joint does to the mesh (j, 4, 4): the place of the joint after the inverse of its bind matrix."""
    joints = entries(skin, "joints")
    for joint in joints:
        if joint not in scene.placements:
            raise ValueError(f"joint {joint!r} of a skin is not in the scene")
    worlds = np.array([scene.placements[joint].world for joint in joints])
    if "inverseBindMatrices" not in skin:
        return worlds
    inverse = scene.buffers.accessor(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
    return np.asarray(worlds @ inverse[: len(joints)])


def _moved(scene: Scene, patch: Patch, attributes: Json, bones: Floats) -> Floats:
    """The points (n, 3) of a primitive, each moved by its joints."""
    total = np.zeros((len(patch.points), 4, 4))
    for number in range(8):
        if f"JOINTS_{number}" not in attributes:
            break
        joints = _values(scene, patch, attributes, f"JOINTS_{number}").astype(np.int64)
        weights = _values(scene, patch, attributes, f"WEIGHTS_{number}")
        total += np.einsum("nk,nkij->nij", weights, bones[joints])
    weight = total[:, 3, 3]
    if not (weight > 0).all():
        raise ValueError("a vertex of a skinned mesh hangs on no joint")
    moved = np.einsum("nij,nj->ni", total, np.column_stack([patch.points, np.ones(len(patch.points))]))
    return np.asarray(moved[:, :3] / weight[:, None])


def _values(scene: Scene, patch: Patch, attributes: Json, name: str) -> Floats:
    if patch.decoded is not None and name in patch.decoded.attributes:
        return patch.decoded.attributes[name].astype(np.float64)
    return scene.buffers.accessor(attributes[name]).astype(np.float64)
