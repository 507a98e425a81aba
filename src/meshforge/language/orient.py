"""The orientation directive: turns a mesh into the canonical frame that its landmarks ask for."""

from __future__ import annotations

import numpy as np

from meshforge.errors import ProgramError
from meshforge.geometry import Floats, Pose
from meshforge.language.evaluate import SLACK, select_mask
from meshforge.language.print import show
from meshforge.language.squaring import squaring_turn
from meshforge.language.syntax import Base, Direction, LandmarkPair, Orient
from meshforge.language.turns import about, exact, nearest_aligned, nearest_aligned_taking, smallest
from meshforge.symbolic import SymbolicMesh, bits
from meshforge.words import listed

_PARALLEL = 1e-6  # sine of the angle below which two pairs count as giving one direction


def orient_mesh(mesh: SymbolicMesh, orient: Orient | None) -> tuple[SymbolicMesh, Pose]:
    """The mesh turned about its frame's origin as the directive says, and the pose oriented_T_incoming.

    None, and a turn by nothing, give the mesh itself. Raises ProgramError naming a landmark that selects nothing,
    or landmarks that give no direction.
    """
    rotation = exact(_rotation(mesh, orient)) if orient else np.eye(3)
    pose = Pose(rotation, np.zeros(3))
    if np.array_equal(rotation, np.eye(3)):
        return mesh, pose
    return mesh.with_hulls(hull.move(pose) for hull in mesh.hulls), pose


def _rotation(mesh: SymbolicMesh, orient: Orient) -> Floats:
    asked = [_direction(mesh, pair) for pair in orient.pairs]
    axes = [_unit(pair.axis) for pair in orient.pairs]
    if len(asked) == 2:
        frame = _frame(asked[0], _across(asked, orient))
        rotation: Floats = _frame(axes[0], axes[1]).T @ frame
        return nearest_aligned(rotation) if orient.snap else rotation
    if orient.snap:
        return nearest_aligned_taking(asked[0], axes[0])
    return _squared(mesh, smallest(asked[0], axes[0]), "XYZ".index(orient.pairs[0].axis[1]))


def _squared(mesh: SymbolicMesh, upright: Floats, axis: int) -> Floats:
    """The rotation `upright`, then the turn about the coordinate axis that squares up the footprint."""
    plane = [(axis + 1) % 3, (axis + 2) % 3]
    points = np.concatenate([hull.vertices for hull in mesh.hulls]) @ upright.T
    turned: Floats = about(np.eye(3)[axis], squaring_turn(points[:, plane])) @ upright
    return turned


def _frame(first: Floats, second: Floats) -> Floats:
    """The rotation whose rows are two perpendicular unit vectors and the third by the right-hand rule."""
    return np.stack([first, second, np.cross(first, second)])


def _across(asked: list[Floats], orient: Orient) -> Floats:
    """The part of the second direction that is perpendicular to the first, at unit length."""
    first, second = asked
    part = second - (second @ first) * first
    norm = float(np.linalg.norm(part))
    if norm < _PARALLEL:
        pairs = " and ".join(f"{show(pair.start)} -> {show(pair.end)}" for pair in orient.pairs)
        raise ProgramError(
            f"orient: {pairs} run along one line, so they give no frame",
            remedy="Choose a second pair of landmarks that lies across the first, or leave it out.",
        )
    unit: Floats = part / norm
    return unit


def _direction(mesh: SymbolicMesh, pair: LandmarkPair) -> Floats:
    """The unit vector from the start of a pair to its end."""
    (start, from_names), (end, to_names) = _landmark(mesh, pair.start), _landmark(mesh, pair.end)
    norm = float(np.linalg.norm(end - start))
    if norm <= SLACK * mesh.diagonal:
        raise ProgramError(
            f"orient: the landmarks {show(pair.start)} ({from_names}) and {show(pair.end)} ({to_names}) "
            "have one centre, so they give no direction",
            remedy="Choose landmarks that lie apart, or check the labels of these hulls.",
        )
    return (end - start) / norm


def _landmark(mesh: SymbolicMesh, base: Base) -> tuple[Floats, str]:
    """The volume-weighted centroid (3,) of a selection, and the names of its hulls."""
    hulls = [mesh.hulls[index] for index in sorted(bits(select_mask(base, mesh)))]
    if not hulls:
        raise ProgramError(
            f"orient: the landmark {show(base)} selects nothing",
            remedy="Label the hulls that it should select, or orient by another landmark.",
        )
    volumes = np.array([hull.volume for hull in hulls])
    centroids = np.array([hull.shape.centroid for hull in hulls])
    return volumes @ centroids / volumes.sum(), listed([hull.name for hull in hulls])


def _unit(direction: Direction) -> Floats:
    unit = np.zeros(3)
    unit["XYZ".index(direction[1])] = 1.0 if direction[0] == "+" else -1.0
    return unit
