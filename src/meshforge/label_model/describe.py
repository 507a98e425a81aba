"""Hulls described so that the same part of another asset is described alike: a mesh set upright first, since files tilt
their assets, then a row of numbers for each hull."""

from dataclasses import dataclass
from hashlib import blake2b

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.label_model import surroundings
from meshforge.label_model.surroundings import WholeShape, axes_along, whole_of
from meshforge.label_model.ties import EQUAL, first_greatest, greatest_first, share_ranks
from meshforge.language import Orient, find_rotation
from meshforge.symbolic import SymbolicMesh

_SAME_SIDE = np.cos(np.radians(4.0))  # faces of the whole that turn by less are one side of it
_MOST_SIDES = 24  # sides of the whole that it may stand on, the largest first
_SOFT = 3.0  # degrees by which a face may lean and still count as level or plumb
_PLUMB = 0.3  # worth of a plumb face beside a level one
_FAR = 40.0  # degrees from the file's own upright axis at which a direction is worth a third
_STAYS = 0.05  # how much better another direction must be than the file's own
_OTHER = np.cos(np.radians(30.0))  # directions that turn by less are one and the same way to lie


def up_in_file(mesh: SymbolicMesh) -> Floats:
    """Return the axis (3,) that points up by what the file of a mesh says."""
    return np.array([0.0, 1.0, 0.0] if mesh.asset and mesh.asset.up == "y" else [0.0, 0.0, 1.0])


def find_up(mesh: SymbolicMesh, axis: Floats | None = None) -> Floats:
    """Return the direction (3,) that points up in a mesh, whatever small turn its file gave it.

    Of the file's upright axis and the directions in which the whole could lie flat, the one in which most of the
    hulls' faces are level or plumb, those near the file's axis before others. axis: another one in its place.
    """
    axis = up_in_file(mesh) if axis is None else axis
    found = np.concatenate([axis[None], _flat_sides(mesh)])
    worth = _score(mesh, found) * np.exp(-((_to_degrees(found @ axis) / _FAR) ** 2))
    worth[0] += _STAYS
    return found[first_greatest(worth)]


def find_other_sides(mesh: SymbolicMesh, up: Floats, most: int) -> list[Floats]:
    """Return up to `most` directions (3,) that point up if the mesh lies on another side than it seems to.

    Those under which most of the hulls' faces are level or plumb come first. up: what seems to be up.
    """
    sides = _flat_sides(mesh)
    found = [up]
    for place in greatest_first(_score(mesh, sides)):
        if len(found) <= most and all(sides[place] @ other < _OTHER - EQUAL for other in found):
            found.append(sides[place])
    return found[1:]


def _score(mesh: SymbolicMesh, directions: Floats) -> Floats:
    """How much of the hulls' faces is level or plumb (n,) if each of some directions (n, 3) points up."""
    normals, areas = face_normals(mesh)
    shares = areas / (areas.sum() or 1.0)
    lean = _to_degrees(np.abs(directions @ normals.T))
    level, plumb = (np.exp(-((angle / _SOFT) ** 2)) @ shares for angle in (lean, 90.0 - lean))
    return level + _PLUMB * plumb


def _to_degrees(cosines: Floats) -> Floats:
    return np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0)))


def rotation_to_z(up: Floats) -> Floats:
    """Return the rotation (3, 3) by the smallest angle that takes a direction to Z."""
    cosine = float(up[2])
    if cosine < -1 + 1e-12:
        return np.diag([1.0, -1.0, -1.0])
    x, y = float(up[0]), float(up[1])
    cross = np.array([[0.0, 0.0, -x], [0.0, 0.0, -y], [x, y, 0.0]])
    turn: Floats = np.eye(3) + cross + cross @ cross / (1 + cosine)
    return turn


def find_upright_rotation(mesh: SymbolicMesh, orient: Orient | None) -> Floats:
    """Return the rotation (3, 3) by which a mesh stands: an orientation, then Z up. Raises ProgramError."""
    turn = find_rotation(mesh, orient) if orient else np.eye(3)
    return turn if orient and orient.names_z else rotation_to_z(up_in_file(mesh)) @ turn


def _flat_sides(mesh: SymbolicMesh) -> Floats:
    """Normals (k, 3) of the flat sides of the convex hull of all hulls, outward, the largest first, then inward."""
    from scipy.spatial import ConvexHull, QhullError  # lazy: 0.5 s, half of all imports

    if not mesh.hulls:
        return np.zeros((0, 3))
    points = np.concatenate([hull.vertices for hull in mesh.hulls])
    try:
        whole = ConvexHull(points - points.mean(axis=0))
    except (QhullError, ValueError):  # flat, or all in one place
        return np.zeros((0, 3))
    a, b, c = (whole.points[whole.simplices[:, k]] for k in range(3))
    areas, normals = np.linalg.norm(np.cross(b - a, c - a), axis=1), whole.equations[:, :3]
    free, found = np.ones(len(areas), dtype=bool), list[Floats]()
    while free.any() and len(found) < _MOST_SIDES:
        face = first_greatest(np.where(free, areas, -np.inf), EQUAL * areas.max())
        group = free & (normals @ normals[face] > _SAME_SIDE)
        free &= ~group
        middle = areas[group] @ normals[group]
        found.append(middle / np.linalg.norm(middle))
    return np.array([*found, *(-side for side in found)]).reshape(-1, 3)


