"""The triangles of a glTF mesh: of all its primitives together, in the space of the mesh."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from meshforge.formats.meshfile.gltf.buffers import Buffers
from meshforge.formats.meshfile.gltf.draco import NAME, Decoded, decoded
from meshforge.formats.meshfile.gltf.items import Json, entries, extension
from meshforge.geometry import Floats, Ints

_TRIANGLES, _STRIP, _FAN = 4, 5, 6


@dataclass(frozen=True, eq=False, slots=True)
class Patch:
    """The triangles (m, 3) of one primitive; index: its number in the mesh; decoded: where Draco compressed it."""

    index: int
    faces: Ints
    points: Floats
    decoded: Decoded | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Triangles:
    """Vertices (n, 3) and faces (m, 3) of a mesh, and the patches in the order in which they stand in both."""

    vertices: Floats
    faces: Ints
    patches: tuple[Patch, ...]


def triangles(mesh: Json, buffers: Buffers) -> Triangles:
    """The triangles of a mesh; points and lines are passed over. Raises ValueError: damaged."""
    found = [_patch(k, part, buffers) for k, part in enumerate(entries(mesh, "primitives"))]
    patches = tuple(patch for patch in found if patch is not None)
    starts = np.cumsum([0, *(len(patch.points) for patch in patches)])
    return Triangles(
        np.concatenate([np.empty((0, 3)), *(patch.points for patch in patches)]),
        np.concatenate(
            [np.empty((0, 3), np.int64), *(p.faces + start for p, start in zip(patches, starts, strict=False))]
        ),
        patches,
    )


def _patch(index: int, part: Json, buffers: Buffers) -> Patch | None:
    mode, attributes = part.get("mode", _TRIANGLES), part.get("attributes", {})
    if mode not in (_TRIANGLES, _STRIP, _FAN) or "POSITION" not in attributes:
        return None
    packed = extension(part, NAME)
    if packed is not None and "POSITION" in packed["attributes"]:
        unpacked = decoded(buffers.view(packed["bufferView"]), packed["attributes"])
        points = unpacked.attributes["POSITION"].astype(np.float64)
        return _checked(Patch(index, unpacked.faces, points, unpacked))
    points = buffers.geometry(attributes["POSITION"]).astype(np.float64)
    order: Any = buffers.geometry(part["indices"]).ravel() if "indices" in part else np.arange(len(points))
    if order.dtype.kind not in "iu":
        raise ValueError("the indices of a mesh are no whole numbers")
    return _checked(Patch(index, _as_triangles(order.astype(np.int64), mode), points))


def _checked(patch: Patch) -> Patch:
    """The patch. Raises ValueError: its positions are no points, or a face names none, or one that is not finite."""
    if patch.points.shape[1:] != (3,):
        raise ValueError("the positions of a mesh are no points")
    if len(patch.faces) and (patch.faces.min() < 0 or patch.faces.max() >= len(patch.points)):
        raise ValueError("a face names a vertex that is not there")
    if not np.isfinite(patch.points[patch.faces]).all():
        raise ValueError("a coordinate is not a finite number")
    return patch


def _as_triangles(order: Ints, mode: int) -> Ints:
    if mode == _TRIANGLES:
        return order[: len(order) // 3 * 3].reshape(-1, 3)
    if len(order) < 3:
        return np.empty((0, 3), dtype=np.int64)
    if mode == _FAN:
        return np.column_stack([np.full(len(order) - 2, order[0]), order[1:-1], order[2:]])
    strip = np.column_stack([order[:-2], order[1:-1], order[2:]])
    strip[1::2] = strip[1::2, ::-1]
    return strip
