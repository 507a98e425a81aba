"""Joints of a stage that make trees of its bodies, and masses of these, said or by colliders, in the root frame."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from meshforge import geometry
from meshforge.formats.collision_pieces import CollisionPiece
from meshforge.formats.libraries import pxr
from meshforge.formats.usd.colliders import FILTERED, PrimCollision, StageBodies, physics_material
from meshforge.formats.usd.stage import BODY, UsdStage, rotation_of
from meshforge.geometry import Floats, Polytope, Pose, Shape
from meshforge.symbolic import Geom, Inertial, Joint, JointKind, Mechanism

_KINDS: dict[str, JointKind] = {
    "PhysicsRevoluteJoint": "revolute",
    "PhysicsPrismaticJoint": "prismatic",
    "PhysicsFixedJoint": "fixed",
    "PhysicsSphericalJoint": "ball",
}
_AXES = {"X": np.eye(3)[0], "Y": np.eye(3)[1], "Z": np.eye(3)[2]}
_DENSITY = 1000.0  # [kg/m^3], where nothing says another one
_STILL = 1e-6  # rad, below which a turn is the rounding of single precision


def read_mechanism(scene: UsdStage, bodies: StageBodies, geoms: Sequence[Geom]) -> Mechanism:
    """Return joints, masses, pairs apart; joints that close a loop, or of kinds that no tree has, are left out."""
    if not bodies.prims:
        return Mechanism()
    hulls: dict[str, list[Shape]] = {name: [] for name in (BODY, *bodies.names.values())}
    for geom in geoms:
        hulls[geom.body].append(geom.shape)
    named = [(prim, bodies.names[path]) for path, prim in bodies.prims.items()]
    found = (read_inertial(scene, prim, name, hulls[name]) for prim, name in named)
    inertials = tuple(inertial for inertial in found if inertial is not None)
    prims = [prim for prim in scene.prims() if prim.IsA(pxr.UsdPhysics.Joint)]
    enabled = [prim for prim in prims if scene.get(prim.GetAttribute("physics:jointEnabled")) is not False]
    joints = _keep_trees(joint for prim in enabled if (joint := _read_joint(scene, prim, bodies)))
    bodies.used |= any(BODY in (joint.parent, joint.child) for joint in joints)
    return Mechanism(tuple(joints), inertials, _read_filtered_pairs(bodies))


def _read_filtered_pairs(bodies: StageBodies) -> tuple[tuple[str, str], ...]:
    """The pairs of bodies that are filtered; pairs of colliders, or with articulations, are left out."""
    found = []
    for path, prim in bodies.prims.items():
        relationship = prim.GetRelationship(FILTERED)
        targets = relationship.GetForwardedTargets() if relationship else []
        found += [(bodies.names[path], bodies.names[str(t)]) for t in targets if str(t) in bodies.names]
    return tuple(found)


def _read_joint(scene: UsdStage, prim: Any, bodies: StageBodies) -> Joint | None:
    """A joint; None for one to the world that only holds a body in its place, and for kinds that no tree has."""
    ends = [_read_end(scene, prim, side, bodies) for side in "01"]
    kind, axis, limits = _read_freedom(scene, prim)
    (parent, first), (child, second) = ends
    if kind is None or parent == child or (kind == "fixed" and BODY in (parent, child)):
        return None
    if child == BODY:
        parent, child, first, second = child, parent, second, first
        axis = -axis
    unit = np.pi / 180 if kind == "revolute" else scene.metres
    empty = limits if limits and limits[0] > limits[1] else None
    limits = None if empty else limits
    if limits is not None:
        now = _joint_position(kind, axis, first, second, scene.metres)
        limits = limits[0] * unit - now, limits[1] * unit - now
    return Joint(
        prim.GetName(), kind, parent, child, second.translation, first.rotation @ axis, limits, empty_limits=empty
    )


def _read_end(scene: UsdStage, prim: Any, side: str, bodies: StageBodies) -> tuple[str, Pose]:
    """The body at an end of a joint, and root_T_joint as this end has it."""
    targets = prim.GetRelationship(f"physics:body{side}").GetForwardedTargets()
    body, root_t_end, linear, offset = BODY, Pose.identity(), scene.metres * np.eye(3), np.zeros(3)
    target = scene.stage.GetPrimAtPath(targets[0]) if targets else None
    if target:
        body, root_t_end = bodies.of_joint(target), scene.pose(target)
        linear, offset = scene.placement(target)
    place, turn = (scene.get(prim.GetAttribute(f"physics:local{what}{side}")) for what in ("Pos", "Rot"))
    at = linear @ np.array(place or (0, 0, 0), dtype=np.float64) + offset
    rotation = root_t_end.rotation @ _rotation_of_value(turn)
    return body, Pose(rotation_of(rotation), at)


def _read_freedom(scene: UsdStage, prim: Any) -> tuple[JointKind | None, Floats, tuple[float, float] | None]:
    """The kind of a joint, its axis (3,) in its own frame, and its limits in the units of the file."""
    kind = _KINDS.get(str(prim.GetTypeName()))
    axis = _AXES.get(str(scene.get(prim.GetAttribute("physics:axis")) or "X"), _AXES["X"])
    low, high = (read_number(scene, prim, f"physics:{end}Limit") for end in ("lower", "upper"))
    limited = kind in ("revolute", "prismatic") and low is not None and high is not None
    return kind, axis, (low, high) if limited and low is not None and high is not None else None


def _joint_position(kind: JointKind, axis: Floats, first: Pose, second: Pose, metres: float) -> float:
    """Where a joint is in the stage, [rad] or [m] from the zero of its limits."""
    if kind == "prismatic":
        return float((first.rotation @ axis) @ (second.translation - first.translation))
    turn = first.rotation.T @ second.rotation
    sine = axis @ np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
    angle = float(np.arctan2(sine, (np.trace(turn) - 1) / 2))
    return angle if abs(angle) > _STILL else 0.0


def _keep_trees(joints: Iterable[Joint]) -> list[Joint]:
    """The joints that make trees, in order; where its child hangs elsewhere already, one is turned round."""
    root: dict[str, str] = {}
    parents: dict[str, str] = {}

    def top(name: str) -> str:
        while name in root:
            name = root[name]
        return name

    kept = []
    for joint in joints:
        if parents.get(joint.child) == joint.parent:
            kept.append(joint)
            continue
        if top(joint.parent) == top(joint.child):
            continue
        if joint.child in parents or joint.child == BODY:
            joint = replace(joint, parent=joint.child, child=joint.parent, axis=-joint.axis)
        if joint.child in parents or joint.child == BODY:
            continue
        parents[joint.child] = joint.parent
        root[top(joint.child)] = top(joint.parent)
        kept.append(joint)
    return kept


def read_inertial(scene: UsdStage, prim: Any, body: str, hulls: Sequence[Shape]) -> Inertial | None:
    """Return what a body weighs by what it says itself; hulls: of the body, whose inertia it has where it says none.

    None where it leaves its mass to the density of its colliders, or where nothing says its inertia.
    """
    mass = read_number(scene, prim, "physics:mass")
    if mass is None or mass <= 0:
        return None
    mass *= scene.kilograms
    centre, moments = centre_of(scene, prim), moments_of(scene, prim)
    if moments is None:
        return Inertial(body, mass, *geometry.inertia(hulls, mass, centre)) if hulls else None
    if centre is None:
        centre = geometry.inertia(hulls, mass)[0] if hulls else scene.pose(prim).translation
    return Inertial(body, mass, centre, moments)


def read_number(scene: UsdStage, prim: Any, name: str) -> float | None:
    """Return an authored number of a prim, None where there is none that is finite."""
    attribute = prim.GetAttribute(name)
    value = scene.get(attribute) if attribute and attribute.HasAuthoredValue() else None
    return float(value) if value is not None and np.isfinite(value) else None


def centre_of(scene: UsdStage, prim: Any) -> Floats | None:
    """Return the centre of mass (3,) [m] that a body says; minus infinity stands for none."""
    value = scene.get(prim.GetAttribute("physics:centerOfMass"))
    if value is None or not np.isfinite(value).all():
        return None
    linear, offset = scene.placement(prim)
    centre: Floats = linear @ np.array(value, dtype=np.float64) + offset
    return centre


def moments_of(scene: UsdStage, prim: Any) -> Floats | None:
    """Return the inertia (3, 3) [kg m^2] that a body says, None where its moments are not all positive."""
    moments = scene.get(prim.GetAttribute("physics:diagonalInertia"))
    axes = scene.get(prim.GetAttribute("physics:principalAxes"))
    if moments is None or not np.isfinite(moments).all() or min(moments) <= 0:
        return None
    turn = scene.pose(prim).rotation @ _rotation_of_value(axes)
    unit = scene.kilograms * scene.metres**2
    return np.asarray(turn @ np.diag(np.array(moments, dtype=np.float64) * unit) @ turn.T)


def _rotation_of_value(quaternion: Any) -> Floats:
    """The rotation (3, 3) of a quaternion of the library; none at all for None, and for one that is zero."""
    parts = np.zeros(4) if quaternion is None else np.array([quaternion.GetReal(), *quaternion.GetImaginary()], float)
    length = np.linalg.norm(parts)
    return geometry.rotation_of_quaternion(parts) if np.isfinite(length) and length > 0 else np.eye(3)


def weigh(scene: UsdStage, prim: Any, body: str, sources: Sequence[PrimCollision]) -> Inertial | None:
    """Return what a body weighs by all that its stage says, colliders included; None where a volume is not known."""
    pieces = [(source, _solids_of(source.parts)) for source in sources]
    solids = [(source, shapes) for source, shapes in pieces if shapes]
    if not solids or any(shapes is None for _, shapes in pieces):
        return None
    masses = [(shapes, _mass_of(scene, prim, source, shapes)) for source, shapes in solids]
    weights = [(mass, *geometry.inertia(shapes, mass)) for shapes, mass in masses]
    total, centre, summed = geometry.combine_inertias(weights, centre_of(scene, prim))
    authored_value, moments = read_number(scene, prim, "physics:mass"), moments_of(scene, prim)
    mass = authored_value * scene.kilograms if authored_value is not None and authored_value > 0 else total
    return Inertial(body, mass, centre, mass / total * summed if moments is None else moments)


def _solids_of(parts: Sequence[CollisionPiece]) -> list[Shape] | None:
    """The solids of a prim's pieces, of closed non-convex ones too; None where one has no volume that is known."""
    found: list[Shape] = []
    for part in parts:
        if part.shape is not None:
            found.append(part.shape)
        elif part.surface is not None and len(part.surface.faces) and geometry.is_closed(part.surface.faces):
            found.append(Polytope(part.surface.vertices, part.surface.faces))
        else:
            return None
    return found if all(shape.volume > 0 for shape in found) else None


def _mass_of(scene: UsdStage, body: Any, source: PrimCollision, shapes: Sequence[Shape]) -> float:
    """The mass [kg] of a collider: its own, else by density, its own, its body's or its material's."""
    volume = sum(shape.volume for shape in shapes)
    own = read_number(scene, source.prim, "physics:mass") if source.prim != body else None
    if own is not None and own > 0:
        return own * scene.kilograms
    material = physics_material(source.prim)
    for prim in (source.prim, body, *([material] if material else [])):
        density = read_number(scene, prim, "physics:density")
        if density is not None and density > 0:
            return volume * density * scene.kilograms / scene.metres**3
    return volume * _DENSITY
