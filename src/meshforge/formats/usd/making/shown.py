"""What a body shows, in a stage that is made."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshforge.asset import Surface
from meshforge.formats.gltf.reading.colors import GAMMA
from meshforge.formats.usd.writing.specs import Space, mesh, value
from meshforge.formats.visuals import Rgba


def show(holder: Any, name: str, surface: Surface, rgba: Rgba | None, space: Space) -> None:
    """A mesh that is seen and does not collide, with its display colour."""
    from pxr import Gf, Vt

    spec = mesh(holder, name, np.asarray(surface.vertices), surface.faces, space)
    color = rgba or surface.rgba
    if color is None:
        return
    linear = [round(float(c), 6) for c in np.clip(color[:3], 0, 1) ** GAMMA]
    value(spec, "primvars:displayColor", "Color3fArray", Vt.Vec3fArray([Gf.Vec3f(*linear)]))
    if color[3] < 1:
        value(spec, "primvars:displayOpacity", "FloatArray", Vt.FloatArray([float(color[3])]))
