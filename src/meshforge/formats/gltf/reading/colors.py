"""Colours of glTF materials as other formats have them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from meshforge.formats.meshfile.gltf import Scene
from meshforge.formats.meshfile.gltf.items import entries, entry
from meshforge.formats.meshfile.gltf.meshes import Triangles
from meshforge.formats.visuals import Rgba

GAMMA = 2.2
"""Colours of glTF are linear, those of other formats are as screens show them."""


def coloured(scene: Scene, mesh: int, whole: Triangles) -> Iterator[tuple[Triangles, Rgba | None]]:
    """The triangles of a mesh, apart where its parts have colours of their own; None for those without one."""
    parts = entries(entry(scene.tree, "meshes", mesh), "primitives")
    colors = [_color(scene, parts[patch.index].get("material")) for patch in whole.patches]
    if not len(whole.faces):
        return
    if len(set(colors)) == 1:
        yield whole, colors[0]
        return
    start = 0
    for patch, color in zip(whole.patches, colors, strict=True):
        end = start + len(patch.points)
        yield Triangles(whole.vertices[start:end], patch.faces, (patch,)), color
        start = end


def _color(scene: Scene, material: int | None) -> Rgba | None:
    """The colour of a material; None where it has a texture, or tells no colour."""
    shading = {} if material is None else entry(scene.tree, "materials", material).get("pbrMetallicRoughness", {})
    factor = shading.get("baseColorFactor")
    if factor is None or "baseColorTexture" in shading or len(factor) != 4:
        return None
    red, green, blue = (np.clip(np.asarray(factor[:3], dtype=np.float64), 0, 1) ** (1 / GAMMA)).tolist()
    return round(red, 4), round(green, 4), round(blue, 4), float(factor[3])
