"""What a surface encloses, by manifold3d: how much of it shapes have, and the convex hulls of that."""

from collections.abc import Sequence
from typing import Any

import manifold3d
import numpy as np

from meshforge.geometry.arrays import Aabb, Floats, Ints, distinct
from meshforge.geometry.convex import convex_hull, spans_volume
from meshforge.geometry.shape import Polytope
from meshforge.geometry.solids import scale_points, to_manifold
from meshforge.geometry.surface import has_border

_FILLED = 0.98  # of a shape, from which a solid fills it
_CRUMB = 1e-4  # of a shape: a smaller piece of a solid in it is none


class Interior:
    """What a surface of vertices (n, 3) [m] and faces (m, 3) encloses; everything where it encloses nothing."""

    def __init__(self, vertices: Floats, faces: Ints) -> None:
        self._bounds = Aabb.of_points(vertices[distinct(faces)])
        solid = _find_solid(vertices, faces, self._bounds)
        self._solid = solid if solid is not None and solid.volume() > 0 else None

    def measure(self, shape: Polytope) -> float:
        """Return the volume [m^3] that a shape has of it."""
        if self._solid is None:
            return shape.volume
        return float((self._solid ^ to_manifold(shape, self._bounds)).volume()) * self._bounds.diagonal**3

    def list_voids(self, shape: Polytope) -> list[tuple[Floats, Ints]] | None:
        """Return the surface of each connected piece of a shape that is not within; None where nothing is known."""
        if self._solid is None:
            return None
        return [self._surface_of(part) for part in (to_manifold(shape, self._bounds) - self._solid).decompose()]

    def clip(self, vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
        """Return the surface of what another one, of vertices (n, 3) [m] and faces (m, 3), encloses of it; that one as
        it is where nearly all of what it encloses is within."""
        other = _find_solid(vertices, faces, self._bounds)
        if self._solid is None or other is None:
            return vertices, faces
        common = self._solid ^ other
        if common.volume() >= _FILLED * other.volume():
            return vertices, faces
        return self._surface_of(common)

    def _surface_of(self, solid: Any) -> tuple[Floats, Ints]:
        mesh = solid.to_mesh64()
        corners = np.asarray(mesh.vert_properties, dtype=np.float64)[:, :3] * self._bounds.diagonal
        return corners + self._bounds.center, np.asarray(mesh.tri_verts).astype(np.int64)

    def list_hulls(self, shapes: Sequence[Polytope]) -> list[Polytope]:
        """Return the convex hulls of what shapes have of it, one a connected piece; shapes it nearly fills stay."""
        if self._solid is None:
            return list(shapes)
        found = list[Polytope]()
        for shape in shapes:
            whole = to_manifold(shape, self._bounds)
            filled = self._solid ^ whole
            if filled.volume() >= _FILLED * whole.volume():
                found.append(shape)
                continue
            for part in filled.decompose():
                points = np.asarray(part.to_mesh64().vert_properties, dtype=np.float64)[:, :3]
                if part.volume() > _CRUMB * whole.volume() and len(points) > 3 and spans_volume(points):
                    center, size = self._bounds.center, self._bounds.diagonal
                    found.append(convex_hull(points * size + center, name="a piece of a solid"))
        return found


def _find_solid(vertices: Floats, faces: Ints, bounds: Aabb) -> Any | None:
    """What vertices (n, 3) [m] and faces (m, 3) enclose, in coordinates of `to_manifold`; None for no solid.

    manifold3d 3.5.4 refuses most surfaces with a border, and crashes on some.
    """
    if has_border(faces):
        return None
    used, corners = np.unique(faces, return_inverse=True)
    mesh = manifold3d.Mesh64(scale_points(vertices[used], bounds), corners.reshape(-1, 3).astype(np.uint64))
    solid = manifold3d.Manifold(mesh)
    return solid if solid.status() == manifold3d.Error.NoError else None
