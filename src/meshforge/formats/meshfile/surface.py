"""What every mesh file is read into: named surfaces, checked for what no reader may let pass."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from meshforge.errors import AssetError
from meshforge.geometry import Floats, Ints


@dataclass(frozen=True, eq=False, slots=True)
class RawSurface:
    """A named part of a mesh file (group, object, node); vertices (n, 3) in the file's own unit, faces (m, 3)."""

    name: str | None
    vertices: Floats
    faces: Ints


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
