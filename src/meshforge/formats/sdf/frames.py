"""Poses and frames of an SDF: values as elements hold them, and where all that is named in its models is."""

from dataclasses import dataclass

import numpy as np

from meshforge.common import AssetError, nearest_name
from meshforge.formats.kinematic_tree import read_numbers
from meshforge.formats.xml import Element
from meshforge.geometry import Floats, Pose, rotation_of_quaternion

MODEL = "__model__"
WORLD = "world"

_LONGEST = 80  # characters of a value in a message


@dataclass(frozen=True, slots=True, eq=False)
class SdfFrame:
    """A frame of a link, a joint, a `<frame>` or a model.

    scope: the path of the model in which it is named; pose: base_T_frame, of a model with a placement frame
    base_T_placement; base: the name of what the pose counts from, empty for the scope; attached: the name of what it
    moves with, empty for nothing; body: that of a link; placement: a name in the model that has this frame.
    """

    scope: str
    pose: Pose
    base: str
    where: str
    attached: str = ""
    body: str = ""
    placement: str = ""


class FrameTable:
    """All frames by their paths: `model::link` that of a link, `model::` that of a model, the empty one the root."""

    def __init__(self) -> None:
        self.by_path = {"": SdfFrame("", Pose.identity(), "", "")}
        self._poses = {"": Pose.identity()}

    def find(self, scope: str, name: str) -> str | None:
        """Return the path of the frame that a name in a scope stands for, None where there is none."""
        if name.rpartition("::")[2] == MODEL or (not scope and name in (WORLD, "__root__")):
            name = name.rpartition("::")[0] + "::" * ("::" in name)
        path = scope + name
        return next((known for known in (path, f"{path}::") if known in self.by_path), None)

    def find_body(self, scope: str, name: str) -> str | None:
        """Return the body that a frame moves with, of a model the link that it names or its first; None without one."""
        passed: set[str | None] = {None}
        while name and (path := self.find(scope, name)) not in passed:
            passed.add(path)
            frame = self.by_path[path or ""]
            if frame.body:
                return frame.body
            scope, name = frame.scope, frame.attached
        return None

    def pose_of(self, scope: str, name: str, where: str) -> Pose:
        """Return root_T_frame of a name in a scope. Raises AssetError: it is not there, or counts from itself."""
        return self._pose_at(self._resolve(scope, name, where), self._poses)

    def _pose_at(self, path: str, poses: dict[str, Pose]) -> Pose:
        """The pose of a frame after all that it counts from, to which those of its way are added."""
        chain: dict[str, None] = {}
        at = path
        while at not in poses:
            frame = self.by_path[at]
            if at in chain:
                raise AssetError("the poses of frames count from each other in a ring", where=frame.where)
            chain[at] = None
            at = self._resolve(frame.scope, frame.base, frame.where)
        for model in reversed(chain):
            frame = self.by_path[model]
            poses[model] = poses[at] @ frame.pose
            if frame.placement:
                placed = self._resolve(model, frame.placement, frame.where)
                poses[model] = poses[model] @ self._pose_at(placed, {model: Pose.identity()}).inverse()
            at = model
        return poses[path]

    def _resolve(self, scope: str, name: str, where: str) -> str:
        path = self.find(scope, name)
        if path is None:
            names = [known.removeprefix(scope).removesuffix("::") for known in self.by_path if known.startswith(scope)]
            like = nearest_name(name, filter(None, names))
            remedy = f"The nearest name of a frame is {like!r}." if like else None
            raise AssetError(f"there is no frame {name!r} in this model", where=where, remedy=remedy)
        return path


def text_of(parent: Element | None, tag: str, default: str = "") -> str:
    """Return the text of an element's first child of a tag."""
    child = parent.first(tag) if parent else None
    return child.text if child else default


def is_true(text: str) -> bool:
    """Return whether a switch is on, as libsdformat reads it."""
    return text.strip().lower() in ("true", "1")


def is_computed(inertial: Element) -> bool:
    """Return whether Gazebo computes the mass of a link of its collisions (`<inertial auto="true">`)."""
    return is_true(inertial.attributes.get("auto", ""))


def read_floats(parent: Element, tag: str, where: str, default: tuple[float, ...]) -> Floats:
    """Return the numbers of a child element, `default` where it is left out, as long as that.

    Raises AssetError with `where:line`: of another length, or not of finite numbers.
    """
    child = parent.first(tag)
    return np.array(default) if child is None else read_values(child, len(default), where)


def read_values(element: Element, count: int, where: str) -> Floats:
    """Return the numbers (count,) that an element holds. Raises AssetError with `where:line`."""
    text = element.text if len(element.text) <= _LONGEST else f"{element.text[:_LONGEST]}..."
    return read_numbers(element.text, count, f"<{element.tag}>{text}</{element.tag}>", f"{where}:{element.line}")


@dataclass(frozen=True, eq=False, slots=True)
class PoseElement:
    """A pose as it is authored; base: the name of the frame it counts from, empty for the usual one."""

    pose: Pose
    base: str
    line: int


def pose_of(owner: Element | None, where: str) -> PoseElement:
    """Return the pose of an element's first `<pose>`, identity without one. Raises AssetError with `where:line`."""
    element = owner.first("pose") if owner else None
    if element is None:
        return PoseElement(Pose.identity(), "", owner.line if owner else 0)
    base, old = (element.attributes.get(name, "").strip() for name in ("relative_to", "frame"))
    if old and not base:
        why = "versions before 1.7 left open what it means, and Gazebo ignores it"
        remedy = f"Write relative_to={old!r} if the pose counts from that frame, else remove the attribute."
        raise AssetError(f"<pose frame={old!r}> is not read: {why}", where=f"{where}:{element.line}", remedy=remedy)
    if element.attributes.get("rotation_format") == "quat_xyzw":
        return PoseElement(_pose_from_quaternion(element, where), base, element.line)
    found = read_values(element, 6, where) if element.text else np.zeros(6)
    turn = np.radians(found[3:]) if is_true(element.attributes.get("degrees", "")) else found[3:]
    return PoseElement(Pose.from_rpy(list(found[:3]), list(turn)), base, element.line)


def _pose_from_quaternion(element: Element, where: str) -> Pose:
    """A pose of x y z and a quaternion x y z w, which need not be of unit length."""
    if not element.text:
        return Pose.identity()
    found = read_values(element, 7, where)
    if np.linalg.norm(found[3:]) == 0:
        raise AssetError("the quaternion of this <pose> is zero", where=f"{where}:{element.line}")
    x, y, z, w = found[3:]
    return Pose(rotation_of_quaternion([w, x, y, z]), found[:3])
