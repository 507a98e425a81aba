"""The nodes of a scene that are rigid bodies, and where they are."""

from __future__ import annotations

import numpy as np

from meshforge.formats.gltf.reading.physics import is_body
from meshforge.formats.meshfile.gltf import Placement, Scene
from meshforge.geometry import Pose


def body_nodes(scene: Scene) -> dict[int, int]:
    """For each node of the scene in a body, the node that is that body: itself, or the nearest one above."""
    found: dict[int, int] = {}
    for index, placement in scene.placements.items():
        if is_body(placement.node):
            found[index] = index
        elif placement.parent in found:
            found[index] = found[placement.parent]
    return found


def rigid(placement: Placement) -> Pose:
    """The pose of a node without its scale: the rotation nearest to its map."""
    left, _, right = np.linalg.svd(placement.linear)
    rotation = left @ right
    if np.linalg.det(rotation) < 0:
        rotation = left @ np.diag([1.0, 1.0, -1.0]) @ right
    return Pose(rotation, placement.offset)
