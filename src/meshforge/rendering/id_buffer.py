"""Which hull each pixel shows, as numbers: thumbnails to be coloured by who shows them; also those in which certain
hulls can be seen, from a side where little hides them, else through what hides them."""

from __future__ import annotations

from collections.abc import Collection
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Aabb, Floats, Ints, Pose
from meshforge.rendering.annotation import count_pixels
from meshforge.rendering.camera import Camera, Floats32, View, aim_camera
from meshforge.rendering.light import shade
from meshforge.rendering.paint import BORDER, CREASE, SILHOUETTE, trace_lines
from meshforge.rendering.picture import points_to_frame, render_meshes_of
from meshforge.rendering.raycast import DrawLayer, RayHits, ViewFrame, cast_layer, up_vector
from meshforge.rendering.scene import RenderMesh, to_render_mesh
from meshforge.symbolic import SymbolicMesh

ThumbnailPixels = npt.NDArray[np.uint8]
Number = TypeVar("Number", np.int64, np.float32)

_LARGE = 100_000  # pixels, from which on each is seen by fewer rays
_GREY, _FULL = 0.72, 0.80  # a surface before light falls on it, and what then counts as full light
_SIDES: tuple[View, ...] = (
    "iso", "front-left-above", "iso-back", "back-right-above", "front-right-below", "front-left-below",
)  # fmt: skip
"""From the usual side to those from which one seldom looks; the first that is good enough is taken."""
_FIRST_SIZE = (160, 120)  # of the pictures in which that is found out
_ENOUGH = 0.35  # of a hull, that is to be seen
_DARKER = {CREASE: 0.16, BORDER: 0.62, SILHOUETTE: 0.62}  # by how much lines take light away


def render_thumbnail(
    mesh: SymbolicMesh,
    pose: Pose | None = None,
    size: tuple[int, int] = (240, 180),
    view: View = "iso",
    through: Collection[int] = (),
) -> ThumbnailPixels:
    """Return pixels (height, width, 4): red * 256 + green is the index of a hull plus one, 0 for what is no hull
    (background, opaque pieces); blue is the light there, alpha how much of the pixel is covered. Z points up.

    pose: shown_T_incoming. through: places of hulls that are seen through what lies before them: of each square of two
    by two pixels, two show them.
    """
    shown = Pose.identity() if pose is None else pose
    non_convex = [piece.surface for piece in mesh.asset.non_convex if piece.surface] if mesh.asset else []
    hulls = [_turn_render_mesh(one, shown) for one in render_meshes_of(mesh.hulls)]
    others = [_turn_render_mesh(one, shown) for one in map(to_render_mesh, non_convex) if len(one.faces)]
    points = points_to_frame(hulls, others)
    if not len(points):
        return np.zeros((size[1], size[0], 4), np.uint8)
    frame = ViewFrame(Aabb.of_points(points), up_vector("Z"))
    fine = 2 if size[0] * size[1] > _LARGE else 3
    close = aim_camera(view, "Z", size, frame.to_unit(points)).supersample(fine)
    hits = cast_layer(DrawLayer([*hulls, *others], np.zeros((0, 3))), frame, close)
    item, light = hits.item, _measure_light(hits, frame, close)
    if through:
        item, light = _look_through(item, light, sorted(through), hulls, frame, close, fine)
    return _encode(_fine_pixels(item, fine), _fine_pixels(light, fine), len(hulls))


def _look_through(
    item: Ints, light: Floats32, places: list[int], hulls: list[RenderMesh], frame: ViewFrame, camera: Camera, fine: int
) -> tuple[Ints, Floats32]:
    """Items and light (h, w) with some hulls shown in every other pixel, as on a chessboard, where others hide them."""
    behind = cast_layer(DrawLayer([hulls[k] for k in places], np.zeros((0, 3))), frame, camera)
    rows, columns = np.indices(item.shape) // fine
    shown = (behind.item >= 0) & ~np.isin(item, places) & ((rows + columns) % 2 == 0)
    own = np.array([*places, -1])[behind.item]
    return np.where(shown, own, item), np.where(shown, _measure_light(behind, frame, camera), light)


