"""What MuJoCo compiled, as an asset has it: bodies, joints and masses in the root frame, hulls, and whose element
each geom is."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from meshforge.formats.collision_pieces import ShapeNames, collect_mentions
from meshforge.formats.libraries import mujoco
from meshforge.formats.mjcf.compiler import Compilation, compile_spec, compile_text, flatten, parse_text
from meshforge.formats.mjcf.document import GeomRecord, MjcfBody, MjcfTree, body_names, geom_names
from meshforge.formats.mjcf.shapes import MjcfShapes, body_poses, geom_poses
from meshforge.formats.xml import parse_numbers
from meshforge.geometry import Pose, rotation_of_quaternion
from meshforge.symbolic import Coupling, Geom, Inertial, Joint, JointKind, Mechanism, Mentions, NonConvexPiece

_INSIDE = {
    "replicate": "it is inside a <replicate>, which makes several geoms of one element",
    "frame": "it is inside a <frame> that scales what it holds",
}
_ATTACHED = "it comes out of another model, which is attached"

_KINDS: tuple[JointKind, ...] = ("floating", "ball", "prismatic", "revolute")  # in the order of MuJoCo's numbers

_ATTRIBUTES = (
    *("contype", "conaffinity", "condim", "group", "priority"),
    *("friction", "margin", "gap", "solmix", "solref", "solimp", "adhesion"),
)

_UNNAMED = "main"  # the class of all that have none


class MjcfModel:
    """The compiled model and the elements it was made of.

    is_whole: whether it is of all that the files say, not of the collision geometry alone. stand_ins: the numbers of
    spheres in the place of visual geoms that cannot be had; unweighed: of bodies of which some mass is not known.
    elements: of each geom, None for one out of another model. collides: whether each geom takes part in collisions, by
    its contact bits or by a `<pair>`.
    """

    def __init__(
        self,
        tree: MjcfTree,
        made: Compilation,
        is_whole: bool = True,
        stand_ins: frozenset[int] = frozenset(),
        unweighed: frozenset[int] = frozenset(),
    ) -> None:
        self.tree, self.flat, self.spec, self.model = tree, made.flat, made.spec, made.model
        self.is_whole, self.stand_ins, self.unweighed, self.warnings = is_whole, stand_ins, unweighed, made.warnings
        self.spec_bodies, self.spec_geoms = made.bodies, made.geoms
        self.body_names = body_names([body.name for body in made.bodies])
        self.body_of = [self.body_names[k] for k in self.model.geom_bodyid]
        self.names = geom_names([(b, geom.name) for b, geom in zip(self.body_of, made.geoms, strict=True)])
        self.elements = [self.flat.node_at(geom.info) for geom in made.geoms]
        touching = (self.model.geom_contype != 0) | (self.model.geom_conaffinity != 0)
        touching[np.concatenate([self.model.pair_geom1, self.model.pair_geom2])] = True
        self.collides: list[bool] = touching.tolist()
        self.body_poses = body_poses(self.model)
        self.geom_poses = geom_poses(self.model, self.body_poses)

    def read_pieces(self) -> tuple[tuple[Geom, ...], tuple[NonConvexPiece, ...]]:
        """The hulls, and the collision geometry that is none."""
        geoms, non_convex = [], []
        shapes, mentions = MjcfShapes(self.model), GeomMentions(self.spec_geoms, self.body_of, self.collides)
        for k, (name, body, pose) in enumerate(zip(self.names, self.body_of, self.geom_poses, strict=True)):
            if not self.collides[k]:
                continue
            part = shapes.part_of(k, pose)
            if part.shape is not None:
                contact = contact_attributes(self.model, k)
                own = mentions.of(k)
                geoms.append(Geom(name, body, part.shape, contact=contact, mentions=own, fill=part.fill))
            else:
                plane = pose if self.model.geom_type[k] == mujoco.mjtGeom.mjGEOM_PLANE else None
                non_convex.append(NonConvexPiece(name, body, part.reason, part.surface, plane, mentions.of(k)))
        return tuple(geoms), tuple(non_convex)

    @cached_property
    def bodies(self) -> tuple[MjcfBody, ...]:
        """The bodies in MuJoCo's order, the world first."""
        return tuple(self._read_body(k) for k in range(self.model.nbody))

    def _read_body(self, k: int) -> MjcfBody:
        model, body = self.model, self.spec_bodies[k]
        node = self.flat.node_at(body.info)
        return MjcfBody(
            name=self.body_names[k],
            parent=self.body_names[int(model.body_parentid[k])] if k else None,
            source=node.source if node else -1,
            start=node.element.start if node else -1,
            pose=self.body_poses[k],
            inertial=Pose(rotation_of_quaternion(model.body_iquat[k]), model.body_ipos[k]),
            mass=float(model.body_mass[k]),
            inertia=model.body_inertia[k].copy(),
            explicit=bool(body.explicitinertial),
        )

    def geom_records(self) -> tuple[GeomRecord, ...]:
        """The elements that geoms were made of, in document order; geoms without one each for itself, at the end."""
        order = {id(node): k for k, node in enumerate(self.flat.nodes)}
        copies: dict[int, list[int]] = {}
        for k, node in enumerate(self.elements):
            copies.setdefault(len(order) + k if node is None else order[id(node)], []).append(k)
        inside = self._reasons_against_edit()
        return tuple(self._record_geom(copies[key], inside) for key in sorted(copies))

    def _reasons_against_edit(self) -> dict[int, str]:
        """Why what stands inside some elements cannot be edited, by the identity of its nodes."""
        found: dict[int, str] = {}
        for top in self.flat.nodes:
            if top.tag == "replicate" or (top.tag == "frame" and "scale" in top.attributes):
                found |= {id(node): _INSIDE[top.tag] for node in top.walk() if id(node) not in found}
        return found

    def _record_geom(self, copies: list[int], inside: dict[int, str]) -> GeomRecord:
        node = self.elements[copies[0]]
        fixed = _ATTACHED if node is None else inside.get(id(node), "")
        return GeomRecord(
            source=node.source if node else -1,
            start=node.element.start if node else -1,
            body=self.body_of[copies[0]],
            names=tuple(self.names[k] for k in copies),
            collides=any(self.collides[k] for k in copies),
            fixed=fixed,
        )


