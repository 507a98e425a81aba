"""Convex decomposition of any triangle mesh: from the cache or an engine, every result verified convex."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from meshforge.common import GeometryError, pluralize
from meshforge.geometry.convex import FLATNESS, convex_hull, principal_extents
from meshforge.geometry.decomposition.cache import EnginePiece, cache_key, read_entry, write_entry
from meshforge.geometry.decomposition.process import DecompositionProgress, run_engine
from meshforge.geometry.decomposition.settings import CoacdSettings, DecomposeSettings
from meshforge.geometry.decomposition.triangles import TriangleMesh, cap_holes, clean_triangles
from meshforge.geometry.shape import Polytope


def decompose(
    vertices: Any,
    faces: Any,
    settings: DecomposeSettings | None = None,
    *,
    close: bool = False,
    cache: Path | None = None,
    progress: DecompositionProgress | None = None,
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
    settings, note = settings or CoacdSettings(), note or _ignore_note
    mesh = clean_triangles(vertices, faces)
    if close:
        mesh = _close_holes(mesh, note)
    _check_openness(mesh, settings, note)
    pieces = _run_cached(mesh, settings, cache, note, lambda: run_engine(mesh, settings, progress, cancel, timeout))
    hulls = _make_hulls(pieces, mesh.diagonal, note)
    if not hulls:
        raise GeometryError(f"{settings.engine} made no hull", remedy="Try a finer resolution, or the other engine.")
    return hulls


def _run_cached(
    mesh: TriangleMesh,
    settings: DecomposeSettings,
    cache: Path | None,
    note: Callable[[str], None],
    make: Callable[[], list[EnginePiece]],
) -> list[EnginePiece]:
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


def _close_holes(mesh: TriangleMesh, note: Callable[[str], None]) -> TriangleMesh:
    mesh, holes = cap_holes(mesh)
    if holes:
        note(f"{pluralize(holes, 'planar hole')} closed, so that it counts as solid")
    return mesh


def _check_openness(mesh: TriangleMesh, settings: DecomposeSettings, note: Callable[[str], None]) -> None:
    if not mesh.open_edges:
        return
    told = f"the mesh is open ({mesh.open_edges} edges of one triangle only)"
    if isinstance(settings, CoacdSettings) and settings.preprocess_mode == "off":
        raise GeometryError(
            f"{told}, and CoACD returns nonsense for open meshes without preprocessing",
            remedy='Set preprocess_mode to "auto", or close the mesh.',
        )
    note(f"{told}: the engine closes it by voxels, so its hulls may be thicker than the surface, or fill it")


def _make_hulls(pieces: list[EnginePiece], diagonal: float, note: Callable[[str], None]) -> list[Polytope]:
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


def _ignore_note(_: str) -> None: ...
