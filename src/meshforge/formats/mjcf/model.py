"""What MuJoCo compiled, in the root frame: bodies, joints, masses, hulls, and whose element each geom is."""

from collections.abc import Hashable
from dataclasses import replace
from functools import cached_property

import numpy as np

from meshforge import geometry
from meshforge.common import GeometryError
from meshforge.formats.collision_pieces import CollisionPiece, ShapeNames, collect_mentions
from meshforge.formats.libraries import mujoco
from meshforge.formats.mjcf.compiler import Compilation, KeepAttributes, compile_text, flatten
from meshforge.formats.mjcf.document import MjcfTree, body_names, geom_names
from meshforge.formats.xml import parse_numbers
from meshforge.symbolic import Coupling, Geom, Inertial, Joint, JointKind, Mechanism, Mentions, NonConvexPiece, Surface

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
    elements: of each geom, None for one out of another model. collides: of each, by contact bits or a `<pair>`.
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
        self.body_poses = [geometry.Pose.identity()]
        for k in range(1, self.model.nbody):  # in the reference configuration no joint displaces anything
            parent = self.body_poses[int(self.model.body_parentid[k])]
            self.body_poses.append(parent @ _pose(self.model.body_quat[k], self.model.body_pos[k]))
        self.geom_poses = [  # of a mesh, of the frame in which MuJoCo keeps its vertices, at its principal axes
            self.body_poses[int(body)] @ _pose(quat, pos)
            for body, quat, pos in zip(self.model.geom_bodyid, self.model.geom_quat, self.model.geom_pos, strict=True)
        ]
        self._hulls: dict[int, tuple[geometry.Polytope, float | None] | str] = {}

    def read_pieces(self) -> tuple[tuple[Geom, ...], tuple[NonConvexPiece, ...]]:
        """Return the hulls, and the collision geometry that is none."""
        geoms, non_convex = [], []
        for k, (name, body) in enumerate(zip(self.names, self.body_of, strict=True)):
            if not self.collides[k]:
                continue
            part = self.read_piece(k)
            if part.shape is not None:
                contact, own = _contact_attributes(self.model, k), self._mentions_of(k)
                geoms.append(Geom(name, body, part.shape, contact=contact, mentions=own, fill=part.fill))
            else:
                non_convex.append(
                    NonConvexPiece(name, body, part.reason, part.surface, part.plane, self._mentions_of(k))
                )
        return tuple(geoms), tuple(non_convex)

    @property
    def collision_names(self) -> tuple[str, ...]:
        """The names of the geoms that collide."""
        return tuple(name for name, collides in zip(self.names, self.collides, strict=True) if collides)

    def _mentions_of(self, k: int) -> Mentions:
        geom, shown = self.spec_geoms[k], self._visual_names.get(self.body_of[k], [])
        kind = geom.classname.name if geom.classname else ""
        return collect_mentions(_names_of(geom), shown, [("class", kind)] if kind != _UNNAMED else [])

    @cached_property
    def _visual_names(self) -> dict[str, list[ShapeNames]]:
        found: dict[str, list[ShapeNames]] = {}
        for geom, body, collides in zip(self.spec_geoms, self.body_of, self.collides, strict=True):
            if not collides:
                found.setdefault(body, []).append(_names_of(geom, geom.name))
        return found

    def read_piece(self, geom: int) -> CollisionPiece:
        """Return the shape of a geom; of a mesh it is the convex hull, with which MuJoCo collides."""
        kinds, pose = mujoco.mjtGeom, self.geom_poses[geom]
        kind = kinds(int(self.model.geom_type[geom]))
        match kind:
            case kinds.mjGEOM_MESH:
                return self._read_hull(int(self.model.geom_dataid[geom]), pose)
            case kinds.mjGEOM_PLANE:
                return CollisionPiece(None, "a plane has no end", plane=pose)
            case kinds.mjGEOM_HFIELD:
                return CollisionPiece(None, "a height field is no convex hull")
            case kinds.mjGEOM_SDF:
                data = int(self.model.geom_dataid[geom])
                surface = self.mesh_surface(data, pose) if data >= 0 else None
                return CollisionPiece(None, "a signed distance field is no convex hull", surface)
        shape = self.primitive_of(geom)
        return CollisionPiece(shape) if shape else CollisionPiece(None, f"{kind.name} is no geometry that is known")

    def primitive_of(self, geom: int) -> geometry.Shape | None:
        """Return the shape of a geom that is no mesh."""
        return read_primitive(self.model, geom, self.geom_poses[geom])

    def mesh_surface(self, mesh: int, root_t_mesh: geometry.Pose) -> Surface:
        """Return the triangles of a mesh in the root frame."""
        model = self.model
        first, count = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
        faces = model.mesh_face[first : first + count].astype(np.int64)
        return Surface(root_t_mesh.apply(self._mesh_vertices(mesh)), faces)

    def mesh_frame(self, mesh: int) -> geometry.Pose:
        """Return authored_T_kept: from the frame in which MuJoCo keeps a mesh's vertices to that of its scaled file."""
        return _pose(self.model.mesh_quat[mesh], self.model.mesh_pos[mesh])

    def _read_hull(self, mesh: int, pose: geometry.Pose) -> CollisionPiece:
        """The hull of a mesh, made once for all geoms that share it; that of MuJoCo's vertices under `maxhullvert`."""
        if mesh not in self._hulls:
            own, corners = self.mesh_surface(mesh, geometry.Pose.identity()), self._mesh_vertices(mesh)
            if (start := int(self.model.mesh_graphadr[mesh])) >= 0:
                count = int(self.model.mesh_graph[start])
                first = start + 2 + count  # after the numbers of vertices and faces, and each vertex's first edge
                corners = corners[self.model.mesh_graph[first : first + count]]
            try:
                self._hulls[mesh] = geometry.hull_mesh(own.vertices, own.faces, corners)
            except GeometryError as error:
                self._hulls[mesh] = error.problem
        made = self._hulls[mesh]
        if isinstance(made, str):
            return CollisionPiece(None, made, self.mesh_surface(mesh, pose))
        return CollisionPiece(made[0].move(pose), fill=made[1])

    def _mesh_vertices(self, mesh: int) -> geometry.Floats:
        first, count = int(self.model.mesh_vertadr[mesh]), int(self.model.mesh_vertnum[mesh])
        vertices: geometry.Floats = self.model.mesh_vert[first : first + count].astype(np.float64)
        return vertices


