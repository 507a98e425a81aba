"""Thumbnails as PNG files."""

from __future__ import annotations

from meshforge import views
from meshforge.geometry import Pose
from meshforge.symbolic import SymbolicMesh

SIZE = (240, 180)


def thumbnail(mesh: SymbolicMesh, pose: Pose | None = None, size: tuple[int, int] = SIZE) -> bytes:
    """A picture of a mesh, encoded as `views.thumbnail` tells, as a PNG file.

    pose: as of `shapes.upright`; of an edited asset, that of the asset as it comes.
    """
    from PIL import Image

    return views.png(Image.fromarray(views.thumbnail(mesh, pose, size), "RGBA"))
