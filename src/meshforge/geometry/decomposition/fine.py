"""Fine convex pieces of a surface, none of which reaches over a part boundary that the surface shows: each connected
solid decomposed by itself, its pieces cut at creases; with the region of the surface that each is of."""

import hashlib
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from importlib.metadata import version
from itertools import chain, islice
from pathlib import Path
from typing import Literal

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.convex import FLATNESS, convex_hull, principal_extents
from meshforge.geometry.decomposition import engines, regions
from meshforge.geometry.decomposition.creases import Creases, cut_at_creases, find_creases
from meshforge.geometry.decomposition.run import (
    cache_key,
    decompose,
    decompose_solids,
    read_entry,
    read_solid,
    write_entry,
)
from meshforge.geometry.decomposition.triangles import TriangleMesh, clean_triangles, is_sheet, sheet_hulls
from meshforge.geometry.decomposition.worker import pack_pieces
from meshforge.geometry.interior import Interior
from meshforge.geometry.shape import Polytope, volume_and_centroid
from meshforge.geometry.solids import volume_of_union

FINE = engines.CoacdSettings(threshold=0.05, resolution=500, mcts_iterations=20, mcts_nodes=10, mcts_max_depth=2)
"""CoACD's settings for fine pieces: those of its authors, but for a shorter search, for time."""
PieceEngine = Literal["coacd", "vhacd"]
FINE_SETTINGS: Mapping[PieceEngine, engines.DecomposeSettings] = {
    "coacd": FINE,
    "vhacd": engines.VhacdSettings(resolution=100_000),
}
"""The settings for fine pieces of each engine; V-HACD's are those of its authors, with fewer voxels, for time."""
_VERSION = 4  # of what is made of an engine's pieces; another one after any change, so that the cache forgets
_CONVEX = 0.995  # of the volume of its convex hull: such a solid is one piece
_COMPLETE = 0.97  # of a solid's volume, that pieces of its regions must make up
_SMALL = 0.03  # of the surface's diagonal: a smaller component is one piece
_MOST = 80  # components that are decomposed, the largest
_NAME = "a piece of the surface"
_LEAST_VOXELS = 10_000  # of a region, for V-HACD, unless the solid is to have fewer
_LOW, _HIGH = 0.01, 1.0  # the limits of CoACD's threshold


def decompose_finely(
    vertices: Floats, faces: Ints, engine: PieceEngine = "coacd", *, cache: Path | None = None
) -> tuple[regions.FinePiece, ...]:
    """Return fine convex pieces of vertices (n, 3) [m] and faces (m, 3), the same for the same input.

    engine: which makes them; cache: a folder for the pieces and for results of the engine, None keeps none.
    Raises GeometryError: nothing that has an area, a coordinate that is not finite.
    """
    mesh, settings = regions.turn_outward(clean_triangles(vertices, faces)), FINE_SETTINGS[engine]
    text = f"fine pieces {_VERSION} {version('manifold3d')} {cache_key(mesh, settings)}"  # all that makes the pieces
    key = hashlib.blake2b(text.encode(), digest_size=20).hexdigest()
    if cache and (known := read_entry(cache, key)) is not None:
        return _unpack(known)
    pieces, failed = _decompose_mesh(mesh, settings, cache)
    found = regions.number_pieces(pieces, mesh.vertices, mesh.faces)
    if cache and not failed:  # an engine that was killed may not be the next time
        with suppress(OSError):  # a cache that cannot be written costs time alone
            write_entry(cache, key, _pack(found))
    return found


def _pack(pieces: Sequence[regions.FinePiece]) -> bytes:
    numbers = np.array([(piece.region, piece.solid) for piece in pieces], dtype=np.int64).reshape(-1, 2)
    return pack_pieces([(piece.shape.vertices, piece.shape.faces) for piece in pieces], numbers=numbers)


def _unpack(content: bytes) -> tuple[regions.FinePiece, ...]:
    (numbers,) = engines.unpack_arrays(content, "numbers")
    rows = zip(engines.unpack_pieces(content), numbers.tolist(), strict=True)
    return tuple(regions.FinePiece(Polytope(*piece), region, solid) for piece, (region, solid) in rows)


@dataclass(frozen=True, eq=False, slots=True)
class _Solid:
    """Vertices (n, 3) [m] and faces (m, 3), and how these are decomposed; settings: None where they are one piece."""

    vertices: Floats
    faces: Ints
    settings: engines.DecomposeSettings | None
    is_open: bool = False


_Result = list[Polytope] | GeometryError
"""The pieces of a solid, or why an engine made none."""


def _decompose_mesh(
    mesh: TriangleMesh, settings: engines.DecomposeSettings, cache: Path | None
) -> tuple[list[Polytope], list[GeometryError]]:
    """The pieces of a mesh, of each solid region by region, so that none reaches over a concave edge between two; of
    the solid as a whole where those do not make it up. Also why an engine failed on any."""
    creases = find_creases(mesh.vertices, mesh.faces)
    solids = _list_solids(mesh, settings)
    regions = [_list_regions(solid) for solid in solids]
    made = _decompose_groups([own or [solid] for solid, own in zip(solids, regions, strict=True)], cache)
    found = [
        _join_regions(solid, own, rows, creases) if own else _cut_whole(solid, rows[0], creases)
        for solid, own, rows in zip(solids, regions, made, strict=True)
    ]
    again = [place for place, pieces in enumerate(found) if pieces is None]
    wholes = _decompose_groups([[solids[place]] for place in again], cache)
    for place, rows in zip(again, wholes, strict=True):
        found[place] = _cut_whole(solids[place], rows[0], creases)
    failed = [row for rows in (*made, *wholes) for row in rows if isinstance(row, GeometryError)]
    pieces = [piece for own in found if own for piece in own]
    if not pieces:
        raise GeometryError("the surface has no piece that spans an area")
    return pieces, failed


