"""Convex decomposition of any triangle mesh: from the cache or an engine, every result verified convex."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from meshforge.errors import GeometryError
from meshforge.geometry.convex import FLATNESS, convex_hull, principal_extents
from meshforge.geometry.decompose.cache import Piece, cache_key, read_entry, write_entry
from meshforge.geometry.decompose.child import Progress, run_engine
from meshforge.geometry.decompose.holes import capped
from meshforge.geometry.decompose.settings import CoacdSettings, DecomposeSettings
from meshforge.geometry.decompose.surface import Triangles, sound_triangles
from meshforge.geometry.shapes import Polytope
from meshforge.words import counted


def decompose(
    vertices: Any,
    faces: Any,
    settings: DecomposeSettings | None = None,
    *,
    close: bool = False,
    cache: Path | None = None,
    progress: Progress | None = None,
    cancel: Callable[[], bool] | None = None,
    timeout: float | None = None,
    note: Callable[[str], None] | None = None,
) -> list[Polytope]:
    """Convex hulls that together approximate a mesh, in the engine's order, the same for the same input.

    vertices (n, 3) [m], faces (m, 3); settings: CoACD's defaults when None; close: planar holes are closed first where
    that makes the mesh a solid, so it counts as filled; cache: a folder for results (see `cache_folder`), None keeps
    none; timeout: [s]; note: told what a user should know about mesh and result.
    Raises GeometryError: a mesh that cannot be decomposed, an engine that crashed or took too long;
    DecompositionCancelledError when `cancel` said so.
    """
    settings, note = settings or CoacdSettings(), note or _unheard
    mesh = sound_triangles(vertices, faces)
    if close:
        mesh = _closed(mesh, note)
    _judge_openness(mesh, settings, note)
    pieces = _cached(mesh, settings, cache, note, lambda: run_engine(mesh, settings, progress, cancel, timeout))
    hulls = _verified(pieces, mesh.diagonal, note)
    if not hulls:
        raise GeometryError(f"{settings.engine} made no hull", remedy="Try a finer resolution, or the other engine.")
    return hulls


def _cached(
    mesh: Triangles,
    settings: DecomposeSettings,
    cache: Path | None,
    note: Callable[[str], None],
    make: Callable[[], list[Piece]],
) -> list[Piece]:
    if cache is None:
        return make()
    key = cache_key(mesh, settings)
    known = read_entry(cache, key)
    if known is not None:
        return known
    pieces = make()
    try:
        write_entry(cache, key, pieces)
    except OSError as error:
        note(f"the result could not be kept in {cache}: {error.strerror or error}")
    return pieces


def _closed(mesh: Triangles, note: Callable[[str], None]) -> Triangles:
    mesh, holes = capped(mesh)
    if holes:
        note(f"{counted(holes, 'planar hole')} closed, so that it counts as solid")
    return mesh


def _judge_openness(mesh: Triangles, settings: DecomposeSettings, note: Callable[[str], None]) -> None:
    if not mesh.open_edges:
        return
    told = f"the mesh is open ({mesh.open_edges} edges of one triangle only)"
    if isinstance(settings, CoacdSettings) and settings.preprocess_mode == "off":
        raise GeometryError(
            f"{told}, and CoACD returns nonsense for open meshes without preprocessing",
            remedy='Set preprocess_mode to "auto", or close the mesh.',
        )
    note(f"{told}: the engine closes it by voxels, so its hulls may be thicker than the surface, or fill it")


def _verified(pieces: list[Piece], diagonal: float, note: Callable[[str], None]) -> list[Polytope]:
    """The convex hull of each piece: sheets get a thickness, needles and crumbs without an area are dropped."""
    thickness = FLATNESS * diagonal
    hulls, dropped = [], 0
    for k, (points, _) in enumerate(pieces):
        if len(points) < 3 or principal_extents(points)[2][1] < thickness:
            dropped += 1
            continue
        hulls.append(convex_hull(points, name=f"piece {k}", thicken=thickness))
    if dropped:
        note(f"{dropped} of {len(pieces)} pieces were thinner than {thickness:.2g} m in two directions: left out")
    return hulls


def _unheard(_: str) -> None: ...
