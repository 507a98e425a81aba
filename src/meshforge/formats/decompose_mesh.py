"""Any mesh into a symbolic mesh of convex hulls."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from meshforge.formats.mesh_reader import read_triangles
from meshforge.formats.meshfile.surface import check_surfaces, stack_triangles
from meshforge.formats.trimesh_meshes import WHERE, TrimeshObject, list_surfaces
from meshforge.geometry import CoacdSettings, DecomposeSettings, EngineControl, Polytope, Pose, cache_folder
from meshforge.geometry import decompose as run_engine
from meshforge.symbolic import Asset, Body, Document, Geom, SymbolicMesh


def decompose(
    mesh: str | os.PathLike[str] | TrimeshObject,
    settings: DecomposeSettings | None = None,
    *,
    hollow: bool = False,
    timeout: float | None = None,
    cache: bool = True,
    progress: Callable[[str], None] = lambda _: None,
) -> SymbolicMesh:
    """Decompose a mesh into convex hulls by CoACD or V-HACD; the same input gives the same hulls.

    mesh: a mesh file (OBJ, STL, PLY, DAE, GLB), or a mesh or scene of trimesh. settings: `CoacdSettings` or
    `VhacdSettings`, by default CoACD's own; hollow: leave planar holes open, so that shells of one sheet are not
    filled; timeout [s]; cache: keep results, and use kept ones; progress: called with what the engine is at.
    The hulls are called `hull_0` and so on, of one body; `.asset.notes` says what is to be known about them.
    Raises AssetError: the file cannot be read; GeometryError: it cannot be decomposed, or the engine took too long.
    """
    if isinstance(mesh, str | os.PathLike):
        path, surfaces = Path(mesh), read_triangles(Path(mesh))
    else:
        path, surfaces = Path(WHERE), check_surfaces(list_surfaces(mesh), WHERE)
    notes: list[str] = []
    hulls = run_engine(
        *stack_triangles((surface.vertices, surface.faces) for surface in surfaces),
        settings or CoacdSettings(),
        close=not hollow,
        cache=cache_folder() if cache else None,
        note=notes.append,
        control=EngineControl(progress, timeout=timeout),
    )
    return SymbolicMesh.of(_to_asset(path, hulls, notes))


def _to_asset(path: Path, hulls: list[Polytope], notes: list[str]) -> Asset:
    """The hulls as an asset of one body, to be written in any format."""
    width = len(str(len(hulls) - 1))
    geoms = tuple(Geom(f"hull_{k:0{width}}", "body", hull) for k, hull in enumerate(hulls))
    return Asset(path, "decomposition", (Body("body", Pose.identity()),), geoms, Document(), notes=tuple(notes))
