"""What every mesh file is read into: named surfaces, checked for what no reader may let pass."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.errors import AssetError
from meshforge.geometry import Floats, Ints


@dataclass(frozen=True, eq=False, slots=True)
class RawSurface:
    """A named part of a mesh file (group, object, node); vertices (n, 3) in the file's own unit, faces (m, 3).

    unit: the metres that the file says its unit has; most engines take no notice of it.
    """

    name: str | None
    vertices: Floats
    faces: Ints
    unit: float = 1.0


def checked(surfaces: Iterable[RawSurface], where: str) -> list[RawSurface]:
    """The surfaces that have triangles.

    Raises AssetError at `where`: no triangle at all, an index without a vertex, a coordinate that is not finite.
    """
    found = [s for s in surfaces if len(s.faces)]
    if not found:
        raise AssetError("there is no triangle in this file", where=where)
    for surface in found:
        if surface.faces.min() < 0 or surface.faces.max() >= len(surface.vertices):
            raise AssetError("a face names a vertex that is not there", where=where)
        if not np.isfinite(surface.vertices[np.unique(surface.faces)]).all():
            raise AssetError("a coordinate is not a finite number", where=where, remedy="Mend or export it again.")
    return found


def fans(polygons: Iterable[Sequence[int]]) -> Ints:
    """The triangles (m, 3) of polygons, each cut into a fan about its first corner."""
    triangles = [(p[0], b, c) for p in polygons for b, c in itertools.pairwise(p[1:])]
    return np.array(triangles, dtype=np.int64).reshape(-1, 3)
