"""What can be seen of each hull, exactly: the pictures' rays without the picture."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from meshforge.geometry import Aabb, Ints
from meshforge.symbolic import SymbolicMesh
from meshforge.views.camera import Up, View, look
from meshforge.views.middles import pixels_of
from meshforge.views.stage import Layer, Stage, cast, upright
from meshforge.views.subject import skins_of, up_axis


def id_buffer(
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
    layer = Layer(skins_of(mesh.hulls), np.zeros((len(mesh.hulls), 3)))
    axis = up_axis(mesh, up)
    stage = Stage(held, upright(axis))
    points = bounds.corners if bounds else np.concatenate([s.vertices for s in layer.skins])
    return cast(layer, stage, look(view, axis, size, stage.to_unit(points))).item


def visible_hulls(
    mesh: SymbolicMesh, *, view: View = "iso", size: tuple[int, int] = (400, 300), up: Up | None = None
) -> Mapping[str, int]:
    """How many pixels of a picture show each hull, by name; hulls that are hidden have 0."""
    items = id_buffer(mesh, view=view, size=size, up=up)
    counts = pixels_of(items, len(mesh.hulls))
    return {hull.name: int(n) for hull, n in zip(mesh.hulls, counts, strict=True)}
