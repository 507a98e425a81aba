"""Which hull each pixel shows, as numbers: thumbnails to be coloured by who shows them; also those in which certain
hulls can be seen, from a side where little hides them, else through what hides them."""

from collections.abc import Collection, Sequence
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Aabb, Floats, Ints, Pose
from meshforge.rendering.annotation import count_pixels
from meshforge.rendering.camera import Camera, Floats32, View, aim_camera
from meshforge.rendering.paint import shade_surface, trace_lines
from meshforge.rendering.picture import points_to_frame, render_meshes_of
from meshforge.rendering.raycast import DrawLayer, ViewFrame, cast_layer, up_vector
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
_KEPT = np.array([1.0, 0.84, 0.38, 0.38], np.float32)  # of the light, by no line, a crease, a border, a silhouette


def render_thumbnail(
    mesh: SymbolicMesh,
    pose: Pose | None = None,
    size: tuple[int, int] = (240, 180),
    view: View = "iso",
    through: Collection[int] = (),
) -> ThumbnailPixels:
    """Return pixels (height, width, 4): red * 256 + green is the index of a hull plus one, 0 for what is no hull
    (background, opaque pieces); blue is the light there, alpha how much of the pixel is covered. Z points up.

    pose: shown_T_incoming. through: places of hulls seen through what is before them, in two of each four pixels.
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
    item, light = _see([*hulls, *others], frame, close)
    if through:  # in every other pixel, as on a chessboard, where others hide them
        places = sorted(through)
        behind, bright = _see([hulls[k] for k in places], frame, close)
        rows, columns = np.indices(item.shape) // fine
        seen = (behind >= 0) & ~np.isin(item, places) & ((rows + columns) % 2 == 0)
        item = np.where(seen, np.array([*places, -1])[behind], item)
        light = np.where(seen, bright, light)
    return _encode(_fine_pixels(item, fine), _fine_pixels(light, fine), len(hulls))


def _turn_render_mesh(one: RenderMesh, pose: Pose) -> RenderMesh:
    """Triangles in another frame; pose: shown_T_incoming."""
    normals = None if one.normals is None else one.normals @ pose.rotation.T
    return RenderMesh(pose.apply(one.vertices), one.faces, normals)


def _see(hulls: Sequence[RenderMesh], frame: ViewFrame, camera: Camera) -> tuple[Ints, Floats32]:
    """Which of some things each pixel (h, w) shows, -1 for none, and how bright it is."""
    layer = DrawLayer(hulls, np.full((len(hulls), 3), _GREY))
    hits = cast_layer(layer, frame, camera)
    light = np.zeros(hits.item.shape, np.float32)
    rows, columns = np.nonzero(hits.item >= 0)
    grey = shade_surface(layer, hits, frame, camera, rows, columns)[:, 0]
    light[rows, columns] = np.minimum(grey / np.float32(_FULL), np.float32(1))
    return hits.item, light * _KEPT[trace_lines(hits, 2)]


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
