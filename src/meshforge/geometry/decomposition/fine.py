"""Fine convex pieces of a surface, none of which reaches over a part boundary that the surface shows: each connected
solid decomposed by itself, its pieces cut at creases; by the region of the surface that they are of."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from contextlib import suppress
from importlib.metadata import version
from pathlib import Path
from typing import Literal

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry import connectivity
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.convex import FLATNESS, convex_hull, principal_extents
from meshforge.geometry.decomposition.by_parts import scale_settings
from meshforge.geometry.decomposition.creases import Creases, cut_at_creases, find_creases
from meshforge.geometry.decomposition.engines import CoacdSettings, DecomposeSettings, VhacdSettings
from meshforge.geometry.decomposition.regions import group_by_region, list_region_solids
from meshforge.geometry.decomposition.run import cache_key, decompose, read_entry, write_entry
from meshforge.geometry.decomposition.triangles import TriangleMesh, clean_triangles, is_sheet, sheet_hulls
from meshforge.geometry.interior import Interior
from meshforge.geometry.shape import Polytope, volume_and_centroid
from meshforge.geometry.solids import volume_of_union

FINE = CoacdSettings(threshold=0.05, resolution=500, mcts_iterations=20, mcts_nodes=10, mcts_max_depth=2)
"""CoACD's settings for fine pieces: those of its authors, but for a shorter search, for time."""
PieceEngine = Literal["coacd", "vhacd"]
FINE_SETTINGS: Mapping[PieceEngine, DecomposeSettings] = {"coacd": FINE, "vhacd": VhacdSettings(resolution=100_000)}
"""The settings for fine pieces of each engine; V-HACD's are those of its authors, with fewer voxels, for time."""
_VERSION = 3  # of what is made of an engine's pieces; another one after any change, so that the cache forgets
_CONVEX = 0.995  # of the volume of its convex hull: such a solid is one piece
_COMPLETE = 0.97  # of a solid's volume, that pieces of its regions must make up
_SMALL = 0.03  # of the surface's diagonal: a smaller component is one piece
_MOST = 80  # components that are decomposed, the largest


def decompose_finely(
    vertices: Floats, faces: Ints, engine: PieceEngine = "coacd", *, cache: Path | None = None
) -> tuple[tuple[Polytope, ...], ...]:
    """Fine convex pieces of vertices (n, 3) [m] and faces (m, 3), by region, the same for the same input.

    engine: which makes them; cache: a folder for the pieces and for results of the engine, None keeps none.
    Raises GeometryError: nothing that has an area, a coordinate that is not finite.
    """
    mesh, settings = clean_triangles(vertices, faces), FINE_SETTINGS[engine]
    key = _cache_key(mesh, settings)
    if cache and (known := read_entry(cache, key)) is not None:
        return group_by_region([Polytope(*piece) for piece in known], mesh.vertices, mesh.faces)
    failed: list[GeometryError] = []
    pieces = _decompose_mesh(mesh, settings, cache, failed)
    if cache and not failed:  # an engine that was killed may not be the next time
        with suppress(OSError):  # a cache that cannot be written costs time alone
            write_entry(cache, key, [(piece.vertices, piece.faces) for piece in pieces])
    return group_by_region(pieces, mesh.vertices, mesh.faces)


def _cache_key(mesh: TriangleMesh, settings: DecomposeSettings) -> str:
    """A digest of geometry, settings, and the versions of all that makes the pieces."""
    text = f"fine pieces {_VERSION} {version('manifold3d')} {cache_key(mesh, settings)}"
    return hashlib.blake2b(text.encode(), digest_size=20).hexdigest()


def _decompose_mesh(
    mesh: TriangleMesh, settings: DecomposeSettings, cache: Path | None, failed: list[GeometryError]
) -> tuple[Polytope, ...]:
    """The pieces of a mesh. failed: gets why an engine failed on a solid."""
    creases = find_creases(mesh.vertices, mesh.faces)
    solids = _find_solids(mesh.vertices, mesh.faces)
    sizes = [float(np.linalg.norm(np.ptp(mesh.vertices[solid], axis=(0, 1)))) for solid in solids]
    least = max(_SMALL * mesh.diagonal, sorted(sizes, reverse=True)[_MOST - 1] if len(sizes) >= _MOST else 0.0)
    pieces: list[Polytope] = []
    for solid, size in zip(solids, sizes, strict=True):
        own = settings if size >= least else None
        found = _decompose_regions(mesh.vertices, solid, own, cache, failed, creases) if own else []
        if not found:
            whole = _decompose_solid(mesh.vertices, solid, own, cache, failed)
            found = _cut_pieces(whole, creases, Interior(mesh.vertices, solid))
        pieces += found
    if not pieces:
        raise GeometryError("the surface has no piece that spans an area")
    return tuple(pieces)


