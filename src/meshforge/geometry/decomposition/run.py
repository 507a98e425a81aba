"""Convex decomposition of any triangle mesh: from the cache or an engine, every result verified convex.

The cache keeps results on disk by content: one file each, written whole or not at all.
"""

import hashlib
import json
import os
from collections.abc import Callable, Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from meshforge.common import GeometryError, pluralize, write_atomically
from meshforge.geometry.arrays import freeze_floats, freeze_ints
from meshforge.geometry.convex import FLATNESS, convex_hull, principal_extents
from meshforge.geometry.decomposition import engines
from meshforge.geometry.decomposition.triangles import TriangleMesh, cap_holes, clean_triangles
from meshforge.geometry.decomposition.worker import pack_pieces
from meshforge.geometry.shape import Polytope
from meshforge.geometry.simplify import HullBudget, enclose

_CHECKSUM_SIZE = 16  # bytes
UNCONTROLLED = engines.EngineControl()


def decompose(
    vertices: Any,
    faces: Any,
    settings: engines.DecomposeSettings | None = None,
    *,
    close: bool = False,
    cache: Path | None = None,
    note: Callable[[str], None] = lambda _: None,
    control: engines.EngineControl = UNCONTROLLED,
) -> list[Polytope]:
    """Return convex hulls that together approximate a mesh, in the engine's order, the same for the same input.

    vertices (n, 3) [m], faces (m, 3); settings: CoACD's defaults when None; close: planar holes are closed first where
    that makes the mesh a solid, so it counts as filled; cache: a folder for results (see `cache_folder`), None keeps
    none; note: called with what a user should know about mesh and result.
    Raises GeometryError: a mesh that cannot be decomposed, an engine that crashed or took too long;
    DecompositionCancelledError: `control` stopped it.
    """
    if isinstance(settings, engines.HullSettings):
        used = freeze_floats(vertices, (-1, 3))[np.unique(freeze_ints(faces, (-1, 3)))]
        thickness = FLATNESS * float(np.linalg.norm(np.ptp(used, axis=0)))
        return [_limit_vertices(convex_hull(used, name="the mesh", thicken=thickness), settings.max_vertices)]
    mesh = read_solid(vertices, faces, settings or engines.CoacdSettings(), close, note)
    (hulls,) = decompose_solids([mesh], cache, note, control)
    if isinstance(hulls, GeometryError):
        raise hulls
    return hulls


def read_solid(
    vertices: Any,
    faces: Any,
    settings: engines.DecomposeSettings,
    close: bool,
    note: Callable[[str], None] = lambda _: None,
) -> engines.EngineJob:
    """Return a mesh as an engine takes it. Raises GeometryError: one that cannot be decomposed."""
    mesh = clean_triangles(vertices, faces)
    if close:
        mesh, holes = cap_holes(mesh)
        if holes:
            note(f"{pluralize(holes, 'planar hole')} closed, so that it counts as solid")
    if mesh.open_edges:
        problem = f"the mesh is open ({mesh.open_edges} edges of one triangle only)"
        if isinstance(settings, engines.CoacdSettings) and settings.preprocess_mode == "off":
            problem = f"{problem}, and CoACD returns nonsense for open meshes without preprocessing"
            raise GeometryError(problem, remedy='Set preprocess_mode to "auto", or close the mesh.')
        note(f"{problem}: the engine closes it by voxels, so its hulls may be thicker than the surface, or fill it")
    return mesh, settings


def decompose_solids(
    solids: Sequence[engines.EngineJob],
    cache: Path | None,
    note: Callable[[str], None] = lambda _: None,
    control: engines.EngineControl = UNCONTROLLED,
) -> list[list[Polytope] | GeometryError]:
    """Return the convex hulls of each of some meshes, or why there are none; see `decompose`."""
    keys = [cache_key(*solid) if cache else "" for solid in solids]
    contents = [read_entry(cache, key) if cache else None for key in keys]
    kept = [None if content is None else engines.unpack_pieces(content) for content in contents]
    new = [number for number, pieces in enumerate(kept) if pieces is None]
    made = dict(zip(new, engines.run_engines([solids[number] for number in new], control) if new else (), strict=True))
    found = list[list[Polytope] | GeometryError]()
    for number, (mesh, settings) in enumerate(solids):
        pieces = made[number] if number in made else kept[number] or []
        try:
            if isinstance(pieces, GeometryError):
                raise pieces
            if cache and number in made:
                try:
                    write_entry(cache, keys[number], pack_pieces(pieces))
                except OSError as error:
                    note(f"the result could not be kept in {cache}: {error.strerror or error}")
            found.append(_make_hulls(pieces, mesh.diagonal, settings, note))
        except GeometryError as error:
            found.append(error)
    return found


def _limit_vertices(hull: Polytope, most: int | None) -> Polytope:
    simpler = enclose(hull, HullBudget(most)) if most and len(hull.vertices) > most else None
    return simpler.hull if simpler else hull


def _make_hulls(
    pieces: list[engines.EnginePiece], diagonal: float, settings: engines.DecomposeSettings, note: Callable[[str], None]
) -> list[Polytope]:
    """The convex hull of each piece, or one around it of as many vertices as a hull may have: sheets get a thickness,
    needles and crumbs without an area are dropped.

    Raises GeometryError where no hull is left.
    """
    thickness = FLATNESS * diagonal
    hulls, dropped = [], 0
    for k, (points, _) in enumerate(pieces):
        if len(points) < 3 or principal_extents(points)[2][1] < thickness:
            dropped += 1
            continue
        hulls.append(_limit_vertices(convex_hull(points, name=f"piece {k}", thicken=thickness), settings.max_vertices))
    if dropped:
        note(f"{dropped} of {len(pieces)} pieces were thinner than {thickness:.2g} m in two directions: left out")
    if not hulls:
        raise GeometryError(f"{settings.engine} made no hull", remedy="Try a finer resolution, or the other engine.")
    return hulls


def cache_folder(environment: Mapping[str, str] = os.environ) -> Path:
    """Return where results are kept: `MESHFORGE_CACHE`, else `XDG_CACHE_HOME/meshforge`, else `~/.cache/meshforge`."""
    if own := environment.get("MESHFORGE_CACHE"):
        return Path(own)
    base = environment.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "meshforge"


def cache_key(mesh: TriangleMesh, settings: engines.DecomposeSettings) -> str:
    """Return a digest of geometry, settings, engine and its version."""
    wheel = version(settings.package)
    header = json.dumps([settings.engine, wheel, settings.as_engine_options(), mesh.vertices.shape], sort_keys=True)
    return hashlib.blake2b(header.encode() + mesh.vertices.tobytes() + mesh.faces.tobytes(), digest_size=20).hexdigest()


def read_entry(folder: Path, key: str) -> bytes | None:
    """Return what is kept under a key, as it was written; None where there is no entry, or one that is damaged."""
    try:
        content = (folder / "decompositions" / f"{key}.npz").read_bytes()
    except OSError:
        return None
    packed = content[:-_CHECKSUM_SIZE]
    return packed if content == _add_checksum(packed) else None


def write_entry(folder: Path, key: str, content: bytes) -> None:
    """Keep what `pack_pieces` made under a key. Raises OSError where the folder cannot be written."""
    write_atomically(folder / "decompositions" / f"{key}.npz", _add_checksum(content))


def _add_checksum(content: bytes) -> bytes:
    """An entry, which ends so that any damage to it is noticed."""
    return content + hashlib.blake2b(content, digest_size=_CHECKSUM_SIZE).digest()
