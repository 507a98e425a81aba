"""What a stage shows: all geometry that renders, with its colour; read when somebody looks."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from meshforge.asset import Surface
from meshforge.errors import GeometryError, MeshForgeError
from meshforge.formats.gltf.reading.colors import GAMMA
from meshforge.formats.mesh_parts import placed
from meshforge.formats.usd.library import usd
from meshforge.formats.usd.reading.bodies import Bodies
from meshforge.formats.usd.reading.colliders import is_seen
from meshforge.formats.usd.reading.shapes import parts_of
from meshforge.formats.usd.reading.stage import Scene
from meshforge.formats.usd.reading.triangles import mesh_of
from meshforge.formats.visuals import LazySurfaces, Rgba


class StageSurfaces(LazySurfaces):
    """The visible surfaces of a file, none where it cannot be read any more; bodies: of each prim that shows."""

    def __init__(self, path: Path, bodies: dict[str, str]) -> None:
        self._path, self._bodies = path, bodies

    @staticmethod
    def of(scene: Scene, bodies: Bodies) -> StageSurfaces:
        """The surfaces of an open stage."""
        return StageSurfaces(
            scene.path, {str(prim.GetPath()): bodies.of(prim) for prim in scene.prims() if is_seen(scene, prim)}
        )

    def _make(self) -> list[Surface]:
        try:
            with usd(str(self._path)):
                scene = Scene.open(self._path)
                return [surface for path, body in self._bodies.items() for surface in _shown(scene, path, body)]
        except MeshForgeError:
            return []


def _shown(scene: Scene, path: str, body: str) -> Iterator[Surface]:
    prim = scene.stage.GetPrimAtPath(path)
    linear, offset = scene.placement(prim)
    if not (np.isfinite(linear).all() and np.isfinite(offset).all()):
        return
    rgba = _color(scene, prim)
    if prim.GetTypeName() != "Mesh":
        shapes = [part.shape for part in parts_of(scene, prim, []) if part.shape is not None]
        yield from (Surface(shape.vertices, shape.faces, body, rgba) for shape in shapes)
        return
    try:
        mesh = mesh_of(scene, prim)
    except GeometryError:
        return
    if len(mesh.faces):
        yield replace(placed(mesh.vertices, mesh.faces, linear, offset, body), rgba=rgba)


def _color(scene: Scene, prim: Any) -> Rgba | None:
    """The colour of a prim as screens show it: of its preview surface, else its display colour where that is one."""
    from pxr import UsdGeom, UsdShade

    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    surface = material.ComputeSurfaceSource()[0] if material else None
    if surface and surface.GetIdAttr().Get() == "UsdPreviewSurface":
        color, opacity = surface.GetInput("diffuseColor"), surface.GetInput("opacity")
        if color and not color.HasConnectedSource() and color.Get() is not None:
            alpha = opacity.Get() if opacity and not opacity.HasConnectedSource() else None
            return _rgba(color.Get(), 1.0 if alpha is None else alpha)
    gprim = UsdGeom.Gprim(prim)
    colors, alphas = scene.get(gprim.GetDisplayColorAttr()), scene.get(gprim.GetDisplayOpacityAttr())
    if colors and len(colors) == 1:
        return _rgba(colors[0], alphas[0] if alphas and len(alphas) == 1 else 1.0)
    return None


def _rgba(color: Any, alpha: float) -> Rgba | None:
    values = np.array([*color, alpha], dtype=np.float64)
    if not np.isfinite(values).all():
        return None
    red, green, blue = (round(float(c), 6) for c in np.clip(values[:3], 0, 1) ** (1 / GAMMA))
    return red, green, blue, round(float(np.clip(alpha, 0, 1)), 6)
