"""Small pictures that say of each pixel which hull it shows and how bright it is, to be coloured by who shows them."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Aabb, Floats, Ints, Pose
from meshforge.symbolic import SymbolicMesh
from meshforge.views.camera import Camera, Singles, View, look
from meshforge.views.light import lit
from meshforge.views.outline import BORDER, CREASE, SILHOUETTE, lines
from meshforge.views.roundness import Skin, skin
from meshforge.views.stage import Hits, Layer, Stage, cast, upright
from meshforge.views.subject import framed, skins_of

Encoded = npt.NDArray[np.uint8]
Number = TypeVar("Number", np.int64, np.float32)

_LARGE = 100_000  # pixels, from which on each is seen by fewer rays
_GREY, _FULL = 0.72, 0.80  # a surface before light falls on it, and what then counts as full light
_DARKER = {CREASE: 0.16, BORDER: 0.62, SILHOUETTE: 0.62}  # by how much lines take light away


def thumbnail(
    mesh: SymbolicMesh, pose: Pose | None = None, size: tuple[int, int] = (240, 180), view: View = "iso"
) -> Encoded:
    """Pixels (height, width, 4): red * 256 + green is the index of a hull plus one, 0 for what is no hull (background,
    opaque pieces); blue is the light there, alpha how much of the pixel is covered. Z points up.

    pose: shown_T_incoming.
    """
    shown = Pose.identity() if pose is None else pose
    opaque = [piece.surface for piece in mesh.asset.opaque if piece.surface] if mesh.asset else []
    hulls = [_turned(one, shown) for one in skins_of(mesh.hulls)]
    others = [_turned(one, shown) for one in map(skin, opaque) if len(one.faces)]
    points = framed(hulls, others)
    if not len(points):
        return np.zeros((size[1], size[0], 4), np.uint8)
    stage = Stage(Aabb.of_points(points), upright("Z"))
    fine = 2 if size[0] * size[1] > _LARGE else 3
    close = look(view, "Z", size, stage.to_unit(points)).supersample(fine)
    hits = cast(Layer([*hulls, *others], np.zeros((0, 3))), stage, close)
    return _encoded(_blocks(hits.item, fine), _blocks(_light(hits, stage, close), fine), len(hulls))


def _turned(one: Skin, pose: Pose) -> Skin:
    normals = None if one.normals is None else one.normals @ pose.rotation.T
    return Skin(pose.apply(one.vertices), one.faces, normals)


def _light(hits: Hits, stage: Stage, camera: Camera) -> Singles:
    """How bright each pixel (h, w) is, in 0..1, lines drawn in."""
    scene = hits.scene
    light = np.zeros(hits.item.shape, np.float32)
    rows, columns = np.nonzero(hits.item >= 0)
    triangle = hits.triangle[rows, columns]
    light[rows, columns] = _bright(scene.normals, stage, camera)[triangle]
    bent = np.nonzero(scene.is_round[triangle])[0]
    if len(bent):
        points = hits.points(camera, rows[bent], columns[bent])
        light[rows[bent], columns[bent]] = _bright(scene.smooth_normals(triangle[bent], points), stage, camera)
    keep = np.ones(max(_DARKER) + 1, np.float32)
    for strength, share in _DARKER.items():
        keep[strength] = 1 - share
    return light * keep[lines(hits, 2)]


def _bright(normals: Floats, stage: Stage, camera: Camera) -> Singles:
    grey = lit(np.full((len(normals), 3), _GREY), normals, camera, stage.upright)[:, 0]
    light: Singles = np.minimum(grey / np.float32(_FULL), np.float32(1))
    return light


def _blocks(pixels: npt.NDArray[Number], fine: int) -> npt.NDArray[Number]:
    """The fine pixels of each pixel (fine * fine, h, w)."""
    return np.stack([pixels[r::fine, c::fine] for r in range(fine) for c in range(fine)])


def _encoded(seen: Ints, light: Singles, hulls: int) -> Encoded:
    """The pixels of what their fine ones (k, h, w) show, and how bright that is."""
    count = (seen >= 0).sum(axis=0)
    item = _told(seen, hulls) + 1
    shade = np.rint(255 * light.sum(axis=0) / np.maximum(count, 1))
    coverage = np.rint(255 * count / len(seen))
    return np.stack([item // 256, item % 256, shade, coverage], axis=2).astype(np.uint8)


def _told(seen: Ints, hulls: int) -> Ints:
    """Which hull each pixel stands for: what its middle shows, else any of what it shows; -1 where that is none."""
    middle = seen[len(seen) // 2]
    told = np.where(middle >= 0, middle, seen.max(axis=0))
    return np.where(told < hulls, told, -1)
