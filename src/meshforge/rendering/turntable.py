"""Turntables: an asset, or an asset before and after an edit, seen by a camera that goes once round; as a GIF."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.common import UsageError
from meshforge.geometry import Aabb
from meshforge.rendering.camera import aim_orbit
from meshforge.rendering.canvas import Canvas, write_file
from meshforge.rendering.colors import ColorBy, HullColors, color_hulls
from meshforge.rendering.comparison import joint_bounds
from meshforge.rendering.paint import paint
from meshforge.rendering.picture import build_subject
from meshforge.rendering.raycast import ViewFrame, up_vector
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image


FRAMES = 24
"""Pictures of one turn."""
FRAME_MILLISECONDS = 110
_BACKGROUND = "#FFFFFF"  # even, since a GIF has few colours
_FINE = 2  # rays a pixel, along each side
_COLORS = 255
_SAMPLES = 4  # pictures of a turn that its colours are chosen from


def draw_turn(mesh: SymbolicMesh, turns: Sequence[float], *, size: tuple[int, int], color_by: ColorBy) -> list[Image]:
    """Return a picture of a mesh for each turn, all of `size`; 0 is the view `iso`, 1 is once round."""
    subject = build_subject(mesh, color_hulls(mesh, color_by))
    bounds = joint_bounds(mesh) or Aabb([-1, -1, -1], [1, 1, 1])
    frame = ViewFrame(bounds, up_vector(subject.up))
    pictures = []
    for camera in aim_orbit(turns, subject.up, size, frame.to_unit(bounds.corners)):
        canvas = Canvas(size, _BACKGROUND, None, None, HullColors(subject.layers[0].colors))
        canvas.paste_drawing(paint(subject.layers, frame, camera, _FINE)[0], (0, 0))
        if not subject.layers[0].render_meshes:
            canvas.write_message("no hulls", canvas.room)
        pictures.append(canvas.image)
    return pictures


def list_turns(frames: int = FRAMES) -> list[float]:
    """Return the turns of so many pictures."""
    return [number / frames for number in range(frames)]


def encode_gif(frames: Sequence[Image], milliseconds: int = FRAME_MILLISECONDS) -> bytes:
    """Return pictures of equal size as a GIF that begins anew for ever; the same pictures give the same bytes.

    Raises UsageError where there is none.
    """
    from PIL import Image  # lazy: 0.01 s, only pictures need it

    if not frames:
        raise UsageError("a GIF of no pictures cannot be made")
    width, height = frames[0].size
    some = [frames[k * len(frames) // _SAMPLES] for k in range(min(_SAMPLES, len(frames)))]
    sheet = Image.new("RGB", (width, height * len(some)))
    for place, image in enumerate(some):
        sheet.paste(image, (0, place * height))
    palette = sheet.quantize(_COLORS, method=Image.Quantize.MEDIANCUT)  # one for all: none flickers
    first, *others = [image.convert("RGB").quantize(palette=palette, dither=Image.Dither.NONE) for image in frames]
    stream = BytesIO()
    first.save(stream, "GIF", save_all=True, append_images=others, duration=milliseconds, loop=0, optimize=False)
    return stream.getvalue()


def write_gif(path: Path, frames: Sequence[Image]) -> None:
    """Write pictures as a GIF. Raises UsageError where it cannot be written."""
    write_file(path, encode_gif(frames))