def _list_solids(mesh: TriangleMesh, settings: engines.DecomposeSettings) -> list[_Solid]:
    """The solids of a mesh, small ones and all but the largest of many as one piece each."""
    solids = [mesh.faces[own] for own in regions.find_solids(mesh.vertices, mesh.faces)]
    sizes = [float(np.linalg.norm(np.ptp(mesh.vertices[solid], axis=(0, 1)))) for solid in solids]
    least = max(_SMALL * mesh.diagonal, sorted(sizes, reverse=True)[_MOST - 1] if len(sizes) >= _MOST else 0.0)
    return [
        _Solid(mesh.vertices, solid, settings if size >= least else None)
        for solid, size in zip(solids, sizes, strict=True)
    ]


def _list_regions(solid: _Solid) -> list[_Solid]:
    if solid.settings is None:
        return []
    size = np.ptp(solid.vertices[solid.faces], axis=(0, 1))
    found = list[_Solid]()
    for region in regions.list_region_solids(solid.vertices, solid.faces):
        own = _scale_settings(solid.settings, np.ptp(region.vertices[region.faces], axis=(0, 1)), size)
        found.append(_Solid(region.vertices, region.faces, own, region.open_edges > 0))
    return found


def _scale_settings(settings: engines.DecomposeSettings, size: Floats, whole: Floats) -> engines.DecomposeSettings:
    """The settings of a region of some extents (3,) [m] of a solid of others, so that they mean the same for it."""
    if isinstance(settings, engines.HullSettings):
        return settings
    if isinstance(settings, engines.CoacdSettings):
        ratio = float(whole.max() / size.max()) if size.max() > 0 and not settings.real_metric else 1.0
        threshold = settings.threshold if ratio == 1.0 else float(np.clip(settings.threshold * ratio, _LOW, _HIGH))
        return replace(settings, threshold=threshold, max_convex_hull=-1)
    box = float(np.prod(size) / np.prod(whole)) if np.prod(whole) > 0 else 1.0
    least = min(_LEAST_VOXELS, settings.resolution)
    voxels = int(np.clip(round(settings.resolution * box), least, settings.resolution))
    return replace(settings, resolution=voxels, max_convex_hulls=-1)


def _join_regions(
    solid: _Solid, regions: Sequence[_Solid], made: Sequence[_Result], creases: Creases
) -> list[Polytope] | None:
    """The pieces of the regions of a solid, cut; None where they do not make it up, or an engine failed on one."""
    whole, found = Interior(solid.vertices, solid.faces), list[Polytope]()
    for region, pieces in zip(regions, made, strict=True):
        if isinstance(pieces, GeometryError):
            return None
        interior = whole if region.is_open else Interior(region.vertices, region.faces)
        found += _cut_pieces(interior.list_hulls(pieces), creases, interior)
    made_up = volume_of_union(found) >= _COMPLETE * volume_and_centroid(solid.vertices, solid.faces)[0]
    return found if made_up else None


def _cut_whole(solid: _Solid, made: _Result, creases: Creases) -> list[Polytope]:
    """The pieces of a solid, cut; those of its convex hull where an engine failed."""
    pieces = [_hull_of(solid)] if isinstance(made, GeometryError) else made
    return _cut_pieces(pieces, creases, Interior(solid.vertices, solid.faces))


def _cut_pieces(pieces: Sequence[Polytope], creases: Creases, interior: Interior) -> list[Polytope]:
    """Pieces cut at creases, and drawn tight around what the interior has of their parts."""
    parts = [part for piece in pieces for part in cut_at_creases(piece, creases, interior)]
    return interior.list_hulls(parts) if len(parts) > 1 else parts


def _decompose_groups(groups: Sequence[Sequence[_Solid]], cache: Path | None) -> list[list[_Result]]:
    """The pieces of each solid of each group; engines take all that need one together."""
    solids = list(chain(*groups))
    found, asked = dict[int, _Result](), dict[int, engines.EngineJob]()
    for place, solid in enumerate(solids):
        try:
            known = _find_pieces(solid, cache)
            if known is not None or solid.settings is None:
                found[place] = known or []
            else:
                asked[place] = read_solid(solid.vertices, solid.faces, solid.settings, close=True)
        except GeometryError as error:
            found[place] = error
    found |= zip(asked, decompose_solids(list(asked.values()), cache), strict=True)
    rows = (found[place] for place in range(len(solids)))
    return [list(islice(rows, len(group))) for group in groups]


def _find_pieces(solid: _Solid, cache: Path | None) -> list[Polytope] | None:
    """The pieces of a solid that has no area, is convex, flat, or one piece in any case; None of another."""
    points = solid.vertices[np.unique(solid.faces)]
    if len(points) < 3 or principal_extents(points)[2][1] <= 0:
        return []
    hull, settings = _hull_of(solid), solid.settings
    if settings is None or volume_and_centroid(solid.vertices, solid.faces)[0] >= _CONVEX * hull.volume:
        return [hull]
    if not is_sheet(points):
        return None
    run = partial(decompose, settings=settings, close=True, cache=cache)
    return sheet_hulls(solid.vertices, solid.faces, run, _NAME)


def _hull_of(solid: _Solid) -> Polytope:
    points = solid.vertices[np.unique(solid.faces)]
    return convex_hull(points, name=_NAME, thicken=FLATNESS * float(np.linalg.norm(np.ptp(points, axis=0))))
