"""The bodies of an asset as a tree, and as links and joints of a new URDF or SDF, each with its frame on its joint."""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from meshforge.common import AssetError
from meshforge.formats.base import Loss
from meshforge.formats.meshfile.surface import FARTHEST
from meshforge.formats.xml import format_numbers, parse_numbers
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Floats, Pose, Sphere
from meshforge.symbolic import Asset, FeatureKind, Inertial, Joint, JointKind, unique_names

LIGHT_INERTIAL = Inertial("", 1e-6, np.zeros(3), 1e-9 * np.eye(3))
"""The mass of a link that stands for none, above what engines refuse."""
TENSOR_NAMES = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
"""What URDF and SDF call the six numbers of an inertia, those on and above its diagonal."""
LinkShape = Box | Capsule | Cylinder | Ellipsoid | Sphere
"""The shapes that SDF has of its own, the round ones from 1.8 on; URDF has but some of them."""
COMMON_KINDS: Mapping[str, JointKind] = {
    "fixed": "fixed", "revolute": "revolute", "continuous": "revolute", "prismatic": "prismatic"
}  # fmt: skip
"""The kinds of joints that URDF and SDF call the same."""

_NEAR = 1e-12  # [m] from a link's origin, within which a joint's axis counts as going through it
_ROUNDING = 1e-14  # as a share of the largest number; a few products of rotations make less


@dataclass(frozen=True, slots=True)
class BodyTree:
    """Who hangs on whom.

    order: all bodies, each after its parent, else in the order of the asset; joints: those that lead to each body, the
    one nearest to its parent first; none for a root.
    """

    order: tuple[str, ...]
    joints: Mapping[str, Sequence[Joint]]

    @staticmethod
    def of(asset: Asset) -> "BodyTree":
        """Return the tree of an asset's joints, their names made unique; each body that no joint leads to is a root."""
        joints: dict[str, list[Joint]] = {body.name: [] for body in asset.bodies}
        below: dict[str, list[str]] = {body.name: [] for body in asset.bodies}
        names = iter(unique_names(joint.name for joint in asset.mechanism.joints if joint.name))
        for joint in asset.mechanism.joints:
            if not joints[joint.child]:
                below[joint.parent].append(joint.child)
            joints[joint.child].append(replace(joint, name=next(names)) if joint.name else joint)
        waiting = [name for name in reversed(joints) if not joints[name]]
        order: list[str] = []
        while waiting:
            order.append(waiting.pop())
            waiting.extend(reversed(below[order[-1]]))
        return BodyTree(tuple(order), joints)

    def parent(self, body: str) -> str | None:
        """Return the body that a body hangs on, None for a root."""
        joints = self.joints[body]
        return joints[0].parent if joints else None

    def is_static(self, body: str) -> bool:
        """Return whether nothing between a body and its root can move."""
        at: str | None = body
        while at is not None:
            if any(joint.kind != "fixed" for joint in self.joints[at]):
                return False
            at = self.parent(at)
        return True

    @property
    def roots(self) -> list[str]:
        return [name for name in self.order if not self.joints[name]]


def claim_name(
    wanted: str, taken: set[str], named: Callable[[str], str] = str, fold: Callable[[str], str] = str, gap: str = "_"
) -> str:
    """Return what `named` makes of a name, with a number behind a gap where that is taken; it is taken from then on.

    fold: what `taken` holds of a name, such as `str.lower`.
    """
    name, number = named(wanted), 2
    while fold(name) in taken:
        name, number = named(f"{wanted}{gap}{number}"), number + 1
    taken.add(fold(name))
    return name


@dataclass(frozen=True, eq=False, slots=True)
class LinkJoint:
    """A `<joint>` from a link to another; pose: parent_T_child at zero; axis: in the child's frame."""

    name: str
    joint: Joint | None
    parent: str
    child: str
    pose: Pose
    axis: Floats


