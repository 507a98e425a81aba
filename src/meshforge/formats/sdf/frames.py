"""Poses and frames of an SDF: values as elements hold them, what is named in each model, and where that is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from meshforge.common import AssetError, nearest_name
from meshforge.formats.kinematic_tree import read_numbers
from meshforge.formats.sdf.document import Version
from meshforge.formats.xml import Element
from meshforge.geometry import Floats, Pose, rotation_of_quaternion

MODEL = "__model__"
WORLD = "world"

_LONGEST = 80  # characters of a value in a message


@dataclass(slots=True, eq=False)
class SdfFrame:
    """A named frame in a scope: that of a link, joint, `<frame>`, or of a model within.

    pose: base_T_frame, of a model with a placement frame base_T_placement; base: the name, in the scope, of what the
    pose counts from, empty for the scope itself; link: whether a link has it; attached: the name of what it moves with;
    inside: of a model, its scope, and `placement` the name therein of the frame that the pose is of.
    """

    scope: ModelScope
    pose: Pose
    base: str
    where: str
    link: bool = False
    attached: str = ""
    inside: ModelScope | None = None
    placement: str = ""


@dataclass(slots=True, eq=False)
class ModelScope:
    """A model as it stands somewhere, or a world: what is named in it.

    prefix: of the names of its bodies; source: the file it stands in, by its number; merged: whether its names are also
    those of the scope around it; through: of the names that come from merged models, the scope they come from.
    """

    prefix: str
    element: Element
    source: int
    where: str
    version: Version
    frame: SdfFrame | None = None
    merged: bool = False
    is_world: bool = False
    frames: dict[str, SdfFrame] = field(default_factory=dict)
    links: dict[str, Element] = field(default_factory=dict)
    through: dict[str, ModelScope] = field(default_factory=dict)
    inner: list[ModelScope] = field(default_factory=list)

    def resolve(self, name: str, where: str) -> list[SdfFrame]:
        """The frames, each in the scope of the one before, that lead from this scope to a name.

        Raises AssetError at `where`: there is no such frame.
        """
        found: list[SdfFrame] = []
        scope, rest = self, name
        while rest and rest != MODEL and not (scope.is_world and rest in (WORLD, "__root__")):
            step = scope._take_step(rest)
            if step is None:
                like = nearest_name(name, [*self.frames, *self.through])
                remedy = f"The nearest name of a frame is {like!r}." if like else None
                raise AssetError(f"there is no frame {name!r} in this model", where=where, remedy=remedy)
            frame, rest, scope = step
            found.append(frame)
        return found

    def has(self, name: str) -> bool:
        """Whether a name leads to a frame."""
        try:
            self.resolve(name, "")
        except AssetError:
            return False
        return True

    def _take_step(self, name: str) -> tuple[SdfFrame, str, ModelScope] | None:
        """The frame that a name leads to first, the rest of the name, and the scope in which that counts."""
        head, _, tail = name.partition("::")
        if name in self.frames:
            return self.frames[name], "", self
        if name in self.through or (tail and head in self.through):
            inner = self.through[name if name in self.through else head]
            assert inner.frame is not None
            return inner.frame, name, inner
        inside = self.frames[head].inside if tail and head in self.frames else None
        return (self.frames[head], tail, inside) if inside else None


class FramePlaces:
    """Where frames are, each found once."""

    def __init__(self) -> None:
        self._own: dict[SdfFrame, Pose] = {}
        self._scopes: dict[ModelScope, Pose] = {}

    def pose_of_scope(self, scope: ModelScope) -> Pose:
        """root_T_model of a scope; the outermost one is the root."""
        chain = []
        at: ModelScope | None = scope
        while at is not None and at not in self._scopes:
            chain.append(at)
            at = at.frame.scope if at.frame else None
        pose = self._scopes[at] if at is not None else Pose.identity()
        for inner in reversed(chain):
            pose = pose @ self._pose_in_scope(inner.frame) if inner.frame else pose
            self._scopes[inner] = pose
        return pose

    def pose_of(self, scope: ModelScope, name: str, where: str) -> Pose:
        """root_T_frame of a name in a scope. Raises AssetError: it is not there, or counts from itself."""
        return self.pose_of_scope(scope) @ self._chain_poses(scope.resolve(name, where))

    def _chain_poses(self, path: Sequence[SdfFrame]) -> Pose:
        pose = Pose.identity()
        for frame in path:
            pose = pose @ self._pose_in_scope(frame)
        return pose

    def _pose_in_scope(self, wanted: SdfFrame) -> Pose:
        """scope_T_frame, after all that it counts from. Raises AssetError for a ring of frames."""
        open_: dict[SdfFrame, None] = {}
        waiting = [wanted]
        while waiting:
            frame = waiting[-1]
            if frame in self._own:
                waiting.pop()
                continue
            base = frame.scope.resolve(frame.base, frame.where)
            placement = frame.inside.resolve(frame.placement, frame.where) if frame.inside else []
            needed = [other for other in (*base, *placement) if other not in self._own]
            if needed:
                if frame in open_:
                    raise AssetError("the poses of frames count from each other in a ring", where=frame.where)
                open_[frame] = None
                waiting += needed
                continue
            pose = self._chain_poses(base) @ frame.pose
            self._own[frame] = pose @ self._chain_poses(placement).inverse() if placement else pose
        return self._own[wanted]


def text_of(parent: Element | None, tag: str, default: str = "") -> str:
    """The text of an element's first child of a tag."""
    child = parent.first(tag) if parent else None
    return child.text if child else default


def is_true(text: str) -> bool:
    """Whether a switch is on, as libsdformat reads it."""
    return text.strip().lower() in ("true", "1")


def read_floats(parent: Element, tag: str, where: str, default: tuple[float, ...]) -> Floats:
    """The numbers of a child element, `default` where it is left out, as long as that.

    Raises AssetError with `where:line`: of another length, or not of finite numbers.
    """
    child = parent.first(tag)
    return np.array(default) if child is None else read_values(child, len(default), where)


def read_values(element: Element, count: int, where: str) -> Floats:
    """The numbers (count,) that an element holds. Raises AssetError with `where:line`."""
    text = element.text if len(element.text) <= _LONGEST else f"{element.text[:_LONGEST]}..."
    return read_numbers(element.text, count, f"<{element.tag}>{text}</{element.tag}>", f"{where}:{element.line}")


@dataclass(frozen=True, eq=False, slots=True)
class PoseElement:
    """A pose as it is authored; base: the name of the frame it counts from, empty for the usual one."""

    pose: Pose
    base: str
    line: int


def pose_of(owner: Element | None, where: str) -> PoseElement:
    """The pose of an element's first `<pose>`, identity where there is none. Raises AssetError with `where:line`."""
    element = owner.first("pose") if owner else None
    if element is None:
        return PoseElement(Pose.identity(), "", owner.line if owner else 0)
    base = element.attributes.get("relative_to", element.attributes.get("frame", "")).strip()
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
