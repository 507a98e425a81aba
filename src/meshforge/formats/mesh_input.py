"""Mesh files, and meshes and scenes of trimesh, as symbolic meshes: by their connected convex pieces, or decomposed."""

import os
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, Protocol, get_args, runtime_checkable

import numpy as np

from meshforge import geometry
from meshforge.common import UsageError, join_names
from meshforge.formats import mesh_reader
from meshforge.formats.assets_with_labels import label_hulls
from meshforge.formats.meshfile import surface as meshfile
from meshforge.formats.meshfile.surface import RawSurface, check_surfaces
from meshforge.formats.plain.base import build_asset
from meshforge.symbolic import Asset, Body, Document, Geom, Label, Surface, SymbolicMesh, unique_names

WHERE = "trimesh"
_REMEDY = "Give a trimesh.Trimesh, a trimesh.Scene, a list of these, or a dict with names for them."

DecomposeBy = Literal["whole", "parts"]
"""Whether a surface is decomposed at once, or each part that its file names by itself."""


@runtime_checkable
class MeshObject(Protocol):
    """A `trimesh.Trimesh`, or what is like one: vertices (n, 3) [m], and faces (m, 3)."""

    vertices: Any
    faces: Any


@runtime_checkable
class SceneObject(Protocol):
    """A `trimesh.Scene`, or what is like one: meshes by name, and where they are."""

    geometry: Any
    graph: Any


TrimeshObject = MeshObject | SceneObject


def from_trimesh(
    what: TrimeshObject | Iterable[TrimeshObject] | Mapping[str, TrimeshObject],
    *,
    labels: Mapping[str, Label | str] | None = None,
    name: str = WHERE,
) -> SymbolicMesh:
    """Return the symbolic mesh of meshes and scenes of trimesh.

    what: one, several, or several by name. Each connected convex piece is a hull. It is called as its mesh, or its node
    of the scene, with `#k` where that has several pieces. What is not convex is in `.asset.opaque`, with the reason.
    Coordinates are metres in one root frame. labels: by the names of hulls; name: of the mesh, for messages.
    Raises AssetError: no triangles, or coordinates that are not finite; UsageError: it is no mesh;
    HullNotFoundError: a label for a hull that is not there.
    """
    surfaces = check_surfaces(list_surfaces(what), name)
    asset = build_asset(
        Path(name), WHERE, meshfile.join_surfaces(surfaces), mesh_reader.split_into_pieces(surfaces, name=name)
    )
    return label_hulls(SymbolicMesh.of(asset), labels or {})


def list_surfaces(what: Any, name: str | None = None) -> Iterator[RawSurface]:
    """Yield the triangles of meshes and scenes, in the root frame. Raises UsageError."""
    if isinstance(what, SceneObject):
        yield from _list_nodes(what)
    elif isinstance(what, MeshObject):
        own = name or getattr(what, "metadata", {}).get("name")
        yield RawSurface(own, np.asarray(what.vertices, dtype=np.float64), np.asarray(what.faces, dtype=np.int64))
    elif isinstance(what, Mapping):
        for key, item in what.items():
            yield from list_surfaces(item, str(key))
    elif isinstance(what, Iterable) and not isinstance(what, str | bytes):
        for item in what:
            yield from list_surfaces(item, name)
    else:
        raise UsageError(f"a {type(what).__name__} is no mesh of trimesh", remedy=_REMEDY)


def _list_nodes(scene: SceneObject) -> Iterator[RawSurface]:
    """The meshes of a scene where its nodes put them; paths and points have no triangles."""
    for node in scene.graph.nodes_geometry:
        matrix, key = scene.graph[node]
        mesh = scene.geometry[key]
        if not isinstance(mesh, MeshObject):
            continue
        matrix = np.asarray(matrix, dtype=np.float64)
        vertices = np.asarray(mesh.vertices, dtype=np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
        faces = np.asarray(mesh.faces, dtype=np.int64)
        mirrored = np.linalg.det(matrix[:3, :3]) < 0
        yield RawSurface(str(node), vertices, faces[:, ::-1] if mirrored else faces)


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
    hull crosses from one to another; hollow: leave planar holes open, so that shells of
    one sheet are not filled; timeout [s]; cache: keep results, and use kept ones; progress: called with what the engine
    is at. The hulls are called `hull_0` and so on, or by their parts, `handle_0`, of one body; `.asset.notes` says what
    is to be known about them.
    Raises AssetError: a file cannot be read; GeometryError: it cannot be decomposed, or the engine took too long;
    UsageError: no such `by`.
    """
    if by not in get_args(DecomposeBy):
        raise UsageError(f"{by!r} is none of {', '.join(get_args(DecomposeBy))}", where="by")
    path, surface = _read_surface(mesh)
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


def _read_surface(mesh: str | os.PathLike[str] | TrimeshObject) -> tuple[Path, Surface]:
    """The triangles of a mesh file, or of a mesh or scene of trimesh, with their parts. Raises AssetError."""
    surfaces: Sequence[RawSurface]
    if isinstance(mesh, str | os.PathLike):
        path, surfaces = Path(mesh), mesh_reader.read_triangles(Path(mesh))
    else:
        path, surfaces = Path(WHERE), check_surfaces(list_surfaces(mesh), WHERE)
    vertices, faces = meshfile.stack_triangles((surface.vertices, surface.faces) for surface in surfaces)
    return path, Surface(vertices, faces, parts=meshfile.parts_of_surfaces(surfaces))


def name_hulls(parts: Sequence[str]) -> list[str]:
    """Return the names of hulls, each by its part and a number: `handle_0`; parts of one name are numbered together."""
    return unique_names(_number([meshfile.plain_part_name(part) for part in parts]))


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
    if by == "parts":
        return ["no parts are known, by groups or nodes: decomposed as a whole"]
    if known and known.is_divided:
        names = list(dict.fromkeys(known.names[k] for k in known.numbers))
        return [f"a hull may hold several of its parts ({join_names(names, 3)}); --by parts keeps them apart"]
    return []
