"""A MuJoCo model of the hulls of a mesh on a plane, made from the mesh itself, whatever its format."""

from typing import Any

import numpy as np

from meshforge.checks.physics import mechanism
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Pose, Shape, Sphere
from meshforge.symbolic import Hull, Inertial, Joint, SymbolicMesh

DENSITY = 1000.0
"""Of hulls of bodies without a mass that can be [kg/m^3]."""
STEP = 0.002
"""Seconds of a step."""
FLOOR = "the plane"
_DAMPING = 5.0  # of joints, [1/s] times mass or inertia: what swings comes to rest within a second
_FLOOR_BIT = 1 << 30  # of contact: every hull meets the plane by it, and no other hull
_LEAST = 1e-3  # [kg], of a moving body that has neither hulls nor mass
_UPRIGHT = Pose([[1, 0, 0], [0, 0, -1], [0, 1, 0]], [0, 0, 0])  # z-up_T_y-up


def compile_model(mesh: SymbolicMesh, tree: mechanism.JointTree, *, everything: bool = False) -> Any:
    """Return MuJoCo's model of a mesh that stands on a plane; geoms are numbered as the hulls, after the plane's.

    everything: whether all touches, which else bodies do not that a joint holds together, and what the file keeps
    apart. On the plane, a hull rubs as the file has it. Joints are damped, so that what swings comes to rest. Raises
    ValueError where MuJoCo refuses the model.
    """
    import mujoco  # lazy: 0.3 s, only the physics checks need it

    spec = mujoco.MjSpec()
    spec.option.timestep = STEP
    spec.compiler.balanceinertia = False
    if everything:
        spec.option.disableflags = int(mujoco.mjtDisableBit.mjDSBL_FILTERPARENT)
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1], name=FLOOR)
    shown = pose_on_floor(mesh)
    tops = {tree.root_of(hull.body) for hull in mesh.hulls}
    for root in tree.bodies:
        if root in tops:
            _add_body(spec, spec.worldbody, root, Pose.identity(), mesh, tree, shown)
    if not everything:
        _filter_contacts(spec, mechanism.ContactRules(mesh))
    return spec.compile()


def _filter_contacts(spec: Any, touching: mechanism.ContactRules) -> None:
    """Let touch what the file lets touch, as it rubs there; the plane meets all, and is of no weight in how."""
    plane = spec.geom(FLOOR)
    plane.contype, plane.conaffinity = 0, _FLOOR_BIT
    plane.priority = min(contact.priority for contact in touching.contacts) - 1
    for k, contact in enumerate(touching.contacts):
        geom = spec.geom(f"hull {k}")
        geom.contype, geom.conaffinity = contact.contype | _FLOOR_BIT, contact.conaffinity & ~_FLOOR_BIT
        geom.condim, geom.priority, geom.friction = contact.condim, contact.priority, contact.friction
    known = {body.name for body in spec.bodies}
    for pair in sorted(sorted(f"body {name}" for name in pair) for pair in touching.apart if len(pair) == 2):
        if known.issuperset(pair):
            spec.add_exclude(bodyname1=pair[0], bodyname2=pair[1])
    for first, second in sorted(sorted(pair) for pair in touching.paired):
        spec.add_pair(geomname1=f"hull {first}", geomname2=f"hull {second}")


def pose_on_floor(mesh: SymbolicMesh) -> Pose:
    """Return the pose shown_T_root that puts the lowest point of all hulls on the plane, with Z up."""
    turn = _UPRIGHT if mesh.asset and mesh.asset.up == "y" else Pose.identity()
    down = -turn.rotation[2]
    lowest = min(float(turn.apply(hull.shape.support(down)[None])[0, 2]) for hull in mesh.hulls)
    return Pose(turn.rotation, [0.0, 0.0, -lowest])


def _add_body(
    spec: Any, parent: Any, name: str, above: Pose, mesh: SymbolicMesh, tree: mechanism.JointTree, shown: Pose
) -> None:
    """Add a body and all below it; above: the pose world_T_parent."""
    pose = shown @ tree.bodies[name]
    local = above.inverse() @ pose
    body = parent.add_body(name=f"body {name}", pos=local.translation, quat=local.to_quaternion())
    if name not in tree.above:
        body.add_freejoint()
    for joint in tree.joints.get(name, ()):
        if joint.kind not in mechanism.WELDED_JOINTS:
            _add_joint(body, joint, pose.inverse() @ shown, _estimate_load(joint, mesh, tree))
    hulls = [(k, hull) for k, hull in enumerate(mesh.hulls) if hull.body == name]
    given = next((i for i in mesh.asset.mechanism.inertials if i.body == name), None) if mesh.asset else None
    _set_mass(body, given, pose.inverse() @ shown, bool(hulls), name in tree.joints)
    for k, hull in hulls:
        _add_hull(spec, body, f"hull {k}", hull, pose.inverse() @ shown)
    for child in tree.children_of(name):
        _add_body(spec, body, child, pose, mesh, tree, shown)