class KinematicChain:
    """The links of an asset's bodies, and what leads to them.

    frames: root_T_link of each link in the order of the file; joints: one for each link but the root; light: links
    that stand between two joints of one body; of_body: the link of each body. The root link is in the root frame: the
    first body that is a root there, else a link of its own.
    """

    def __init__(self, asset: Asset, bare: set[str], kinds: Collection[JointKind], has_world: bool) -> None:
        """Build the chain; bare: bodies that have nothing, of which a root can be left out.

        kinds: the joints that the format has, others are made of simpler ones; has_world: whether links can be joined
        to a world that is no link, for which else the root link stands.
        """
        self.frames: dict[str, Pose] = {}
        self.joints: list[LinkJoint] = []
        self.light: list[str] = []
        self.of_body: dict[str, str] = {}
        self.lost: list[Loss] = []
        self.notes: list[str] = []
        self._kinds, self._poses, self._tree = kinds, asset.body_poses, BodyTree.of(asset)
        self._links = set(self._poses)
        self._joint_names = {joint.name for joints in self._tree.joints.values() for joint in joints if joint.name}
        self._dropped = None if has_world else self._find_idle_root(bare)
        self._root = self._add_root()
        for body in self._tree.order:
            if body != self._dropped and body not in self.frames:
                self._add_body(body)

    def _find_idle_root(self, bare: set[str]) -> str | None:
        """A root that only holds one other body, rigidly or not at all: then that other one is the root link.

        Whether its root link is free or fixed to the world is for the loader of a URDF to say.
        """
        roots = self._tree.roots
        below = [body for body in self._tree.order if self._tree.parent(body) == roots[0]]
        if len(roots) != 1 or roots[0] not in bare or len(below) != 1:
            return None
        joints = self._tree.joints[below[0]]
        if [joint.kind for joint in joints] == ["floating"]:
            self.notes.append(
                f"{below[0]!r} moves freely: it is the root link, which a URDF leaves to its loader to fix or not; "
                "MuJoCo fixes it, PyBullet does with useFixedBase"
            )
            name, why = joints[0].name, "the root link of a URDF has none"
            self.lost.append(Loss(FeatureKind.JOINTS, (name,) if name else (), why, unnamed=int(not name)))
        elif any(joint.kind != "fixed" for joint in joints):
            return None
        return roots[0]

    def _add_root(self) -> str:
        hung = [b for b in self._tree.order if self._dropped and self._tree.parent(b) == self._dropped]
        poses = [(body, self._poses[body]) for body in self._tree.roots]
        still = hung or [b for b, p in poses if np.array_equal(p.rotation, np.eye(3)) and not p.translation.any()]
        name = still[0] if still else claim_name("base", self._links)
        if still:
            self.of_body[name] = name
        self.frames[name] = Pose.identity()
        return name

    def _add_body(self, body: str) -> None:
        """Add the link of a body behind its parent's, with light links between where several joints lead to it."""
        joints = [part for joint in self._tree.joints[body] for part in self._split_joint(joint)]
        up = self._tree.parent(body)
        parent = self._root if up is None or up == self._dropped else self.of_body[up]
        if not joints:
            self._add_link(body, None, parent, self._poses[body], claim_name(f"{body}_fixed", self._joint_names))
        for k, joint in enumerate(joints):
            last = k == len(joints) - 1
            link = body if last else claim_name(f"{body}_{joint.name or k}", self._links)
            frame = Pose(self._poses[body].rotation, _link_origin_of(joint, self._poses[body]))
            name = joint.name or claim_name(f"{body}_{joint.kind}", self._joint_names)
            self._add_link(link, joint, parent, frame, name)
            if not last:
                self.light.append(link)
            parent = link
        self.of_body[body] = body

    def _add_link(self, link: str, joint: Joint | None, parent: str, frame: Pose, name: str) -> None:
        pose = self.frames[parent].inverse() @ frame
        axis = frame.rotation.T @ joint.axis if joint else np.array([1.0, 0.0, 0.0])
        self.joints.append(LinkJoint(name, joint, parent, link, pose, axis))
        self.frames[link] = frame

    def _split_joint(self, joint: Joint) -> Sequence[Joint]:
        """The joints of the format that move as one does: a ball is three that turn about one point."""
        if joint.kind in self._kinds or joint.kind != "ball":
            return [joint]
        name, axes = joint.name or f"{joint.child}_ball", self._poses[joint.child].rotation.T
        return [
            replace(
                joint, name=claim_name(f"{name}_{letter}", self._joint_names), kind="revolute", axis=axis, limits=None
            )
            for letter, axis in zip("xyz", axes, strict=True)
        ]


def _link_origin_of(joint: Joint, pose: Pose) -> Floats:
    """Where the frame of the link behind a joint is: at its body's, or on the axis where that goes elsewhere."""
    away = joint.anchor - pose.translation
    if joint.kind == "revolute":
        away = away - joint.axis * float(away @ joint.axis)
    elif joint.kind != "ball":
        return pose.translation
    return pose.translation + away if np.linalg.norm(away) > _NEAR else pose.translation


def place_inertial(inertial: Inertial, root_t_link: Pose) -> tuple[Floats, Floats]:
    """Return the centre (3,) [m] of a mass and the inertia (3, 3) [kg m^2] about it, in the frame of a link."""
    turn = root_t_link.rotation.T
    centre = turn @ (inertial.centre - root_t_link.translation)
    return centre, drop_rounding(turn @ inertial.inertia @ turn.T)


def name_sizes(shape: LinkShape) -> dict[str, str]:
    """Return the sizes [m] of a shape as URDF and SDF call them; a capsule has the length of the cylinder in it."""
    match shape:
        case Box():
            return {"size": format_numbers(2 * shape.half)}
        case Ellipsoid():
            return {"radii": format_numbers(shape.radii)}
        case Sphere():
            return {"radius": format_numbers([shape.radius])}
    return {"radius": format_numbers([shape.radius]), "length": format_numbers([2 * shape.half_length])}


def name_moments(tensor: Floats) -> list[tuple[str, float]]:
    """Return the numbers of an inertia (3, 3) by the names of URDF and SDF."""
    return list(zip(TENSOR_NAMES, tensor[np.triu_indices(3)].tolist(), strict=True))


def tensor_of_moments(moments: Iterable[float]) -> Floats:
    """Return the inertia (3, 3) of six numbers in the order of `TENSOR_NAMES`."""
    xx, xy, xz, yy, yz, zz = moments
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def drop_rounding(values: Floats, scale: float | None = None) -> Floats:
    """Return the numbers without those that are but the rounding of `scale`, else of the largest one."""
    largest = float(np.abs(values).max()) if scale is None else scale
    return np.where(np.abs(values) < _ROUNDING * largest, 0.0, values)


def read_numbers(text: str, count: int, given: str, place: str) -> Floats:
    """Return the numbers (count,) of a text. Raises AssetError about `given`, at a place, where it holds others."""
    values = parse_numbers(text)
    if values is None or len(values) != count:
        wanted = "a finite number" if count == 1 else f"{count} finite numbers"
        raise AssetError(f"{given} does not hold {wanted}", where=place)
    if any(abs(value) > FARTHEST for value in values):
        raise AssetError(f"{given} is larger than anything", where=place)
    return np.array(values)
