"""Pictures in which certain hulls can be seen: from a side where little hides them, else through what hides them."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from meshforge.geometry import Aabb, Floats, Pose
from meshforge.rendering.annotation import count_pixels
from meshforge.rendering.camera import View, aim_camera
from meshforge.rendering.id_buffer import ThumbnailPixels, render_thumbnail, turn_render_mesh
from meshforge.rendering.picture import render_meshes_of
from meshforge.rendering.raycast import DrawLayer, ViewFrame, cast_layer, up_vector
from meshforge.rendering.scene import RenderMesh
from meshforge.symbolic import SymbolicMesh

_SIDES: tuple[View, ...] = (
    "iso", "front-left-above", "iso-back", "back-right-above", "front-right-below", "front-left-below",
)  # fmt: skip
"""From the usual side to those from which one seldom looks; the first that is good enough is taken."""
_SIZE = (160, 120)  # of the pictures in which that is found out
_ENOUGH = 0.35  # of a hull, that is to be seen


def render_revealing(
    mesh: SymbolicMesh, hulls: Collection[str], pose: Pose | None = None, size: tuple[int, int] = (240, 180)
) -> ThumbnailPixels:
    """A picture as `render_thumbnail` encodes it, in which hulls of some names can be seen; unknown names count not.

    It is from the first side on which enough of each is seen, or else from that with the most of them, where those that
    are hidden are seen through what hides them. pose: shown_T_incoming.
    """
    view, hidden = _choose_side(mesh, hulls, pose)
    return render_thumbnail(mesh, pose, size, view, through=hidden)


def _choose_side(mesh: SymbolicMesh, hulls: Collection[str], pose: Pose | None) -> tuple[View, list[int]]:
    """The side from which hulls of some names are seen best, and the places of those that are hidden there."""
    wanted = sorted(mesh.index[name] for name in set(hulls) if name in mesh.index)
    if not wanted:
        return _SIDES[0], []
    turned = _turn_hulls(mesh, pose)
    best, shares = _SIDES[0], np.zeros(len(wanted))
    for view in _SIDES:
        seen = _shares_seen(turned, wanted, view)
        if (seen >= _ENOUGH).all():
            return view, []
        if np.minimum(seen, _ENOUGH).sum() > np.minimum(shares, _ENOUGH).sum() + 1e-9:
            best, shares = view, seen
    return best, [k for k, share in zip(wanted, shares, strict=True) if share < _ENOUGH]


def _turn_hulls(mesh: SymbolicMesh, pose: Pose | None) -> list[RenderMesh]:
    shown = Pose.identity() if pose is None else pose
    return [turn_render_mesh(one, shown) for one in render_meshes_of(mesh.hulls)]


def _shares_seen(hulls: list[RenderMesh], wanted: list[int], view: View) -> Floats:
    """How much of each wanted hull (k,) is seen, of what would be without the hulls that are not wanted."""
    points = np.concatenate([one.vertices for one in hulls])
    frame = ViewFrame(Aabb.of_points(points), up_vector("Z"))
    camera = aim_camera(view, "Z", _SIZE, frame.to_unit(points))
    whole = cast_layer(DrawLayer(hulls, np.zeros((0, 3))), frame, camera).item
    alone = cast_layer(DrawLayer([hulls[k] for k in wanted], np.zeros((0, 3))), frame, camera).item
    seen = count_pixels(whole, len(hulls))[wanted]
    shares: Floats = seen / np.maximum(count_pixels(alone, len(wanted)), 1)
    return shares
