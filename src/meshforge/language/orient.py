"""The orientation directive, which turns a mesh into the canonical frame that its landmarks ask for."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import hypot

import numpy as np

from meshforge import geometry
from meshforge.common import ProgramError, join_names
from meshforge.geometry import Floats, Pose
from meshforge.language.extractors.base import BaseArgument, BaseExtractor, select_mask
from meshforge.language.extractors.geo import SLACK
from meshforge.language.words import Direction, check_direction
from meshforge.symbolic import SymbolicMesh, bits_of

_PARALLEL = 1e-6  # sine of the angle below which two pairs count as giving one direction

SQUARE_ENOUGH = 1.05
"""The frame as it came is kept when its rectangle is at most this many times the smallest."""
_EIGHT_WAYS = np.array([(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)], dtype=np.float64)
_EQUAL = 1e-9  # areas and angles that differ by less are equal
_ROUNDING = 1e-12  # of the size, by which points on one side of a hull are beside it


@dataclass(frozen=True, slots=True)
class LandmarkPair:
    """The direction from the centre of `start` to the centre of `end` becomes `axis`."""

    axis: Direction
    start: BaseExtractor
    end: BaseExtractor

    def __post_init__(self) -> None:
        check_direction(self.axis)
        for base in (self.start, self.end):
            BaseArgument().check(LandmarkPair, "base", base)

    def __str__(self) -> str:
        return f"{self.axis}: {self.start} -> {self.end}"


@dataclass(frozen=True, slots=True)
class Orient:
    """The orientation directive: one or two landmark pairs on different axes; snap: nearest axis-aligned turn."""

    pairs: tuple[LandmarkPair, ...]
    snap: bool = False

    def __post_init__(self) -> None:
        if len(self.pairs) not in (1, 2):
            raise ProgramError(f"orient takes one or two landmark pairs, not {len(self.pairs)}")
        axes = [pair.axis for pair in self.pairs]
        if len({axis[1] for axis in axes}) != len(axes):
            problem = f"orient names the axis {axes[0][1]} twice"
            raise ProgramError(problem, remedy="Give the second pair another axis than the first.")

    def __str__(self) -> str:
        return f"orient {'snap ' if self.snap else ''}{', '.join(map(str, self.pairs))}"

    @property
    def names_z(self) -> bool:
        """Whether it says what +Z is, so that Z points up whatever the files say."""
        return any(pair.axis.endswith("Z") for pair in self.pairs)


def rename_in_orient(orient: Orient, old: str, new: str) -> Orient:
    """Return the orientation with a label by another name."""
    pairs = (replace(pair, start=pair.start.rename(old, new), end=pair.end.rename(old, new)) for pair in orient.pairs)
    return replace(orient, pairs=tuple(pairs))


def orient_mesh(mesh: SymbolicMesh, orient: Orient | None) -> tuple[SymbolicMesh, Pose]:
    """Return the mesh turned about its frame's origin as the directive says, and the pose oriented_T_incoming.

    None, and a turn by nothing, give the mesh itself. Raises ProgramError naming a landmark that selects nothing,
    or landmarks that give no direction.
    """
    rotation = find_rotation(mesh, orient) if orient else np.eye(3)
    pose = Pose(rotation, np.zeros(3))
    if np.array_equal(rotation, np.eye(3)):
        return mesh, pose
    return mesh.with_hulls(hull.move(pose) for hull in mesh.hulls), pose


def find_rotation(mesh: SymbolicMesh, orient: Orient, labels: Sequence[str | None] | None = None) -> Floats:
    """Return the rotation (3, 3) of `orient_mesh`; labels: in place of those that hulls have."""
    return geometry.snap_rotation(_measure_rotation(mesh, orient, labels))


def _measure_rotation(mesh: SymbolicMesh, orient: Orient, labels: Sequence[str | None] | None) -> Floats:
    directions = [_landmark_direction(mesh, pair, labels) for pair in orient.pairs]
    axes = [_axis_vector(pair.axis) for pair in orient.pairs]
    if len(directions) == 2:
        frame = _frame_of(directions[0], _perpendicular_part(directions, orient))
        rotation: Floats = _frame_of(axes[0], axes[1]).T @ frame
        return geometry.nearest_aligned_rotation(rotation) if orient.snap else rotation
    if orient.snap:
        return geometry.nearest_aligned_rotation_between(directions[0], axes[0])
    return _square_up(mesh, geometry.smallest_rotation(directions[0], axes[0]), "XYZ".index(orient.pairs[0].axis[1]))


def _square_up(mesh: SymbolicMesh, upright: Floats, axis: int) -> Floats:
    """The rotation `upright`, then the turn about the coordinate axis that squares up the footprint."""
    plane = [(axis + 1) % 3, (axis + 2) % 3]
    points = np.concatenate([hull.vertices for hull in mesh.hulls]) @ upright.T
    return geometry.rotation_about(np.eye(3)[axis], square_up_angle(points[:, plane])) @ upright


def _frame_of(first: Floats, second: Floats) -> Floats:
    """The rotation whose rows are two perpendicular unit vectors and the third by the right-hand rule."""
    return np.stack([first, second, np.cross(first, second)])


def _perpendicular_part(directions: list[Floats], orient: Orient) -> Floats:
    first, second = directions
    part = second - (second @ first) * first
    norm = float(np.linalg.norm(part))
    if norm < _PARALLEL:
        pairs = " and ".join(f"{pair.start} -> {pair.end}" for pair in orient.pairs)
        remedy = "Choose a second pair of landmarks that lies across the first, or leave it out."
        raise ProgramError(f"orient: {pairs} run along one line, so they give no frame", remedy=remedy)
    return part / norm


def _landmark_direction(mesh: SymbolicMesh, pair: LandmarkPair, labels: Sequence[str | None] | None) -> Floats:
    (start, from_names), (end, to_names) = (_landmark_centre(mesh, base, labels) for base in (pair.start, pair.end))
    norm = float(np.linalg.norm(end - start))
    if norm <= SLACK * mesh.diagonal:
        raise ProgramError(
            f"orient: the landmarks {pair.start} ({from_names}) and {pair.end} ({to_names}) "
            "have one centre, so they give no direction",
            remedy="Choose landmarks that lie apart, or check the labels of these hulls.",
        )
    return (end - start) / norm


def _landmark_centre(
    mesh: SymbolicMesh, base: BaseExtractor, labels: Sequence[str | None] | None
) -> tuple[Floats, str]:
    """The volume-weighted centroid (3,) of a selection, and the names of its hulls."""
    hulls = [mesh.hulls[index] for index in sorted(bits_of(select_mask(base, mesh, labels=labels)))]
    if not hulls:
        problem = f"orient: the landmark {base} selects nothing"
        raise ProgramError(problem, remedy="Label the hulls that it should select, or orient by another landmark.")
    volumes = np.array([hull.volume for hull in hulls])
    centroids = np.array([hull.shape.centroid for hull in hulls])
    return volumes @ centroids / volumes.sum(), join_names([hull.name for hull in hulls])


def _axis_vector(direction: Direction) -> Floats:
    unit = np.zeros(3)
    unit["XYZ".index(direction[1])] = 1.0 if direction[0] == "+" else -1.0
    return unit


def square_up_angle(footprint: Floats) -> float:
    """Return the angle [rad], at most an eighth of a turn, that squares up points (n, 2) which span an area.

    Of the four quarter turns that do, it is the one nearest to the incoming frame (of two, the positive one).
    A smallest rectangle has a side along an edge of the convex hull, so the edges are all that is tried.
    """
    outline = _find_outline(footprint)
    edges = np.roll(outline, -1, axis=0) - outline
    turns = _fold_angles(-np.arctan2(edges[:, 1], edges[:, 0]))
    areas = np.array([_rectangle_area(outline, turn) for turn in turns])
    smallest = float(areas.min())
    if _rectangle_area(outline, 0.0) <= smallest * SQUARE_ENOUGH:
        return 0.0
    tied = [float(turn) for turn in turns[areas <= smallest * (1 + _EQUAL)]]
    nearest = min(abs(turn) for turn in tied)
    return max(turn for turn in tied if abs(turn) <= nearest + _EQUAL)


def _find_outline(points: Floats) -> Floats:
    """The corners (m, 2) of the convex hull of points (n, 2), counterclockwise (Andrew's monotone chain).

    scipy would take half a second to import.
    """
    least = _ROUNDING * float(np.ptp(points, axis=0).max())  # that a corner sticks out
    places: list[tuple[float, float]] = sorted(set(map(tuple, _drop_inner(points).tolist())))
    return np.array(_turn_left(places, least)[:-1] + _turn_left(places[::-1], least)[:-1])


def _drop_inner(points: Floats) -> Floats:
    """Points (n, 2) without most of those that are no corners of their hull: what lies within the farthest eight."""
    farthest = points[(points @ _EIGHT_WAYS.T).argmax(axis=0)]
    sides = np.roll(farthest, -1, axis=0) - farthest
    farthest, sides = farthest[sides.any(axis=1)], sides[sides.any(axis=1)]
    away = points[:, None] - farthest
    within = ((sides[:, 0] * away[..., 1] - sides[:, 1] * away[..., 0]) > 0).all(axis=1)
    outer: Floats = points[~within]
    return outer


def _turn_left(places: Sequence[tuple[float, float]], least: float) -> list[tuple[float, float]]:
    """Those of places in order from which each way on turns left, by more than `least` [m] beside the way."""
    found: list[tuple[float, float]] = []
    for x, y in places:
        while len(found) > 1:
            (ax, ay), (bx, by) = found[-2:]
            if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > least * hypot(x - ax, y - ay):
                break
            found.pop()
        found.append((x, y))
    return found


def _fold_angles(angles: Floats) -> Floats:
    """The angles up to quarter turns, in (-pi/4, pi/4]; what is -pi/4 but for rounding counts as pi/4."""
    quarter = np.pi / 2
    low = -quarter / 2 + _EQUAL
    return (angles - low) % quarter + low


def _rectangle_area(outline: Floats, turn: float) -> float:
    cosine, sine = np.cos(turn), np.sin(turn)
    return float(np.prod(np.ptp(outline @ np.array([[cosine, sine], [-sine, cosine]]), axis=0)))
