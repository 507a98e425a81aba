"""What a goal is, the asset that it is tried on, and what comes of that."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar, Literal, NoReturn, Self

import numpy as np

from meshforge.checks.base import LEAST_SIZE, MOST_SIZE
from meshforge.checks.physics.scene import TOLERANCE, Failure, Place
from meshforge.common import MeshForgeError, ProgramError, blame, describe_error
from meshforge.geometry import Aabb, Floats, Pose, Shape, rotation_about
from meshforge.label_model.describe import face_normals, find_upright_rotation, rotation_to_z
from meshforge.language import EXTREMITY, Extractor, Operation, Program, Replay, labels_of, select_mask
from meshforge.language.arguments import MissingOperation
from meshforge.language.extractors.base import rename_in_extractor
from meshforge.language.orient import square_up_angle
from meshforge.symbolic import Hull, Surface, SymbolicMesh, bits_of, split_by_contact

_LEANS = (10.0, 5.0, 2.0, 1.0)
"""Degrees, that level faces are off at most, from what landmarks say is up, then from their mean."""
_LEVEL = 0.1  # of the area of all faces, that these have at least

GoalOutcome = Literal["passed", "failed", "untried", "broken"]


class NotApplicableError(MeshForgeError):
    """A goal cannot be tried on an asset, so nothing is known of it."""


class Goal(Operation, ABC):
    """What an asset must do after its edit: a frozen dataclass as all operations, written with a small letter."""

    __slots__ = ()
    on_level: ClassVar[bool] = False
    """Whether its subject is `level`, as for things that must not roll or lean."""

    @classmethod
    def word(cls) -> str:
        return cls.__name__.lower()

    def rename(self, old: str, new: str) -> Self:
        """Return the same with a label by another name."""
        extractors = {name: value for name, value in self.values().items() if isinstance(value, Extractor)}
        renamed: dict[str, Any] = {name: rename_in_extractor(one, old, new) for name, one in extractors.items()}
        return replace(self, **renamed) if renamed else self  # type: ignore[type-var]  # it is a dataclass

    @abstractmethod
    def find_failure(self, subject: "GoalSubject") -> Failure | None:
        """Return why an asset does not do it, None where it does. Raises NotApplicableError."""


@dataclass(frozen=True, slots=True)
class MissingGoal(MissingOperation, Goal):
    """A goal of a plug-in that cannot be loaded here."""

    def find_failure(self, subject: "GoalSubject") -> NoReturn:
        self.fail()


@dataclass(frozen=True, eq=False, slots=True)
class Part:
    """Hulls of an asset in a frame of their own, turned about Z so that their footprint is square to its axes; turn:
    the rotation (3, 3) upright_T_part."""

    hulls: tuple[Hull, ...]
    turn: Floats

    @classmethod
    def of(cls, hulls: Sequence[Hull]) -> Self:
        """Return the part that hulls are, as the asset stands."""
        footprint = np.concatenate([hull.vertices[:, :2] for hull in hulls])
        turn = rotation_about(np.eye(3)[2], square_up_angle(footprint)).T
        pose = Pose(turn.T, np.zeros(3))
        return cls(tuple(hull.move(pose) for hull in hulls), turn)

    @property
    def box(self) -> Aabb:
        """The box around its hulls."""
        return Aabb.union(hull.aabb for hull in self.hulls)

    def holds(self, hull: Hull, margin: float) -> bool:
        """Whether the middle of a hull, in its frame, lies in the box around its hulls or so near to it [m]."""
        at = hull.shape.centroid
        return bool((self.box.min - margin <= at).all() and (at <= self.box.max + margin).all())

    def lower(self, surfaces: Sequence[Surface]) -> list[Surface]:
        """Return surfaces in its frame."""
        return [replace(one, vertices=one.vertices @ self.turn) for one in surfaces]

    def lower_hulls(self, hulls: Sequence[Hull]) -> list[Hull]:
        """Return hulls of the asset as it stands in its frame."""
        pose = Pose(self.turn.T, np.zeros(3))
        return [hull.move(pose) for hull in hulls]

    def lift(self, place: Place) -> Place:
        """Return a place in its frame on the asset as it stands."""
        return Place(self.turn @ place.at, place.size, self.turn @ place.axes)


@dataclass(frozen=True, eq=False)
class GoalSubject:
    """An asset as it stands, Z up [m], before and after its edit.

    start, end: the same in the frame of the program, in which extractors select; turn, upright: the rotations (3, 3)
    upright_T_program and upright_T_file; extremity: of extractors; by_landmarks: whether what is up comes from these.
    """

    start: SymbolicMesh
    end: SymbolicMesh
    turn: Floats
    upright: Floats
    extremity: float = EXTREMITY
    by_landmarks: bool = False

    @classmethod
    def of(cls, before: SymbolicMesh, after: SymbolicMesh, program: Program) -> Self:
        """Return the subject of an edit by a program, whose frame and thresholds count. Raises ProgramError where the
        program cannot turn the mesh."""
        replay = Replay.begin(before, program.orient, program.contact)
        end = after.with_hulls(hull.move(replay.pose) for hull in after.hulls)
        end = replace(end, epsilon=replay.start.epsilon, scale=replay.start.scale)
        upright = find_upright_rotation(before, program.orient)
        turn = upright @ replay.pose.rotation.T
        extremity = EXTREMITY if program.extremity is None else program.extremity
        return cls(replay.start, end, turn, upright, extremity, bool(program.orient and program.orient.names_z))

    @cached_property
    def level(self) -> "GoalSubject":
        """The same, its level faces level, such as seats, tops and feet: centres of landmarks are a few degrees off."""
        normals, areas = face_normals(self.start)
        ways, up = normals @ self.turn.T, np.eye(3)[2]
        ways *= np.sign(ways[:, 2:])
        for lean in _LEANS:
            near = ways @ up > np.cos(np.radians(lean))
            if not self.by_landmarks or areas[near].sum() < _LEVEL * areas.sum():
                return self
            up = areas[near] @ ways[near]
            up /= np.linalg.norm(up)
        lower = rotation_to_z(up)
        return replace(self, turn=lower @ self.turn, upright=lower @ self.upright, by_landmarks=False)

    @property
    def touching(self) -> float:
        """How deep two things may be in each other without counting as such [m]."""
        return TOLERANCE * self.start.diagonal

    @cached_property
    def hulls(self) -> tuple[Hull, ...]:
        """The hulls after the edit."""
        return self._lift(self.end.hulls)

    @cached_property
    def hulls_before(self) -> tuple[Hull, ...]:
        """The hulls before the edit."""
        return self._lift(self.start.hulls)

    @cached_property
    def box(self) -> Aabb:
        """The box around all hulls before the edit."""
        return Aabb.union(hull.aabb for hull in self.hulls_before)

    @property
    def shown(self) -> SymbolicMesh:
        """The mesh after the edit, with what the asset showed before it, in one frame."""
        asset = self.start.asset and replace(self.start.asset, visuals=self.surfaces)
        return replace(self.end, hulls=self.hulls, asset=asset)

    @cached_property
    def surfaces(self) -> tuple[Surface, ...]:
        """What the asset shows."""
        shown = self.start.asset.visuals if self.start.asset else ()
        return tuple(replace(one, vertices=one.vertices @ self.upright.T) for one in shown if len(one.faces))

    def select(self, extractor: Extractor) -> tuple[Hull, ...]:
        """Return what an extractor selects before the edit. Raises NotApplicableError where that is nothing."""
        found = self._select(extractor)
        return self._lift([self.start.hulls[k] for k in sorted(bits_of(found))])

    def select_parts(self, extractor: Extractor) -> list[Part]:
        """Return the same by its parts, which do not touch each other or are of different bodies."""
        found = self._select(extractor)
        parts = split_by_contact(self.start, found)
        return [Part.of(self._lift([self.start.hulls[k] for k in sorted(bits_of(part))])) for part in parts]

    def select_after(self, extractor: Extractor) -> tuple[Hull, ...]:
        """Return what it selects after the edit. Raises NotApplicableError where it selected nothing before."""
        self._select(extractor)
        return self.select_any(extractor)

    def select_any(self, extractor: Extractor | None) -> tuple[Hull, ...]:
        """Return what an extractor selects after the edit, which may be nothing."""
        found = bits_of(select_mask(extractor, self.end, self.extremity)) if extractor is not None else ()
        return tuple(hull for k, hull in enumerate(self.hulls) if k in found)

    def select_rest(self, extractor: Extractor) -> list[Hull]:
        """Return all else before the edit."""
        names = {hull.name for hull in self.select(extractor)}
        return [hull for hull in self.hulls_before if hull.name not in names]

    def turn_axis(self, direction: str) -> Floats:
        """Return the axis (3,) of a direction of the program's frame."""
        sign = 1.0 if direction[0] == "+" else -1.0
        return sign * self.turn[:, "XYZ".index(direction[1])]

    def _lift(self, hulls: Sequence[Hull]) -> tuple[Hull, ...]:
        pose = Pose(self.turn, np.zeros(3))
        return tuple(hull.move(pose) for hull in hulls)

    def _select(self, extractor: Extractor) -> int:
        if labels_of(extractor) and not any(hull.annotation for hull in self.start.hulls):
            raise NotApplicableError(f"it has no labels, and {extractor} asks for some")
        found = select_mask(extractor, self.start, self.extremity)
        if not found:
            raise NotApplicableError(f"{extractor} selects nothing here")
        return found


