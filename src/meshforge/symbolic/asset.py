"""What every file becomes: bodies, convex geoms, pieces that are no hulls, joints, masses, and the source document."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal, NamedTuple, Self

import numpy as np

from meshforge.common import MissingFilesError, join_names
from meshforge.geometry import Floats, Ints, Pose, Shape, SurfaceParts, freeze_floats

JointKind = Literal["fixed", "revolute", "prismatic", "ball", "floating"]
Mentions = tuple[tuple[str, str], ...]
"""What a file calls a piece of collision geometry besides its own name and its body's: of what kind, and the name.

Kinds: `label` is what the file says that it is; `visual`, `mesh`, `group`, `node` and `class` are its own; `shown` is
what its body shows; `material`.
"""


@dataclass(frozen=True, eq=False, slots=True)
class Body:
    """A rigid part (URDF link, MJCF body); pose: root_T_body with every joint at zero."""

    name: str
    pose: Pose


@dataclass(frozen=True, eq=False, slots=True)
class Geom:
    """One convex collision shape in the root frame.

    name: unique in the asset, for ever: a made geom never takes the name of a source geom.
    parent: None for a geom of the file, which is written back as authored; for a made one, the source geom
    whose contact attributes it inherits.
    contact: those attributes of a geom of the file, by the format's names for them, where it has them geom by geom.
    mentions: what else the file calls it, which may tell what it is; a writer takes no notice of it.
    element: the collision element of the file that it is one of several pieces of, empty where it is all of it.
    fill: of the hull of a mesh that is none, see `Piece`.
    label: of the hull that it is written of, empty for none; readers set none.
    """

    name: str
    body: str
    shape: Shape
    parent: str | None = None
    contact: tuple[tuple[str, str], ...] = ()
    mentions: Mentions = ()
    element: str = ""
    fill: float | None = None
    label: str = ""


Rgba = tuple[float, float, float, float]
"""A colour as screens show it: four shares of 1, the last of them opacity."""


@dataclass(frozen=True, eq=False, slots=True)
class Texture:
    """A PNG on a surface, in the place of its colour; coordinates: (n, 2) of each vertex, to the right and up."""

    coordinates: Floats
    picture: bytes


@dataclass(frozen=True, eq=False, slots=True)
class Surface:
    """Triangles to look at, or to decompose; vertices (n, 3) [m] in the root frame, faces (m, 3).

    body: the one that shows it, None where the file does not say; rgba: its colour, None where it has no single one;
    texture: the picture that it has instead; parts: of its faces, where the file names or separates some.
    """

    vertices: Floats
    faces: Ints
    body: str | None = None
    rgba: Rgba | None = None
    texture: Texture | None = None
    parts: SurfaceParts | None = None


@dataclass(frozen=True, eq=False, slots=True)
class NonConvexPiece:
    """Collision geometry that is no convex hull: shown with its reason, never selected, written back untouched.

    plane: root_T_plane of one that is an endless plane, whose normal is Z; mentions, element: see `Geom`.
    """

    name: str
    body: str
    reason: str
    surface: Surface | None = None
    plane: Pose | None = None
    mentions: Mentions = ()
    element: str = ""


@dataclass(frozen=True, slots=True)
class Coupling:
    """How a joint follows another one: it is at the sum of coefficients[k] * x ** k, x being where the other one is.

    Both count from zero [rad] or [m]; a linear coupling has two coefficients.
    """

    joint: str
    coefficients: tuple[float, ...] = (0.0, 1.0)

    @property
    def is_linear(self) -> bool:
        return len(self.coefficients) == 2


@dataclass(frozen=True, eq=False, slots=True)
class Joint:
    """How a body moves against another, described where all joints are at zero.

    name: empty where the file gives none; parent, child: the bodies it joins.
    anchor: (3,), a point of the axis, or the centre of a ball [m]; axis: (3,), of unit length; both in the root frame.
    limits: [rad] or [m] from zero, None where there are none; empty_limits: those of the file, in its unit, where the
    lower one is not below the upper one, which engines take for none.
    damping, friction: of the file, 0 where it has none; effort [N or Nm], velocity [m/s or rad/s]: the largest, None
    where it has none. coupling: by which it follows another one. Several joints of one child act one after another, the
    first one nearest to the parent.
    """

    name: str
    kind: JointKind
    parent: str
    child: str
    anchor: Floats
    axis: Floats
    limits: tuple[float, float] | None = None
    damping: float = 0.0
    friction: float = 0.0
    effort: float | None = None
    velocity: float | None = None
    empty_limits: tuple[float, float] | None = None
    coupling: Coupling | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "anchor", freeze_floats(self.anchor, (3,)))
        object.__setattr__(self, "axis", freeze_floats(self.axis, (3,)))

    def measure_distance(self, points: Floats) -> float:
        """Return how far the farthest of points (n, 3) is from the axis, of a ball from its centre [m]."""
        off = points - self.anchor
        return float(np.linalg.norm(off if self.kind == "ball" else np.cross(off, self.axis), axis=1).max())


@dataclass(frozen=True, eq=False, slots=True)
class Inertial:
    """What a body weighs: mass [kg], centre (3,) of mass [m], inertia (3, 3) about it [kg m^2], in the root frame."""

    body: str
    mass: float
    centre: Floats
    inertia: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "centre", freeze_floats(self.centre, (3,)))
        object.__setattr__(self, "inertia", freeze_floats(self.inertia, (3, 3)))


@dataclass(frozen=True, eq=False, slots=True)
class Mechanism:
    """The joints of an asset, which make its bodies one or more trees, and the masses that the file has.

    apart: pairs of bodies that the file keeps from colliding; paired: pairs of geoms that it has collide all the same,
    whatever their bodies and contact attributes. added: those apart that the file does not say yet.
    """

    joints: tuple[Joint, ...] = ()
    inertials: tuple[Inertial, ...] = field(default=())
    apart: tuple[tuple[str, str], ...] = ()
    paired: tuple[tuple[str, str], ...] = ()
    added: tuple[tuple[str, str], ...] = ()

    def move(self, pose: Pose) -> Self:
        """Return the mechanism in another root frame; pose: new_T_old."""
        turn = pose.rotation
        return replace(
            self,
            joints=tuple(
                replace(j, anchor=turn @ j.anchor + pose.translation, axis=turn @ j.axis) for j in self.joints
            ),
            inertials=tuple(
                Inertial(i.body, i.mass, turn @ i.centre + pose.translation, turn @ i.inertia @ turn.T)
                for i in self.inertials
            ),
        )


MISSING_REMEDY = "It cannot do without: put each file there, or correct the reference."
"""What to do where files are not there that an asset needs."""


class Document:
    """Base of the kept source of an asset; each format keeps in its own subclass what it needs to write back.

    A document is immutable and pickles, so that an asset can go to a worker process and come back.
    """

    __slots__ = ()


class NameProblem(NamedTuple):
    """A name that was meant to mark collision for an engine and does not; problem completes `<name>: `."""

    engine: str
    name: str
    problem: str = "its name marks no collision"
    remedy: str = ""
    is_hull: bool = False


class FileNote(str):
    """A note on a file as it is: not true of what is written from it in another format."""

    __slots__ = ()


@dataclass(frozen=True, eq=False)
class Asset:
    """A file with collision geometry; immutable, an edit is a new asset with other geoms.

    files: every file that the document refers to, found, absolute, in order of mention.
    missing: references to files that are not there, as written in the document; needed: those of them without which
    something may not collide, or the engine of the format refuses all of it.
    notes: what a user should know about how the file was read, and what it is (`FileNote`); up: the axis that its
    format says points up; view_up: what points up in views and pictures alone, None for `up`.
    mechanism: joints and masses, empty where the format has none.
    name_problems: names in it that an engine does not take as they are meant.
    one_file_a_hull: whether a writer gives each piece of a collision mesh a file and an element of its own.
    """

    path: Path
    format: str
    bodies: tuple[Body, ...]
    geoms: tuple[Geom, ...]
    document: Document
    non_convex: tuple[NonConvexPiece, ...] = ()
    visuals: Sequence[Surface] = ()
    files: tuple[Path, ...] = ()
    missing: tuple[str, ...] = ()
    needed: tuple[str, ...] = ()
    notes: tuple[str, ...] = field(default=())
    mechanism: Mechanism = field(default=Mechanism())
    up: Literal["y", "z"] | None = None
    view_up: Literal["y", "z"] | None = None
    name_problems: tuple[NameProblem, ...] = ()
    one_file_a_hull: bool = False

    @property
    def body_poses(self) -> dict[str, Pose]:
        return {body.name: body.pose for body in self.bodies}

    def refuse_missing(self) -> None:
        """Raise AssetError where a file is not there that the asset cannot do without."""
        if self.needed:
            problem = f"not there: {join_names(self.needed, 5)}"
            raise MissingFilesError(problem, missing=self.needed, where=str(self.path), remedy=MISSING_REMEDY)

    def with_geoms(self, geoms: Iterable[Geom]) -> Self:
        return replace(self, geoms=tuple(geoms))


def unique_names(names: Iterable[str]) -> list[str]:
    """Return the names in order, a repeated one made unique by `@2`, `@3`, ...; others stay as they are."""
    names = list(names)
    taken, out = set(names), []
    seen: dict[str, int] = {}
    for name in names:
        seen[name] = seen.get(name, 0) + 1
        unique = name
        while seen[name] > 1 and unique in taken:
            unique = f"{name}@{seen[name]}"
            seen[name] += unique in taken
        taken.add(unique)
        out.append(unique)
    return out


def unit_vector(axis: Floats) -> Floats | None:
    """Return an axis (3,) in unit length; None where it has no direction."""
    length = float(np.linalg.norm(axis))
    return axis / length if length > 0 else None
