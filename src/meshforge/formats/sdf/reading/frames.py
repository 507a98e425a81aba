"""The frames of an SDF: what is named in each model, and where it is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from meshforge.errors import AssetError, nearest
from meshforge.formats.sdf.files.version import Version
from meshforge.formats.xml import Element
from meshforge.geometry import Pose

MODEL = "__model__"
WORLD = "world"


@dataclass(slots=True, eq=False)
class Frame:
    """A named frame in a scope: that of a link, joint, `<frame>`, or of a model within.

    pose: base_T_frame, of a model with a placement frame base_T_placement; base: the name, in the scope, of what the
    pose counts from, empty for the scope itself; link: whether a link has it; attached: the name of what it moves with;
    inside: of a model, its scope, and `placement` the name therein of the frame that the pose is of.
    """

    scope: Scope
    pose: Pose
    base: str
    where: str
    link: bool = False
    attached: str = ""
    inside: Scope | None = None
    placement: str = ""


@dataclass(slots=True, eq=False)
class Scope:
    """A model as it stands somewhere, or a world: what is named in it.

    prefix: of the names of its bodies; source: the file it stands in, by its number; merged: whether it is poured into
    the scope around it; through: of the names that are poured into this one, the scope they come from.
    """

    prefix: str
    element: Element
    source: int
    where: str
    version: Version
    frame: Frame | None = None
    merged: bool = False
    is_world: bool = False
    frames: dict[str, Frame] = field(default_factory=dict)
    links: dict[str, Element] = field(default_factory=dict)
    through: dict[str, Scope] = field(default_factory=dict)
    inner: list[Scope] = field(default_factory=list)

    def resolve(self, name: str, where: str) -> list[Frame]:
        """The frames, each in the scope of the one before, that lead from this scope to a name.

        Raises AssetError at `where`: there is no such frame.
        """
        found: list[Frame] = []
        scope, rest = self, name
        while rest and rest != MODEL and not (scope.is_world and rest in (WORLD, "__root__")):
            frame, rest, scope = scope._take_step(rest) or _refuse(self, name, where)
            found.append(frame)
        return found

    def has(self, name: str) -> bool:
        """Whether a name leads to a frame."""
        try:
            self.resolve(name, "")
        except AssetError:
            return False
        return True

    def _take_step(self, name: str) -> tuple[Frame, str, Scope] | None:
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

    def merge_names(self, inner: Scope) -> None:
        """Make the names of a merged model known in this scope."""
        for name in (*inner.frames, *inner.through):
            self.through.setdefault(name, inner)


def _refuse(scope: Scope, name: str, where: str) -> tuple[Frame, str, Scope]:
    like = nearest(name, [*scope.frames, *scope.through])
    remedy = f"The nearest name of a frame is {like!r}." if like else None
    raise AssetError(f"there is no frame {name!r} in this model", where=where, remedy=remedy)


class Places:
    """Where frames are, each found once."""

    def __init__(self) -> None:
        self._own: dict[Frame, Pose] = {}
        self._scopes: dict[Scope, Pose] = {}

    def pose_of_scope(self, scope: Scope) -> Pose:
        """root_T_model of a scope; the outermost one is the root."""
        chain = []
        at: Scope | None = scope
        while at is not None and at not in self._scopes:
            chain.append(at)
            at = at.frame.scope if at.frame else None
        pose = self._scopes[at] if at is not None else Pose.identity()
        for inner in reversed(chain):
            pose = pose @ self._pose_in_scope(inner.frame) if inner.frame else pose
            self._scopes[inner] = pose
        return pose

    def pose_of(self, scope: Scope, name: str, where: str) -> Pose:
        """root_T_frame of a name in a scope. Raises AssetError: it is not there, or counts from itself."""
        return self.pose_of_scope(scope) @ self._chain_poses(scope.resolve(name, where))

    def _chain_poses(self, path: Sequence[Frame]) -> Pose:
        pose = Pose.identity()
        for frame in path:
            pose = pose @ self._pose_in_scope(frame)
        return pose

    def _pose_in_scope(self, wanted: Frame) -> Pose:
        """scope_T_frame, after all that it counts from. Raises AssetError for a ring of frames."""
        open_: dict[Frame, None] = {}
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
