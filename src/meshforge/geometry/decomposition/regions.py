"""Regions of a surface between its concave edges, each mostly of one part or side; and the fine pieces of each."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry import connectivity
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.decomposition.creases import drop_degenerate, find_concave
from meshforge.geometry.decomposition.parts import SurfaceParts, join_small_parts
from meshforge.geometry.decomposition.triangles import ROUGH_RIM, TriangleMesh, cap_holes, clean_triangles
from meshforge.geometry.interior import Interior
from meshforge.geometry.shape import Polytope, volume_and_centroid
from meshforge.geometry.surface import is_closed, neighbour_faces, sample_surface

_POINTS, _OWN_POINTS = 20_000, 400  # that stand for the surface, and for that of a piece
_NEAR = 0.01  # of the surface's diagonal, within which a point of a piece lies on the surface


def find_regions(vertices: Floats, faces: Ints) -> Ints:
    """Return the number (m,) of the region of each of faces (m, 3) that have an area, of welded vertices (n, 3)."""
    pairs = neighbour_faces(faces)
    concave = find_concave(vertices[faces], pairs)
    return connectivity.component_roots(pairs[~concave, 0], pairs[~concave, 1], len(faces))


def list_region_solids(vertices: Floats, faces: Ints) -> list[TriangleMesh]:
    """Return what the regions of a solid, of welded vertices (n, 3) [m] and faces (m, 3), enclose of it: each with the
    holes closed where it meets others, as far as these lie about in planes. Nothing where one region encloses all, or
    the solid is open."""
    proper = drop_degenerate(vertices, faces)
    numbers, regions = np.unique(find_regions(vertices, proper), return_inverse=True)
    if len(numbers) == 1 or not is_closed(faces):
        return []
    joined = join_small_parts(vertices, proper, SurfaceParts(regions, tuple(map(str, numbers.tolist()))))
    interior, found = Interior(vertices, faces), list[TriangleMesh]()
    for number in joined.numbers:
        try:
            mesh, _ = cap_holes(clean_triangles(vertices, proper[joined.of_face == number]), ROUGH_RIM)
        except GeometryError:  # flat: it encloses nothing
            continue
        if mesh.open_edges:
            found.append(mesh)
        elif volume_and_centroid(mesh.vertices, mesh.faces)[0] > 0:  # else it bounds a hollow of another
            corners, triangles = interior.clip(mesh.vertices, mesh.faces)
            found += [TriangleMesh(corners, triangles, 0)] if len(triangles) else []
    return found if len(found) > 1 else []


@dataclass(frozen=True, eq=False, slots=True)
class FinePiece:
    """A convex piece of a surface; region, solid: the numbers of what of the surface it is of, from 0."""

    shape: Polytope
    region: int
    solid: int


def find_solids(vertices: Floats, faces: Ints) -> list[Ints]:
    """Return the connected components of faces (m, 3), as the places of their faces, a cavity with its solid."""
    own, volumes, closed = _list_components(vertices, faces)
    found = {number: [places] for number, places in enumerate(own)}
    for number in closed:
        if volumes[number] < 0 and (home := _find_home(vertices, faces, own, volumes, number)) is not None:
            found[home] += found.pop(number)
    return [np.concatenate(rows) for rows in found.values()]


def turn_outward(mesh: TriangleMesh) -> TriangleMesh:
    """Return a mesh whose solids face outward: all its closed components are turned where they are inside out together,
    then each that is and lies in no other."""
    vertices, faces = mesh.vertices, mesh.faces.copy()
    own, volumes, closed = _list_components(vertices, faces)
    turned = set[int](closed if sum(volumes[number] for number in closed) < 0 else ())
    volumes = [-volume if number in turned else volume for number, volume in enumerate(volumes)]
    for number in closed:
        if volumes[number] < 0 and _find_home(vertices, faces, own, volumes, number) is None:
            turned ^= {number}
    for number in turned:
        faces[own[number]] = faces[own[number]][:, ::-1]
    return TriangleMesh(vertices, faces, mesh.open_edges) if turned else mesh


def _list_components(vertices: Floats, faces: Ints) -> tuple[list[Ints], list[float], list[int]]:
    """The components of faces (m, 3), by their first face: the places of the faces of each, its volume [m^3], negative
    where it is inside out, and the numbers of those that are closed."""
    component = connectivity.components_by_vertices(faces)
    own = np.split(np.argsort(component, kind="stable"), np.cumsum(np.bincount(component))[:-1])
    volumes = [volume_and_centroid(vertices, faces[places])[0] for places in own]
    return own, volumes, connectivity.find_closed_components(faces, component).tolist()


def _find_home(vertices: Floats, faces: Ints, own: Sequence[Ints], volumes: Sequence[float], cavity: int) -> int | None:
    """The smallest component around one, by their boxes, that is larger; None where there is none."""
    low, high = _corners_of(vertices, faces[own[cavity]])

    def is_around(number: int) -> bool:
        below, above = _corners_of(vertices, faces[own[number]])
        return bool((low >= below).all() and (high <= above).all())

    homes = (number for number, volume in enumerate(volumes) if volume > -volumes[cavity] and is_around(number))
    return min(homes, key=lambda number: volumes[number], default=None)


def _corners_of(vertices: Floats, faces: Ints) -> tuple[Floats, Floats]:
    points = vertices[faces].reshape(-1, 3)
    return points.min(axis=0), points.max(axis=0)


def number_pieces(pieces: Sequence[Polytope], vertices: Floats, faces: Ints) -> tuple[FinePiece, ...]:
    """Return pieces with the region that has most of the surface at each, and its solid; by region, first come."""
    from scipy.spatial import cKDTree  # lazy: 0.5 s, half of all imports

    faces = drop_degenerate(vertices, faces)
    regions = find_regions(vertices, faces)
    solids = np.zeros(len(faces), dtype=np.int64)
    for solid, own in enumerate(find_solids(vertices, faces)):
        solids[own] = solid
    points, owner = sample_surface(vertices, faces, _POINTS)
    tree = cKDTree(points)
    near = _NEAR * float(np.linalg.norm(np.ptp(vertices, axis=0)))
    found = dict[int, list[Polytope]]()
    for piece in pieces:
        at, _ = sample_surface(piece.vertices, piece.faces, _OWN_POINTS)
        distances, places = map(np.asarray, tree.query(at))
        close = distances <= max(near, float(distances.min()))
        found.setdefault(int(np.bincount(regions[owner[places[close]]]).argmax()), []).append(piece)
    return tuple(
        FinePiece(shape, number, int(solids[np.flatnonzero(regions == region)[0]]))
        for number, (region, shapes) in enumerate(found.items())
        for shape in shapes
    )