def face_normals(mesh: SymbolicMesh) -> tuple[Floats, Floats]:
    """Return unit normals (n, 3) and areas (n,) of all triangles of all hulls that have one."""
    corners = [hull.vertices[hull.faces] for hull in mesh.hulls]
    triangles = np.concatenate(corners) if corners else np.zeros((0, 3, 3))
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    areas = np.linalg.norm(across, axis=1)
    solid = areas > 1e-12 * areas.max(initial=0.0)
    return across[solid] / areas[solid, None], areas[solid] / 2


_LEAST = 1e-6  # of the whole's size; what is thinner counts as so thick
SHAPE_WIDTH = 20
"""Columns of `describe_shapes`."""

_LOOK_COLUMNS = slice(0, 6)  # of the columns of `describe_shapes`, those by which hulls of one mesh look alike
_ALIKE = 0.4  # how far apart these are where two hulls look half alike
COUNT_WIDTH = 6
ROW_WIDTH = surroundings.SURROUNDINGS_WIDTH + 3 * SHAPE_WIDTH + COUNT_WIDTH
"""Columns of `described`."""
SHAPE_COLUMNS = slice(surroundings.SURROUNDINGS_WIDTH, surroundings.SURROUNDINGS_WIDTH + SHAPE_WIDTH)
"""Those of them that tell what a hull is itself."""

_SIDES = 5  # on which a mesh may lie, besides the one it seems to lie on


def describe_shapes(whole: WholeShape, volumes: Floats) -> Floats:
    """Return a row for each hull (n, WIDTH): sizes in logarithms of shares of the whole's, how long, flat and full it
    is, how its axes lie, from where to where it reaches in height and from the upright axis.
    """
    size, corners, counts = whole.size, np.concatenate(whole.pieces), np.array([len(piece) for piece in whole.pieces])
    starts = np.cumsum(counts) - counts
    middle = np.add.reduceat(corners, starts) / counts[:, None]
    offsets = corners - np.repeat(middle, counts, axis=0)
    scatter = np.add.reduceat(offsets[:, :, None] * offsets[:, None, :], starts) / counts[:, None, None]
    values, axes = np.linalg.eigh(scatter)
    spread = np.maximum(2 * np.sqrt(np.maximum(values[:, ::-1], 0.0)), _LEAST * size)
    axes = axes[:, :, ::-1]
    box = spread.prod(axis=1)
    volumes = np.maximum(volumes, 1e-9 * box)
    low, high = np.minimum.reduceat(corners[:, 2], starts), np.maximum.reduceat(corners[:, 2], starts)
    out = np.linalg.norm(corners[:, :2] - whole.axis, axis=1)
    aside = middle[:, :2] - whole.axis
    away = np.linalg.norm(aside, axis=1)
    outward = aside / np.maximum(away, _LEAST * size)[:, None]
    outward = axes_along(np.pad(outward, ((0, 0), (0, 1))), spread, axes)
    return np.column_stack(
        [
            np.log(volumes / size**3) / 3,
            np.log(spread / size),
            np.log(volumes / box) / 3,
            np.log(np.maximum(high - low, _LEAST * size) / size),
            ((low + high) / 2 - whole.foot) / whole.tall,
            away / size,
            axes_along(np.broadcast_to([0.0, 0.0, 1.0], outward.shape), spread, axes),
            (spread[:, 0] - spread[:, 1]) / spread[:, 0],
            (spread[:, 1] - spread[:, 2]) / spread[:, 0],
            spread[:, 2] / spread[:, 0],
            (low - whole.foot) / whole.tall,
            (high - whole.foot) / whole.tall,
            np.minimum.reduceat(out, starts) / whole.wide,
            np.maximum.reduceat(out, starts) / whole.wide,
            outward[:, 0],
            outward[:, 2],
        ]
    )