@dataclass(frozen=True, eq=False, slots=True)
class GoalResult:
    """What came of trying a goal. goal: its text; why: it failed, was not tried, or broke; hulls: names of those at
    fault; objects: what was tried on the asset as it stands, where it was put."""

    goal: str
    outcome: GoalOutcome
    why: str = ""
    hulls: tuple[str, ...] = ()
    objects: tuple[Shape, ...] = field(default=(), repr=False)


def try_goal(goal: Goal, subject: GoalSubject) -> GoalResult:
    """Return what comes of a goal on an asset; what a plug-in does wrong, or a program of ours, is `broken`."""
    try:
        size = subject.start.diagonal
        if not subject.start.hulls:
            raise NotApplicableError("it has no hulls")
        if not LEAST_SIZE <= size <= MOST_SIZE:
            raise NotApplicableError(f"it is {size:.3g} m large; goals are tried on {LEAST_SIZE:g} to {MOST_SIZE:g} m")
        if not subject.end.hulls:
            return GoalResult(str(goal), "failed", "no hull is left")
        level = subject.level if goal.on_level else subject
        back = Pose(subject.turn @ level.turn.T, np.zeros(3))
        with blame(goal.plugin):
            failure = goal.find_failure(level)
            if failure is None:
                return GoalResult(str(goal), "passed")
            objects = tuple(one.move(back) for one in failure.objects)
            return GoalResult(str(goal), "failed", failure.text, failure.hulls, objects)
    except NotApplicableError as error:
        return GoalResult(str(goal), "untried", error.problem)
    except ProgramError:
        raise
    except Exception as error:  # one goal never stops the others
        return GoalResult(str(goal), "broken", describe_error(error))
