"""Where bodies and geoms of a compiled model are in the root frame, every joint in its reference configuration."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from meshforge.geometry import Floats, Pose

if TYPE_CHECKING:
    import mujoco


def body_poses(model: mujoco.MjModel) -> list[Pose]:
    """root_T_body of all bodies. In the reference configuration no joint displaces anything, so poses only chain."""
    poses = [Pose.identity()]
    for k in range(1, model.nbody):
        parent_t_body = Pose(rotation_of(model.body_quat[k]), model.body_pos[k])
        poses.append(poses[int(model.body_parentid[k])] @ parent_t_body)
    return poses


def geom_poses(model: mujoco.MjModel, bodies: list[Pose]) -> list[Pose]:
    """root_T_geom of all geoms; of a mesh, the frame in which MuJoCo keeps its vertices, at its principal axes."""
    return [
        bodies[int(model.geom_bodyid[k])] @ Pose(rotation_of(model.geom_quat[k]), model.geom_pos[k])
        for k in range(model.ngeom)
    ]


def mesh_frame(model: mujoco.MjModel, mesh: int) -> Pose:
    """authored_T_kept: from the frame in which MuJoCo keeps a mesh's vertices to that of its scaled file."""
    return Pose(rotation_of(model.mesh_quat[mesh]), model.mesh_pos[mesh])


def rotation_of(quaternion: Floats) -> Floats:
    """The rotation (3, 3) of a quaternion w x y z of any length."""
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
