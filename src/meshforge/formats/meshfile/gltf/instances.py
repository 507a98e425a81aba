"""Meshes that a node shows many times at once (EXT_mesh_gpu_instancing)."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshforge.formats.meshfile.gltf.buffers import Buffers
from meshforge.formats.meshfile.gltf.items import Json, extension
from meshforge.formats.meshfile.gltf.meshes import Patch, Triangles
from meshforge.formats.meshfile.gltf.turns import turns_of
from meshforge.geometry import Floats, Ints

NAME = "EXT_mesh_gpu_instancing"
_WIDTHS = {"TRANSLATION": 3, "ROTATION": 4, "SCALE": 3}
_MOST = 20_000_000  # vertices of all instances, which a small file may ask for


def is_instanced(node: Json) -> bool:
    """Whether a node shows its mesh many times, not where it is itself."""
    return extension(node, NAME) is not None


def instances(node: Json, buffers: Buffers) -> Floats:
    """The places (k, 4, 4) of the instances of a node, in its space. Raises ValueError: they are damaged."""
    accessors = (extension(node, NAME) or {}).get("attributes", {})
    found = {name: _rows(buffers.accessor(accessors[name]), name) for name in _WIDTHS if name in accessors}
    counts = {len(rows) for rows in found.values()} or {1}
    if len(counts) > 1 or max(counts) > _MOST:
        raise ValueError(f"the attributes of its instances have {' and '.join(map(str, sorted(counts)))} values")
    places = np.tile(np.eye(4), (counts.pop(), 1, 1))
    if "ROTATION" in found:
        places[:, :3, :3] = turns_of(found["ROTATION"])
    if "SCALE" in found:
        places[:, :3, :3] *= found["SCALE"][:, None]
    if "TRANSLATION" in found:
        places[:, :3, 3] = found["TRANSLATION"]
    return places


def repeated(vertices: Floats, faces: Ints, places: Floats) -> tuple[Floats, Ints]:
    """A surface in each of some places (k, 4, 4); a reflection turns its faces round. Raises ValueError: too many."""
    if len(vertices) * len(places) > _MOST:
        raise ValueError(f"{len(places):,} instances of {len(vertices):,} vertices are too many")
    points = np.einsum("kij,nj->kni", places[:, :3, :3], vertices) + places[:, None, :3, 3]
    turned = np.where(_reflects(places)[:, None, None], faces[:, ::-1], faces)
    starts = np.arange(len(places))[:, None, None] * len(vertices)
    return points.reshape(-1, 3), (turned + starts).reshape(-1, 3)


def all_instances(mesh: Triangles, places: Floats) -> Triangles:
    """A mesh in each of some places (k, 4, 4), with the patches of each instance after those of the one before."""
    vertices, faces = repeated(mesh.vertices, mesh.faces, places)
    starts = np.cumsum([0, *(len(patch.points) for patch in mesh.patches)])
    patches = [
        Patch(patch.index, patch.faces[:, ::-1] if reflects else patch.faces, points[start : start + len(patch.points)])
        for points, reflects in zip(vertices.reshape(len(places), -1, 3), _reflects(places), strict=True)
        for patch, start in zip(mesh.patches, starts, strict=False)
    ]
    return Triangles(vertices, faces, tuple(patches))


def _rows(values: Any, name: str) -> Floats:
    rows = np.asarray(values, dtype=np.float64)
    if rows.shape[1] != _WIDTHS[name] or not np.isfinite(rows).all():
        raise ValueError(f"the {name} of its instances should be {_WIDTHS[name]} finite numbers each")
    return rows


def _reflects(places: Floats) -> Any:
    return np.linalg.det(places[:, :3, :3]) < 0