def _describe_counts(own: Floats, touching: Floats, volumes: Floats) -> Floats:
    """How many hulls look alike, touch, and are there; the share of the volume, of the largest, and the rank."""
    from scipy.spatial.distance import cdist  # lazy: as above

    count = len(own)
    look = own[:, _LOOK_COLUMNS]
    alike = np.exp(-cdist(look, look, "sqeuclidean") / _ALIKE**2).sum(axis=1) - 1
    shares = np.maximum(volumes, 1e-12 * volumes.max() + 1e-300)
    columns = [
        np.log1p(alike),
        np.log1p(touching.sum(axis=1)),
        np.full(count, np.log(count)),
        np.log(shares / shares.max()),
        np.log(shares / shares.sum()),
        share_ranks(volumes) / max(1, count - 1),
    ]
    return np.stack(columns, axis=1)


@dataclass(frozen=True, eq=False, slots=True)
class ShapeDescriptor:
    """A mesh as it is described.

    rows: (n, WIDTH), one a hull, with up what seems to be up; touching: pairs (m, 2) of hulls in contact, in order;
    sides: (k, n, columns), `SHAPE_COLUMNS` of the rows if it lay on another side than it seems to.
    """

    rows: Floats
    touching: Ints
    sides: Floats


class MeshDescriber:
    """A mesh to be described, as it seems to stand and on other sides."""

    def __init__(self, mesh: SymbolicMesh) -> None:
        self._count, self._touching = len(mesh.hulls), np.array(sorted(mesh.contacts), dtype=np.int64).reshape(-1, 2)
        if not mesh.hulls:
            return
        self._volumes = np.array([hull.volume for hull in mesh.hulls])
        triangles = tuple(hull.vertices[hull.faces] for hull in mesh.hulls)
        self._whole = whole_of(tuple(hull.vertices for hull in mesh.hulls), triangles)
        self._up = find_up(mesh)
        self._ups = find_other_sides(mesh, self._up, _SIDES)

    def describe(self) -> ShapeDescriptor:
        """Return the mesh as it seems to stand, and what is quickly told of its other sides."""
        count, columns = self._count, SHAPE_COLUMNS.stop - SHAPE_COLUMNS.start
        if not count:
            return ShapeDescriptor(np.zeros((0, ROW_WIDTH)), self._touching, np.zeros((0, 0, columns)))
        sides = np.array([describe_shapes(self._turn(up), self._volumes) for up in self._ups])
        return ShapeDescriptor(self._describe(self._up), self._touching, sides.reshape(-1, count, columns))

    def describe_side(self, side: int) -> Floats:
        """Return the rows (n, WIDTH) on one of the sides of the sketch."""
        return self._describe(self._ups[side])

    def _turn(self, up: Floats) -> WholeShape:
        return self._whole.rotate(rotation_to_z(up))

    def _describe(self, up: Floats) -> Floats:
        """A row for each hull (n, WIDTH) with one direction (3,) or another as the one that points up.

        What is around it, what it is itself, how the hulls that it touches differ from it (the mean, and the largest),
        and how many there are of what. Neither place nor size nor yaw of the mesh changes it, and a tilt hardly.
        """
        whole, touching = self._turn(up), np.zeros((self._count, self._count))  # symmetric, of 0 and 1
        a, b = self._touching.T
        touching[a, b] = touching[b, a] = 1.0
        own = describe_shapes(whole, self._volumes)
        around = touching * np.sqrt(np.maximum(self._volumes, 0.0))
        total = around.sum(axis=1, keepdims=True)
        mean = np.divide(around @ own, total, out=own.copy(), where=total > 0)
        most = around >= around.max(axis=1, keepdims=True) * (1 - EQUAL)
        largest = np.where(total > 0, most / most.sum(axis=1, keepdims=True) @ own, own)
        counts = _describe_counts(own, touching, self._volumes)
        around_rows = surroundings.describe_surroundings(whole)
        return np.concatenate([around_rows, own, mean - own, largest - own, counts], axis=1)


def describe_mesh(mesh: SymbolicMesh) -> ShapeDescriptor:
    """Return the descriptor of a mesh; that of the same hulls with other labels is not made again."""
    key = digest_mesh(mesh)
    if key not in _described:
        remember_descriptor(mesh, MeshDescriber(mesh).describe())
    return _described[key]


def remember_descriptor(mesh: SymbolicMesh, descriptor: ShapeDescriptor) -> None:
    """Have `describe_mesh` give a descriptor that was made before."""
    if len(_described) >= _REMEMBERED:
        del _described[next(iter(_described))]
    _described[digest_mesh(mesh)] = descriptor


_REMEMBERED = 4000  # meshes whose descriptors are kept
_described: dict[bytes, ShapeDescriptor] = {}


def digest_mesh(mesh: SymbolicMesh) -> bytes:
    """Return a digest that is equal for meshes that are described alike, whatever their labels."""
    found = blake2b(digest_size=16)
    found.update(f"{mesh.asset.up if mesh.asset else ''} {mesh.contact_distance!r}".encode())
    for hull in mesh.hulls:
        found.update(hull.vertices.tobytes())
    return found.digest()