def compile_tree(tree: MjcfTree) -> MjcfModel:
    """The model of all that a tree says. Raises AssetError with MuJoCo's message."""
    return MjcfModel(tree, compile_text(tree, flatten(tree)))


def compile_unscaled(compiled: MjcfModel) -> MjcfModel:
    """A whole model with masses before they are scaled to a total, and free bodies in their authored frames."""
    tree = compiled.tree
    changing = {"compiler": {"settotalmass", "alignfree"}} | {tag: {"align"} for tag in ("freejoint", "joint")}
    if not compiled.is_whole or not any(
        changing.get(node.tag, set()) & node.attributes.keys() for node in tree.root.walk()
    ):
        return compiled
    spec = parse_text(tree, compiled.flat)
    spec.compiler.settotalmass = -1
    spec.compiler.alignfree = False
    for joint in spec.joints:
        joint.align = 0
    return MjcfModel(tree, compile_spec(tree, compiled.flat, spec))


def read_mechanism(compiled: MjcfModel) -> Mechanism:
    """The mechanism of a model, `<exclude>` and `<pair>` too; a body without a joint is fixed to its parent."""
    couplings = _read_couplings(compiled.tree)
    joints = [
        replace(joint, coupling=couplings.get(joint.name))
        for k in range(1, compiled.model.nbody)
        for joint in _read_joints(compiled, k)
    ]
    inertials = [i for k in range(1, compiled.model.nbody) if (i := _read_inertial(compiled, k)) is not None]
    bodies, signatures = compiled.body_names, map(int, compiled.model.exclude_signature)
    excludes = [(bodies[s >> 16], bodies[s & 0xFFFF]) for s in signatures]  # as MuJoCo packs two numbers of bodies
    geoms = zip(compiled.model.pair_geom1, compiled.model.pair_geom2, strict=True)
    pairs = [(compiled.names[int(first)], compiled.names[int(second)]) for first, second in geoms]
    return Mechanism(tuple(joints), tuple(inertials), tuple(excludes), tuple(pairs))