def _turn_render_mesh(one: RenderMesh, pose: Pose) -> RenderMesh:
    """Triangles in another frame; pose: shown_T_incoming."""
    normals = None if one.normals is None else one.normals @ pose.rotation.T
    return RenderMesh(pose.apply(one.vertices), one.faces, normals)


def _measure_light(hits: RayHits, frame: ViewFrame, camera: Camera) -> Floats32:
    scene = hits.scene
    light = np.zeros(hits.item.shape, np.float32)
    rows, columns = np.nonzero(hits.item >= 0)
    triangle = hits.triangle[rows, columns]
    light[rows, columns] = _brightness_of(scene.normals, frame, camera)[triangle]
    bent = np.nonzero(scene.is_round[triangle])[0]
    if len(bent):
        points = hits.points(camera, rows[bent], columns[bent])
        light[rows[bent], columns[bent]] = _brightness_of(scene.smooth_normals(triangle[bent], points), frame, camera)
    keep = np.ones(max(_DARKER) + 1, np.float32)
    for strength, share in _DARKER.items():
        keep[strength] = 1 - share
    return light * keep[trace_lines(hits, 2)]


def _brightness_of(normals: Floats, frame: ViewFrame, camera: Camera) -> Floats32:
    grey = shade(np.full((len(normals), 3), _GREY), normals, camera, frame.upright)[:, 0]
    light: Floats32 = np.minimum(grey / np.float32(_FULL), np.float32(1))
    return light


def _fine_pixels(pixels: npt.NDArray[Number], fine: int) -> npt.NDArray[Number]:
    return np.stack([pixels[r::fine, c::fine] for r in range(fine) for c in range(fine)])


def _encode(seen: Ints, light: Floats32, hulls: int) -> ThumbnailPixels:
    """The pixels of what their fine ones (k, h, w) show, and how bright that is.

    A pixel stands for the hull that its middle shows, else for any that it shows.
    """
    count = (seen >= 0).sum(axis=0)
    middle = seen[len(seen) // 2]
    picked = np.where(middle >= 0, middle, seen.max(axis=0))
    item = np.where(picked < hulls, picked, -1) + 1
    shade = np.rint(255 * light.sum(axis=0) / np.maximum(count, 1))
    return np.stack([item // 256, item % 256, shade, np.rint(255 * count / len(seen))], axis=2).astype(np.uint8)


def render_revealing(
    mesh: SymbolicMesh, hulls: Collection[str], pose: Pose | None = None, size: tuple[int, int] = (240, 180)
) -> ThumbnailPixels:
    """Return a picture as `render_thumbnail` encodes it, in which hulls of some known names can be seen.

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
    shown = Pose.identity() if pose is None else pose
    turned = [_turn_render_mesh(one, shown) for one in render_meshes_of(mesh.hulls)]
    best, shares = _SIDES[0], np.zeros(len(wanted))
    for view in _SIDES:
        seen = _shares_seen(turned, wanted, view)
        if (seen >= _ENOUGH).all():
            return view, []
        if np.minimum(seen, _ENOUGH).sum() > np.minimum(shares, _ENOUGH).sum() + 1e-9:
            best, shares = view, seen
    return best, [k for k, share in zip(wanted, shares, strict=True) if share < _ENOUGH]


def _shares_seen(hulls: list[RenderMesh], wanted: list[int], view: View) -> Floats:
    """How much of each wanted hull (k,) is seen, of what would be without the hulls that are not wanted."""
    points = np.concatenate([one.vertices for one in hulls])
    frame = ViewFrame(Aabb.of_points(points), up_vector("Z"))
    camera = aim_camera(view, "Z", _FIRST_SIZE, frame.to_unit(points))
    whole = cast_layer(DrawLayer(hulls, np.zeros((0, 3))), frame, camera).item
    alone = cast_layer(DrawLayer([hulls[k] for k in wanted], np.zeros((0, 3))), frame, camera).item
    seen = count_pixels(whole, len(hulls))[wanted]
    shares: Floats = seen / np.maximum(count_pixels(alone, len(wanted)), 1)
    return shares