def _find_solids(vertices: Floats, faces: Ints) -> list[Ints]:
    """The connected components of faces, each cavity with the solid that it is in."""
    component = connectivity.components_by_vertices(faces)
    closed = set(connectivity.find_closed_components(faces, component).tolist())
    numbers = np.unique(component).tolist()
    own = {number: faces[component == number] for number in numbers}
    volumes = {number: volume_and_centroid(vertices, own[number])[0] for number in numbers}
    outer = [number for number in numbers if volumes[number] > 0]
    found = {number: [own[number]] for number in numbers}
    for number in numbers:
        homes = [o for o in outer if volumes[o] > -volumes[number] and _is_within(vertices, own[number], own[o])]
        if number in closed and volumes[number] < 0 and homes:
            found[min(homes, key=lambda o: volumes[o])] += found.pop(number)
    return [np.concatenate(rows) for rows in found.values()]


def _is_within(vertices: Floats, inner: Ints, outer: Ints) -> bool:
    a, b = vertices[inner].reshape(-1, 3), vertices[outer].reshape(-1, 3)
    return bool((a.min(axis=0) >= b.min(axis=0)).all() and (a.max(axis=0) <= b.max(axis=0)).all())


def _decompose_regions(
    vertices: Floats,
    faces: Ints,
    settings: DecomposeSettings,
    cache: Path | None,
    failed: list[GeometryError],
    creases: Creases,
) -> list[Polytope]:
    """The pieces of a solid, region by region, so that none reaches over a concave edge between two; nothing where that
    does not make up the solid, or an engine failed."""
    whole, size = Interior(vertices, faces), np.ptp(vertices[faces], axis=(0, 1))
    found, before = list[Polytope](), len(failed)
    for region in list_region_solids(vertices, faces):
        own = scale_settings(settings, np.ptp(region.vertices[region.faces], axis=(0, 1)), size, -1)
        pieces = _decompose_solid(region.vertices, region.faces, own, cache, failed)
        interior = whole if region.open_edges else Interior(region.vertices, region.faces)
        found += _cut_pieces(interior.list_hulls(pieces), creases, interior)
    made_up = len(failed) == before and volume_of_union(found) >= _COMPLETE * volume_and_centroid(vertices, faces)[0]
    return found if made_up else []


def _cut_pieces(pieces: Sequence[Polytope], creases: Creases, interior: Interior) -> list[Polytope]:
    """Pieces cut at creases, and drawn tight around what the interior has of their parts."""
    parts = [part for piece in pieces for part in cut_at_creases(piece, creases, interior)]
    return interior.list_hulls(parts) if len(parts) > 1 else parts


def _decompose_solid(
    vertices: Floats,
    faces: Ints,
    settings: DecomposeSettings | None,
    cache: Path | None,
    failed: list[GeometryError],
) -> list[Polytope]:
    """The pieces of one solid; its convex hull where no engine takes it, and where there are no settings."""
    points = vertices[np.unique(faces)]
    if len(points) < 3 or principal_extents(points)[2][1] <= 0:
        return []
    thickness = FLATNESS * float(np.linalg.norm(np.ptp(points, axis=0)))
    hull = convex_hull(points, name="a piece of the surface", thicken=thickness)
    if settings is None or volume_and_centroid(vertices, faces)[0] >= _CONVEX * hull.volume:
        return [hull]

    def run(corners: Floats, triangles: Ints) -> list[Polytope]:
        return decompose(corners, triangles, settings, close=True, cache=cache)

    try:
        if is_sheet(vertices[faces].reshape(-1, 3)):
            return sheet_hulls(vertices, faces, run, "a piece of the surface")
        return run(vertices, faces)
    except GeometryError as error:
        failed.append(error)
        return [hull]