def _set_mass(body: Any, given: Inertial | None, local: Pose, has_hulls: bool, moves: bool) -> None:
    """Give a body its mass; without one that can be, its hulls have the density of water."""
    if given is not None and mechanism.find_inertial_problem(given) is None:
        turned = local.rotation @ given.inertia @ local.rotation.T
        body.explicitinertial = True
        body.mass = given.mass
        body.ipos = local.apply(given.centre[None])[0]
        body.fullinertia = [turned[0, 0], turned[1, 1], turned[2, 2], turned[0, 1], turned[0, 2], turned[1, 2]]
    elif not has_hulls and moves:
        body.explicitinertial = True
        body.mass = _LEAST
        body.ipos = np.zeros(3)
        body.inertia = np.full(3, _LEAST * 1e-3)


def _add_joint(body: Any, joint: Joint, local: Pose, reach: tuple[float, float]) -> None:
    import mujoco  # lazy: 0.3 s, only the physics checks need it

    mass, length = reach
    kind, weight = {
        "revolute": (mujoco.mjtJoint.mjJNT_HINGE, mass * length**2),
        "prismatic": (mujoco.mjtJoint.mjJNT_SLIDE, mass),
        "ball": (mujoco.mjtJoint.mjJNT_BALL, mass * length**2),
    }[joint.kind]
    added = body.add_joint(type=kind, pos=local.apply(joint.anchor[None])[0], axis=local.rotation @ joint.axis)
    added.damping = [max(joint.damping, _DAMPING * weight), 0.0, 0.0]
    if joint.limits is not None and joint.limits[0] < joint.limits[1] and joint.kind != "ball":
        factor = 180 / np.pi if joint.kind == "revolute" else 1.0
        added.limited = True
        added.range = [limit * factor for limit in joint.limits]


def _estimate_load(joint: Joint, mesh: SymbolicMesh, tree: mechanism.JointTree) -> tuple[float, float]:
    """What hangs on a joint: about how heavy [kg] that is, and how far [m] it reaches from the anchor."""
    names = [joint.child]
    for body in names:
        names += tree.children_of(body)
    hulls = [hull for hull in mesh.hulls if hull.body in names]
    inertials = [i for i in mesh.asset.mechanism.inertials if i.body in names] if mesh.asset else []
    known = {i.body: i.mass for i in inertials if mechanism.find_inertial_problem(i) is None}
    mass = sum(known.get(body, DENSITY * sum(h.volume for h in hulls if h.body == body)) for body in names)
    ends = np.concatenate([np.zeros((0, 3)), *(h.aabb.corners for h in hulls), *(i.centre[None] for i in inertials)])
    return max(mass, _LEAST), float(np.linalg.norm(ends - joint.anchor, axis=1).max(initial=0.01))


def _add_hull(spec: Any, body: Any, name: str, hull: Hull, local: Pose) -> None:
    import mujoco  # lazy: 0.3 s, only the physics checks need it

    geoms = mujoco.mjtGeom
    shape: Shape = hull.shape.move(local)
    match shape:
        case Box():
            kind, size = geoms.mjGEOM_BOX, list(shape.half)
        case Sphere():
            kind, size = geoms.mjGEOM_SPHERE, [shape.radius, 0, 0]
        case Capsule():
            kind, size = geoms.mjGEOM_CAPSULE, [shape.radius, shape.half_length, 0]
        case Cylinder():
            kind, size = geoms.mjGEOM_CYLINDER, [shape.radius, shape.half_length, 0]
        case Ellipsoid():
            kind, size = geoms.mjGEOM_ELLIPSOID, list(shape.radii)
        case _:
            spec.add_mesh(name=name, uservert=shape.vertices.ravel().tolist())
            body.add_geom(type=geoms.mjGEOM_MESH, meshname=name, name=name, density=DENSITY)
            return
    pose = shape.pose
    body.add_geom(type=kind, size=size, pos=pose.translation, quat=pose.to_quaternion(), name=name, density=DENSITY)
