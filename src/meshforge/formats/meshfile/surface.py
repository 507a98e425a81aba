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


@dataclass(frozen=True, eq=False, slots=True)
class Soup:
    """The triangles of a whole file in file order: vertices (n, 3), faces (m, 3), group (m,) into `names`."""

    vertices: Floats
    faces: Ints
    group: Ints
    names: tuple[str | None, ...]


def joined(surfaces: Sequence[RawSurface]) -> Soup:
    """Surfaces as one soup, a group each."""
    shared = all(s.vertices is surfaces[0].vertices for s in surfaces)
    starts = np.cumsum([0, *(0 if shared else len(s.vertices) for s in surfaces)])
    vertices = surfaces[0].vertices if shared else np.concatenate([s.vertices for s in surfaces])
    faces = np.concatenate([s.faces + start for s, start in zip(surfaces, starts, strict=False)])
    group = np.repeat(np.arange(len(surfaces)), [len(s.faces) for s in surfaces])
    return Soup(vertices, faces, group, tuple(s.name for s in surfaces))
