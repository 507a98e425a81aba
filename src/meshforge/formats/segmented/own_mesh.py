"""Classes without points: those of the faces or vertices of an asset's own mesh file, as PartField and SAMPart3D leave
them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.meshfile import joined
from meshforge.formats.segmented.segmented import Segmented
from meshforge.formats.triangles import contents, read_triangles
from meshforge.geometry import Floats, Ints

_MESHES = (".obj", ".ply", ".stl", ".glb", ".gltf")
_REMEDY = (
    'Write the mesh with them: np.savez("NAME.points.npz", vertices=mesh.vertices, faces=mesh.faces, labels=classes)'
)


def of_own_mesh(found: Segmented, asset: Path, where: str) -> Segmented:
    """Classes with the mesh that they are of; where: their file.

    Raises AssetError: the asset is no single mesh, or has another number of faces, or polygons that tools cut up
    in their own order.
    """
    if asset.suffix.lower() not in _MESHES:
        problem = f"it has classes without points, and {asset.name} is no mesh file to which they could belong"
        raise AssetError(problem, where=where, remedy=_REMEDY)
    vertices, faces, polygon = _mesh(asset, where)
    count, polygons = len(found.classes), int(polygon[-1]) + 1 if len(polygon) else 0
    own = replace(found, vertices=vertices, faces=faces)
    if count == polygons and count != len(vertices):
        return replace(own, classes=found.classes[polygon], of_faces=True)
    if count == len(vertices) and count != polygons:
        return own
    problem = f"it has {count:,} classes, {asset.name} has {polygons:,} faces and {len(vertices):,} vertices"
    raise AssetError(problem, where=where, remedy=_REMEDY)


def _mesh(asset: Path, where: str) -> tuple[Floats, Ints, Ints]:
    """The vertices (n, 3) and triangles (m, 3) of a mesh file in its order, and the polygon (m,) of each triangle."""
    if asset.suffix.lower() == ".obj":
        from meshforge.formats.meshfile.obj import parse_obj

        text = parse_obj(contents(asset), str(asset))
        return text.vertices, text.faces, np.unique(text.face_at, return_inverse=True)[1].reshape(-1)
    if asset.suffix.lower() == ".ply":
        from meshforge.formats.meshfile.ply import parse_ply

        rows = parse_ply(contents(asset), str(asset))
        return rows.vertices, rows.faces, rows.face_at
    surfaces = read_triangles(asset)
    if len(surfaces) > 1:
        problem = f"it has classes without points, and {asset.name} has {len(surfaces)} meshes"
        raise AssetError(problem, where=where, remedy=_REMEDY)
    soup = joined(surfaces)
    return soup.vertices, soup.faces, np.arange(len(soup.faces))
