"""Meshes and scenes of trimesh as symbolic meshes: their connected convex pieces are the hulls, as of a mesh file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

import numpy as np

from meshforge.common import UsageError
from meshforge.formats.assets_with_labels import label_hulls
from meshforge.formats.mesh_reader import split_into_pieces
from meshforge.formats.meshfile.surface import RawSurface, check_surfaces, join_surfaces
from meshforge.formats.plain.base import build_asset
from meshforge.symbolic import Label, SymbolicMesh

WHERE = "trimesh"
_REMEDY = "Give a trimesh.Trimesh, a trimesh.Scene, a list of these, or a dict with names for them."


@runtime_checkable
class MeshObject(Protocol):
    """A `trimesh.Trimesh`, or what is like one."""

    @property
    def vertices(self) -> Any:
        """(n, 3) [m]."""

    @property
    def faces(self) -> Any:
        """(m, 3)."""


@runtime_checkable
class SceneObject(Protocol):
    """A `trimesh.Scene`, or what is like one."""

    @property
    def geometry(self) -> Any:
        """Meshes by name."""

    @property
    def graph(self) -> Any:
        """Where they are."""


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
    asset = build_asset(Path(name), WHERE, join_surfaces(surfaces), split_into_pieces(surfaces, name=name))
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
