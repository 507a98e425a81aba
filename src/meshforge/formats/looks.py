"""Mesh files of visuals with what they look like: one base colour or picture a mesh, as trimesh reads them."""

from __future__ import annotations

import io
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from meshforge.formats import mesh_reader
from meshforge.formats.meshfile.surface import GAMMA
from meshforge.symbolic import Rgba, Surface, Texture

LOOK_SUFFIXES = (".obj", ".dae", ".glb", ".gltf")
"""The mesh files whose base colours and pictures `read_looks` reads."""
_SLIGHT = 1e-4  # share of the size, by which single precision moves a box


def read_looks(path: Path) -> list[Surface]:
    """The surfaces of a mesh file with their base colours or pictures; plain where trimesh does not read the same.

    Raises AssetError: the file cannot be read.
    """
    plain = [Surface(surface.vertices, surface.faces) for surface in mesh_reader.read_triangles(path)]
    if path.suffix.lower() not in LOOK_SUFFIXES or find_spec("trimesh") is None:
        return plain
    import trimesh  # lazy: 0.3 s, and optional

    try:
        scene = trimesh.load_scene(path, process=False)
        found = [_read_mesh(mesh, path.suffix.lower()) for mesh in scene.dump() if isinstance(mesh, trimesh.Trimesh)]
    except Exception:  # whatever it raises for a damaged file, whose shape is known
        return plain
    return found if _is_same(plain, found) else plain


def _read_mesh(mesh: Any, suffix: str) -> Surface:
    vertices, faces = np.array(mesh.vertices, dtype=np.float64), np.array(mesh.faces, dtype=np.int64)
    material, places = getattr(mesh.visual, "material", None), getattr(mesh.visual, "uv", None)
    image = getattr(material, "baseColorTexture", getattr(material, "image", None))
    if image and image.size == (2, 2) and not image.format:
        return Surface(vertices, faces)  # trimesh made it up, for want of a material
    if image and places is not None and len(places) == len(vertices) and np.isfinite(places).all():
        file = io.BytesIO()
        image.save(file, "PNG")
        return Surface(vertices, faces, texture=Texture(np.array(places, dtype=np.float64), file.getvalue()))
    color = None if image else getattr(material, "baseColorFactor", getattr(material, "diffuse", None))
    if color is None:
        return Surface(vertices, faces)
    red, green, blue, alpha = (np.asarray(color, dtype=np.float64) / 255).tolist()
    linear = suffix in (".glb", ".gltf")
    rgba: Rgba = (*(round(share ** (1 / GAMMA), 4) if linear else share for share in (red, green, blue)), alpha)
    return Surface(vertices, faces, rgba=rgba)


def _is_same(plain: list[Surface], found: list[Surface]) -> bool:
    """Whether surfaces have as many triangles in the same box; trimesh obeys the `up_axis` of Collada."""
    if sum(len(s.faces) for s in plain) != sum(len(s.faces) for s in found) or not found:
        return False
    corners = [np.concatenate([s.vertices[s.faces.ravel()] for s in each]) for each in (plain, found)]
    one, other = (np.concatenate([points.min(axis=0), points.max(axis=0)]) for points in corners)
    return bool(np.allclose(one, other, atol=_SLIGHT * np.ptp(one)))
