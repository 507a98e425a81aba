"""Which hull each pixel of a picture shows, to hold pictures against."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from meshforge.geometry import Aabb, Ints
from meshforge.rendering import View
from meshforge.rendering.annotation import count_pixels
from meshforge.rendering.camera import Up, aim_camera
from meshforge.rendering.picture import render_meshes_of, up_axis
from meshforge.rendering.raycast import DrawLayer, ViewFrame, cast_layer, up_vector
from meshforge.symbolic import SymbolicMesh


def render_id_buffer(
    mesh: SymbolicMesh,
    *,
    view: View = "iso",
    size: tuple[int, int] = (400, 300),
    bounds: Aabb | None = None,
    up: Up | None = None,
) -> Ints:
    """The index of the hull that each pixel (height, width) shows, -1 for none; framed as `render` frames a picture
    without words."""
    held = bounds or mesh.aabb
    if held is None or not mesh.hulls:
        return np.full((size[1], size[0]), -1, dtype=np.int64)
    layer = DrawLayer(render_meshes_of(mesh.hulls), np.zeros((len(mesh.hulls), 3)))
    axis = up_axis(mesh, up)
    frame = ViewFrame(held, up_vector(axis))
    points = bounds.corners if bounds else np.concatenate([s.vertices for s in layer.render_meshes])
    return cast_layer(layer, frame, aim_camera(view, axis, size, frame.to_unit(points))).item


def count_visible_pixels(
    mesh: SymbolicMesh, *, view: View = "iso", size: tuple[int, int] = (400, 300), up: Up | None = None
) -> Mapping[str, int]:
    """How many pixels of a picture show each hull, by name; hulls that are hidden have 0."""
    counts = count_pixels(render_id_buffer(mesh, view=view, size=size, up=up), len(mesh.hulls))
    return {hull.name: int(n) for hull, n in zip(mesh.hulls, counts, strict=True)}
