"""Whether MuJoCo finds the new geoms of an edited file as the edit says: their shapes, and what they inherit."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from meshforge.formats.mjcf.reading.model import Reading
from meshforge.formats.mjcf.reading.shapes import Shapes
from meshforge.formats.mjcf.writing.places import Made
from meshforge.geometry import Floats, Shape

if TYPE_CHECKING:
    import mujoco

INHERITED = tuple(
    f"geom_{name}"
    for name in (
        *("contype", "conaffinity", "condim", "priority", "group", "matid", "friction", "solmix", "solref", "solimp"),
        *("margin", "gap", "user", "rgba", "surfacevel", "adhesion", "castshadow"),
    )
)
"""What a made geom has from its parent."""
_SINGLE = 3e-7  # relative: MuJoCo keeps vertices in single precision
_POSE = 1e-9  # relative: a pose through quaternions and frames


def made_amiss(before: Reading, after: Reading, made: dict[int, Made]) -> Iterator[str]:
    """What is not as it should be; made: the new geoms by their numbers after the edit."""
    shapes = Shapes(after.model)
    origins = {name: pose.translation for name, pose in zip(after.body_names, after.body_poses, strict=True)}
    for k, entry in made.items():
        hull = entry.geom
        shape = shapes.part_of(k, after.geom_poses[k]).shape
        if after.body_of[k] != hull.body or not _is(shape, hull.shape, origins[hull.body]):
            yield f"the geometry of hull {hull.name!r}"
        if hull.parent in before.names:
            parent = before.names.index(hull.parent)
            wrong = [field for field in INHERITED if not equal(before.model, after.model, field, parent, k)]
            yield from (f"{field} of hull {hull.name!r}" for field in wrong)


def _is(found: Shape | None, wanted: Shape, origin: Floats) -> bool:
    """Whether a shape is the wanted one, as far as MuJoCo's numbers reach; origin: of its body's frame."""
    if found is None or found.kind != wanted.kind:
        return False
    size = float(np.linalg.norm(wanted.aabb.size))
    away = float(np.linalg.norm(wanted.aabb.center - origin))
    if not found.is_primitive:
        return _farthest(found, wanted) <= _SINGLE * (size + min(away, 1000.0 * size)) + _POSE * away
    corners, others = (shape.tessellate().vertices for shape in (found, wanted))  # each about its own axes
    return bool(np.abs(corners - others).max() <= _POSE * (size + away))


def _farthest(one: Shape, other: Shape) -> float:
    """How far two polytopes reach differently, along the normals of their faces."""
    normals = np.concatenate([_normals(shape) for shape in (one, other)])
    reach, reach_of_other = ((shape.vertices @ normals.T).max(axis=0) for shape in (one, other))
    return float(np.abs(reach - reach_of_other).max())


def _normals(shape: Shape) -> Floats:
    a, b, c = (shape.vertices[shape.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    unit: Floats = normals[lengths > 0] / lengths[lengths > 0][:, None]
    return unit


def equal(
    one: mujoco.MjModel,
    other: mujoco.MjModel,
    field: str,
    rows: int | slice | list[int],
    rows_of_other: int | slice | list[int],
) -> bool:
    """Whether rows of a field are the same in two models; a field that this MuJoCo has not is.

    Numbers of the user's that a geom does not have are zeros, as many as the geom with most of them has.
    """
    if not hasattr(one, field):
        return True
    a, b = np.asarray(getattr(one, field)[rows]), np.asarray(getattr(other, field)[rows_of_other])
    if field == "geom_user":
        both = min(a.shape[-1], b.shape[-1])
        if a[..., both:].any() or b[..., both:].any():
            return False
        a, b = a[..., :both], b[..., :both]
    return np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
