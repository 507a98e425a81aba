"""Any mesh into a symbolic mesh of convex hulls."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Literal, get_args

from meshforge import geometry
from meshforge.common import UsageError, join_names
from meshforge.formats import mesh_reader, surface_parts
from meshforge.formats.meshfile.surface import RawSurface, check_surfaces, stack_triangles
from meshforge.formats.trimesh_meshes import WHERE, TrimeshObject, list_surfaces
from meshforge.symbolic import Asset, Body, Document, Geom, Surface, SymbolicMesh, unique_names

DecomposeBy = Literal["whole", "parts"]
"""Whether a surface is decomposed at once, or each of the parts that its file names by itself."""


def decompose(
    mesh: str | os.PathLike[str] | TrimeshObject,
    settings: geometry.DecomposeSettings | None = None,
    *,
    by: DecomposeBy = "whole",
    hollow: bool = False,
    timeout: float | None = None,
    cache: bool = True,
    progress: Callable[[str], None] = lambda _: None,
) -> SymbolicMesh:
    """Decompose a mesh into convex hulls by CoACD or V-HACD; the same input gives the same hulls.

    mesh: a mesh file (OBJ, STL, PLY, DAE, GLB), or a mesh or scene of trimesh. settings: `CoacdSettings` or
    `VhacdSettings`, by default CoACD's own; by: `parts` decomposes each group, node and material by itself, so that no
    hull crosses from one to another; hollow: leave planar holes open, so that shells of one sheet are not filled;
    timeout [s]; cache: keep results, and use kept ones; progress: called with what the engine is at. The hulls are
    called `hull_0` and so on, or by their parts, `handle_0`, of one body; `.asset.notes` says what is to be known about
    them.
    Raises AssetError: a file cannot be read; GeometryError: it cannot be decomposed, or the engine took too long;
    UsageError: no such `by`.
    """
    if by not in get_args(DecomposeBy):
        raise UsageError(f"{by!r} is none of {', '.join(get_args(DecomposeBy))}", where="by")
    path, surface = read_surface(mesh)
    notes: list[str] = []
    engine, known = settings or geometry.CoacdSettings(), surface.parts
    folder = geometry.cache_folder() if cache else None
    control = geometry.EngineControl(progress, timeout=timeout)
    if by != "whole" and known and known.is_divided:
        found = geometry.decompose_by_parts(
            surface.vertices,
            surface.faces,
            known,
            engine,
            close=not hollow,
            cache=folder,
            note=notes.append,
            control=control,
        )
        hulls, names = [one.hull for one in found], name_hulls([known.names[one.part] for one in found])
    else:
        hulls = geometry.decompose(
            surface.vertices, surface.faces, engine, close=not hollow, cache=folder, note=notes.append, control=control
        )
        names = _number(["hull"] * len(hulls))
        notes += _describe_parts(known, by)
    geoms = tuple(Geom(name, "body", hull) for name, hull in zip(names, hulls, strict=True))
    body = Body("body", geometry.Pose.identity())
    return SymbolicMesh.of(Asset(path, "decomposition", (body,), geoms, Document(), notes=tuple(notes)))


def read_surface(mesh: str | os.PathLike[str] | TrimeshObject) -> tuple[Path, Surface]:
    """Return the triangles of a mesh file, or of a mesh or scene of trimesh, with their parts. Raises AssetError."""
    surfaces: Sequence[RawSurface]
    if isinstance(mesh, str | os.PathLike):
        path, surfaces = Path(mesh), mesh_reader.read_triangles(Path(mesh))
    else:
        path, surfaces = Path(WHERE), check_surfaces(list_surfaces(mesh), WHERE)
    vertices, faces = stack_triangles((surface.vertices, surface.faces) for surface in surfaces)
    return path, Surface(vertices, faces, parts=surface_parts.parts_of_surfaces(surfaces))


def name_hulls(parts: Sequence[str]) -> list[str]:
    """Return the names of hulls, each by its part and a number: `handle_0`; parts of one name are numbered together."""
    return unique_names(_number([surface_parts.plain_part_name(part) for part in parts]))


def _number(bases: Sequence[str]) -> list[str]:
    """`hull_0`, `hull_1`, ...: each base with the number of its occurrence, all of as many digits."""
    widths = {base: len(str(count - 1)) for base, count in Counter(bases).items()}
    seen: Counter[str] = Counter()
    names = []
    for base in bases:
        names.append(f"{base}_{seen[base]:0{widths[base]}}")
        seen[base] += 1
    return names


def _describe_parts(known: geometry.SurfaceParts | None, by: DecomposeBy) -> list[str]:
    names = list(dict.fromkeys(known.names[k] for k in known.numbers)) if known else []
    if by == "parts":
        return ["no parts are known, by groups, nodes or materials: decomposed as a whole"]
    if known and known.is_divided:
        return [f"a hull may hold several of its parts ({join_names(names, 3)}); --by parts keeps them apart"]
    return []
