"""What every mesh file is read into: named surfaces, checked for damage, and their parts, by groups."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from meshforge.common import AssetError, pluralize
from meshforge.geometry import Floats, Ints, SurfaceParts

GAMMA = 2.2
"""Colours of glTF and USD are linear, those of other formats are as screens show them."""

_ODD = re.compile(r"[^A-Za-z0-9_]+")
_NUMBER = re.compile(rb"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[+-]?(nan|inf(inity)?)", re.I)
FARTHEST = 1e15
"""The largest coordinate that is read: farther out, doubles are coarser than a decimetre, and volumes overflow."""


@dataclass(frozen=True, eq=False, slots=True)
class RawSurface:
    """A named part of a mesh file (group, object, node); vertices (n, 3) in the file's own unit, faces (m, 3).

    unit: the metres that the file says its unit has; most engines take no notice of it.
    """

    name: str | None
    vertices: Floats
    faces: Ints
    unit: float = 1.0


def check_surfaces(surfaces: Iterable[RawSurface], where: str) -> list[RawSurface]:
    """Return the surfaces that have triangles.

    Raises AssetError at `where`: no triangle, an index without a vertex, a coordinate or its square not finite.
    """
    surfaces = list(surfaces)
    found = [s for s in surfaces if len(s.faces)]
    if not found:
        points = max((len(s.vertices) for s in surfaces), default=0)
        holds = f", only {pluralize(points, 'vertex', 'vertices')}" if points else ""
        raise AssetError(f"there is no triangle in this file{holds}", where=where, remedy="Export it with its faces.")
    arrays = {id(s.vertices): s.vertices for s in found}
    fine = {key for key, vertices in arrays.items() if np.abs(vertices).max(initial=0.0) <= FARTHEST}
    for surface in found:
        if surface.faces.min() < 0 or surface.faces.max() >= len(surface.vertices):
            raise AssetError("a face names a vertex that is not there", where=where)
        if id(surface.vertices) in fine:
            continue
        used = surface.vertices[np.unique(surface.faces)]
        if not np.isfinite(used).all():
            x, y, z = used[~np.isfinite(used).all(axis=1)][0]
            problem = f"a coordinate is not a finite number, at the vertex {x:.6g} {y:.6g} {z:.6g}"
            raise AssetError(problem, where=where, remedy="Fix or export it again.")
        if (largest := float(np.abs(used).max())) > FARTHEST:
            remedy = "No mesh is that large: fix or export it again."
            raise AssetError(f"a coordinate is {largest:.3g}", where=where, remedy=remedy)
    return found


def to_doubles(values: npt.ArrayLike) -> Floats:
    """Return numbers in double precision; signalling NaN of a damaged file stays NaN without a warning."""
    with np.errstate(invalid="ignore"):
        return np.asarray(values).astype(np.float64)


def cut_fans(corners: Ints, counts: Ints) -> tuple[Ints, Ints]:
    """Cut polygons of so many corners (n,), one after the other, into fans about their first ones.

    Returns the polygon (m,) of each triangle, and the triangles (m, 3).
    """
    triangles = np.maximum(counts - 2, 0)
    polygon = np.repeat(np.arange(len(counts)), triangles)
    first = np.repeat(np.cumsum(counts) - counts, triangles)
    second = first + 1 + np.arange(len(first)) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    return polygon, corners[np.column_stack([first, second, second + 1])]


def stack_triangles(surfaces: Iterable[tuple[Floats, Ints]], start: int = 0) -> tuple[Floats, Ints]:
    """Return the vertices (n, 3) of surfaces one after the other, and all their faces (m, 3), numbered from `start`."""
    vertices, faces = [np.zeros((0, 3))], [np.zeros((0, 3), dtype=np.int64)]
    for points, triangles in surfaces:
        vertices.append(points)
        faces.append(triangles + start)
        start += len(points)
    return np.concatenate(vertices), np.concatenate(faces)


@dataclass(frozen=True, eq=False, slots=True)
class Soup:
    """The triangles of a whole file in file order: vertices (n, 3), faces (m, 3), group (m,) into `names`.

    mentions: what else the file says of its triangles: the kind (see `Mentions`), (m,) into the names, the names.
    """

    vertices: Floats
    faces: Ints
    group: Ints
    names: tuple[str | None, ...]
    mentions: tuple[tuple[str, Ints, tuple[str, ...]], ...] = ()


def join_surfaces(surfaces: Sequence[RawSurface]) -> Soup:
    """Return surfaces as one soup, a group each."""
    if all(s.vertices is surfaces[0].vertices for s in surfaces):
        vertices, faces = surfaces[0].vertices, np.concatenate([s.faces for s in surfaces])
    else:
        vertices, faces = stack_triangles((s.vertices, s.faces) for s in surfaces)
    group = np.repeat(np.arange(len(surfaces)), [len(s.faces) for s in surfaces])
    return Soup(vertices, faces, group, tuple(s.name for s in surfaces))


def text_of(name: bytes) -> str:
    """Return a name in a mesh file as text: UTF-8, or byte by byte, as Windows has it in the west."""
    try:
        return name.decode("utf-8")
    except UnicodeDecodeError:
        return name.decode("latin-1")


def is_number(word: bytes) -> bool:
    """Return whether a word is a decimal number as mesh files have them, `nan` and `inf` included."""
    return _NUMBER.fullmatch(word) is not None


def remedy_for(words: Sequence[bytes]) -> str:
    """Return what to do about words that are no numbers."""
    commas = any(b"," in word for word in words)
    return "Decimal commas are not read: export it with points." if commas else "Fix or export it again."


def parts_of_surfaces(surfaces: Sequence[RawSurface], name: str = "") -> SurfaceParts:
    """Return the parts of surfaces one after the other; name: what one is called that has no name."""
    group = np.repeat(np.arange(len(surfaces)), [len(surface.faces) for surface in surfaces])
    return parts_of_groups(group, [surface.name or name for surface in surfaces])


def parts_of_groups(group: Ints, names: Sequence[str | None]) -> SurfaceParts:
    """Return the parts of triangles of some groups (m,), a part a group, called as it is.

    group: negative for triangles that are only seen; names: of the groups.
    """
    numbers, of_face = np.unique(group, return_inverse=True)
    own = [names[k] if 0 <= k < len(names) else None for k in numbers.tolist()]
    return SurfaceParts(of_face.reshape(-1), tuple(name or f"part_{k}" for k, name in enumerate(own)))


def plain_part_name(name: str) -> str:
    """Return a part's name as names of hulls begin in every format: letters, digits, underscores, no digit first."""
    plain = _ODD.sub("_", name.strip()).strip("_")
    return plain if plain and not plain[0].isdigit() else f"part_{plain}".rstrip("_")
