"""The joint prims of a stage that is made."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshforge.asset import Joint, JointKind
from meshforge.formats.numbers import tidy
from meshforge.formats.usd.writing.specs import apply_schemas, new_prim, value
from meshforge.geometry import Floats, Pose

_TYPES: dict[JointKind, str] = {
    "fixed": "PhysicsFixedJoint",
    "revolute": "PhysicsRevoluteJoint",
    "prismatic": "PhysicsPrismaticJoint",
    "ball": "PhysicsSphericalJoint",
    "planar": "PhysicsJoint",
    "floating": "PhysicsJoint",
}
_LOCKED = ("transZ", "rotX", "rotY")  # of a planar joint, whose normal is Z


def joint_prim(holder: Any, name: str, joint: Joint, paths: dict[str, str], poses: dict[str, Pose]) -> Any:
    """The prim of a joint; paths, poses: of the links, the world being none of them."""
    spec = new_prim(holder, name, _TYPES[joint.kind])
    axis, frame = _frame(joint, poses[joint.child])
    for side, body in enumerate((joint.parent, joint.child)):
        _end(spec, side, paths.get(body), poses.get(body, Pose.identity()).inverse() @ frame)
    if joint.kind in ("revolute", "prismatic", "ball"):
        value(spec, "physics:axis", "Token", axis, uniform=True)
    if joint.limits and joint.kind in ("revolute", "prismatic"):
        low, high = (float(np.degrees(end)) if joint.kind == "revolute" else end for end in joint.limits)
        value(spec, "physics:lowerLimit", "Float", low)
        value(spec, "physics:upperLimit", "Float", high)
    _drive(spec, joint)
    if joint.kind == "planar":
        apply_schemas(spec, [f"PhysicsLimitAPI:{freedom}" for freedom in _LOCKED])
        for freedom in _LOCKED:
            value(spec, f"limit:{freedom}:physics:low", "Float", 1.0)
            value(spec, f"limit:{freedom}:physics:high", "Float", -1.0)
    return spec


def _frame(joint: Joint, child: Pose) -> tuple[str, Pose]:
    """The axis of a joint, and root_T_joint: the frame of its child where the axis is one of that frame's."""
    local = tidy(child.rotation.T @ joint.axis)
    for name, unit in zip("XYZ", np.eye(3), strict=True):
        if joint.kind not in ("planar", "floating") and np.allclose(local, unit, atol=1e-9):
            return name, Pose(child.rotation, joint.anchor)
    return "Z", Pose(child.rotation @ _onto(local), joint.anchor)


def _onto(axis: Floats) -> Floats:
    """A rotation (3, 3) that takes Z onto a unit vector (3,)."""
    side = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    side = side / np.linalg.norm(side)
    return np.column_stack([side, np.cross(axis, side), axis])


def _end(spec: Any, side: int, path: str | None, pose: Pose) -> None:
    """One end of a joint: the body, none for the world, and the frame of the joint there."""
    from pxr import Gf, Sdf

    if path is not None:
        target = Sdf.RelationshipSpec(spec, f"physics:body{side}", False)
        target.targetPathList.explicitItems = [Sdf.Path(path)]
    w, x, y, z = pose.to_quaternion().tolist()
    value(spec, f"physics:localPos{side}", "Point3f", Gf.Vec3f(*tidy(pose.translation, 1.0).tolist()))
    value(spec, f"physics:localRot{side}", "Quatf", Gf.Quatf(w, x, y, z))


def _drive(spec: Any, joint: Joint) -> None:
    """Damping and the largest effort of a joint, by a drive that aims at rest."""
    if joint.kind not in ("revolute", "prismatic") or not (joint.damping or joint.effort):
        return
    drive, unit = ("angular", np.pi / 180) if joint.kind == "revolute" else ("linear", 1.0)
    apply_schemas(spec, [f"PhysicsDriveAPI:{drive}"])
    value(spec, f"drive:{drive}:physics:type", "Token", "force", uniform=True)
    if joint.damping:
        value(spec, f"drive:{drive}:physics:damping", "Float", joint.damping * unit)
    if joint.effort:
        value(spec, f"drive:{drive}:physics:maxForce", "Float", joint.effort)