def read_primitive(model: mujoco.MjModel, geom: int, pose: geometry.Pose) -> geometry.Shape | None:
    """Return the shape of a geom that is no mesh; MuJoCo's sizes are half sizes."""
    kinds, size = mujoco.mjtGeom, model.geom_size[geom].astype(np.float64)
    match kinds(int(model.geom_type[geom])):
        case kinds.mjGEOM_BOX:
            return geometry.Box(pose, size)
        case kinds.mjGEOM_SPHERE:
            return geometry.Sphere(pose, float(size[0]))
        case kinds.mjGEOM_CAPSULE:
            return geometry.Capsule(pose, float(size[0]), float(size[1]))
        case kinds.mjGEOM_CYLINDER:
            return geometry.Cylinder(pose, float(size[0]), float(size[1]))
        case kinds.mjGEOM_ELLIPSOID:
            return geometry.Ellipsoid(pose, size)
    return None


def compile_tree(tree: MjcfTree, keep: KeepAttributes | None = None) -> MjcfModel:
    """Return the model of all that a tree says; keep: of a part of it. Raises AssetError with MuJoCo's message."""
    return MjcfModel(tree, compile_text(flatten(tree, keep)))


def read_mechanism(compiled: MjcfModel) -> Mechanism:
    """Return the mechanism of a model, `<exclude>` and `<pair>` too; a body without a joint is fixed to its parent."""
    model, couplings = compiled.model, _read_couplings(compiled.tree)
    joints: list[Joint] = []
    for k in range(1, model.nbody):
        first, count = int(model.body_jntadr[k]), int(model.body_jntnum[k])
        own = [_read_joint(compiled, joint) for joint in range(first, first + count)]
        joints += [replace(joint, coupling=couplings.get(joint.name)) for joint in own]
        if not count:
            ends, pose = (
                (compiled.body_names[int(model.body_parentid[k])], compiled.body_names[k]),
                compiled.body_poses[k],
            )
            joints.append(Joint("", "fixed", *ends, pose.translation, pose.rotation[:, 0]))
    inertials = [i for k in range(1, model.nbody) if (i := _read_inertial(compiled, k)) is not None]
    excludes = read_excludes(compiled)
    geoms = zip(model.pair_geom1, model.pair_geom2, strict=True)
    pairs = [(compiled.names[int(first)], compiled.names[int(second)]) for first, second in geoms]
    return Mechanism(tuple(joints), tuple(inertials), tuple(excludes), tuple(pairs))


def read_excludes(compiled: MjcfModel) -> list[tuple[str, str]]:
    """Return the pairs of bodies of each `<exclude>`."""
    bodies, signatures = compiled.body_names, map(int, compiled.model.exclude_signature)
    return [(bodies[s >> 16], bodies[s & 0xFFFF]) for s in signatures]  # as MuJoCo packs two numbers of bodies


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


def _read_joint(compiled: MjcfModel, k: int) -> Joint:
    model, body = compiled.model, int(compiled.model.jnt_bodyid[k])
    child, parent = compiled.body_names[body], compiled.body_names[int(model.body_parentid[body])]
    pose = compiled.body_poses[body]
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
    model, mass = compiled.model, float(compiled.model.body_mass[k])
    if mass <= 0:
        return None
    frame = compiled.body_poses[k] @ _pose(model.body_iquat[k], model.body_ipos[k])
    inertia = frame.rotation @ np.diag(model.body_inertia[k]) @ frame.rotation.T
    return Inertial(compiled.body_names[k], mass, frame.translation, inertia)


def _pose(quaternion: geometry.Floats, position: geometry.Floats) -> geometry.Pose:
    return geometry.Pose(geometry.rotation_of_quaternion(quaternion), position)


def _contact_attributes(model: mujoco.MjModel, geom: int) -> tuple[tuple[str, str], ...]:
    """Names and values of what decides how a geom collides, defaults and classes included."""
    numbers = {name: np.atleast_1d(getattr(model, f"geom_{name}")[geom]).tolist() for name in _ATTRIBUTES}
    return tuple((k, " ".join(str(n) if isinstance(n, int) else f"{n:g}" for n in own)) for k, own in numbers.items())


def _names_of(geom: mujoco.MjsGeom, name: str = "") -> ShapeNames:
    place: Hashable = (geom.type, *geom.size.tolist(), *geom.pos.tolist(), *geom.quat.tolist())
    return ShapeNames(geom.meshname or place, name, geom.meshname, geom.material)