def _read_couplings(tree: MjcfTree) -> dict[str, Coupling]:
    """The first coupling of each joint that follows another one; MuJoCo counts from the reference, as we do."""
    found: dict[str, Coupling] = {}
    for node in tree.root.each("equality"):
        for child in node.children:
            if child.is_coupling:
                numbers = parse_numbers(child.attributes.get("polycoef", "")) or []
                numbers += (0.0, 1.0, 0.0, 0.0, 0.0)[len(numbers) :]
                count = max((k for k, number in enumerate(numbers) if number), default=0) + 1
                coupling = Coupling(child.attributes["joint2"], tuple(numbers[: max(2, count)]))
                found.setdefault(child.attributes.get("joint1", ""), coupling)
    return found


def _read_joints(compiled: MjcfModel, body: int) -> list[Joint]:
    model = compiled.model
    child, parent = compiled.body_names[body], compiled.body_names[int(model.body_parentid[body])]
    first, count = int(model.body_jntadr[body]), int(model.body_jntnum[body])
    if not count:
        pose = compiled.body_poses[body]
        return [Joint("", "fixed", parent, child, pose.translation, pose.rotation[:, 0])]
    return [_read_joint(compiled, k, parent, child) for k in range(first, first + count)]


def _read_joint(compiled: MjcfModel, k: int, parent: str, child: str) -> Joint:
    model, pose = compiled.model, compiled.body_poses[int(compiled.model.jnt_bodyid[k])]
    kind, dof = _KINDS[int(model.jnt_type[k])], int(model.jnt_dofadr[k])
    limits = None
    if model.jnt_limited[k] and kind in ("prismatic", "revolute"):
        zero = float(model.qpos0[model.jnt_qposadr[k]])
        limits = float(model.jnt_range[k, 0]) - zero, float(model.jnt_range[k, 1]) - zero
    return Joint(
        model.joint(k).name,
        kind,
        parent,
        child,
        pose.apply(model.jnt_pos[k][None])[0],
        pose.rotation @ model.jnt_axis[k],
        limits,
        damping=float(np.ravel(model.dof_damping[dof])[0]),
        friction=float(np.ravel(model.dof_frictionloss[dof])[0]),
        effort=float(model.jnt_actfrcrange[k, 1]) if model.jnt_actfrclimited[k] else None,
    )


def _read_inertial(compiled: MjcfModel, k: int) -> Inertial | None:
    body = compiled.bodies[k]
    if body.mass <= 0:
        return None
    frame = body.pose @ body.inertial
    inertia = frame.rotation @ np.diag(body.inertia) @ frame.rotation.T
    return Inertial(body.name, body.mass, frame.translation, inertia)


def contact_attributes(model: mujoco.MjModel, geom: int) -> tuple[tuple[str, str], ...]:
    """Names and values of what decides how a geom collides, defaults and classes included."""
    numbers = {name: np.atleast_1d(getattr(model, f"geom_{name}")[geom]).tolist() for name in _ATTRIBUTES}
    return tuple((k, " ".join(str(n) if isinstance(n, int) else f"{n:g}" for n in own)) for k, own in numbers.items())


class GeomMentions:
    """What is said of the geoms of one model, in its order; collides: whether each takes part in collisions."""

    def __init__(self, geoms: Sequence[mujoco.MjsGeom], bodies: Sequence[str], collides: Sequence[bool]) -> None:
        self.geoms, self.bodies, self.collides = geoms, bodies, collides

    def of(self, k: int) -> Mentions:
        """What is said of the k-th geom."""
        geom, shown = self.geoms[k], self._visual_names.get(self.bodies[k], [])
        kind = geom.classname.name if geom.classname else ""
        return collect_mentions(_names_of(geom), shown, [("class", kind)] if kind != _UNNAMED else [])

    @cached_property
    def _visual_names(self) -> dict[str, list[ShapeNames]]:
        found: dict[str, list[ShapeNames]] = {}
        for geom, body, collides in zip(self.geoms, self.bodies, self.collides, strict=True):
            if not collides:
                found.setdefault(body, []).append(_names_of(geom, geom.name))
        return found


def _names_of(geom: mujoco.MjsGeom, name: str = "") -> ShapeNames:
    place: Hashable = (geom.type, *geom.size.tolist(), *geom.pos.tolist(), *geom.quat.tolist())
    return ShapeNames(geom.meshname or place, name, geom.meshname, geom.material)
