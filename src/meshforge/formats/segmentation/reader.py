"""Read segmented points and meshes of every kind: PLY files, arrays, and classes of an asset's own mesh, as
PartField and SAMPart3D leave them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.common import AssetError
from meshforge.formats.mesh_reader import read_content, read_triangles
from meshforge.formats.meshfile.ply import PlyRows, PlyText, parse_ply
from meshforge.formats.meshfile.surface import join_surfaces
from meshforge.formats.segmentation.base import (
    POINTS_SUFFIXES,
    Segmentation,
    check_segmentation,
    label_rank_of,
    to_whole_numbers,
)
from meshforge.formats.segmentation.class_names import parse_comments
from meshforge.geometry import Floats, Ints

_MESHES = (".obj", ".ply", ".stl", ".glb", ".gltf")
_REMEDY = (
    'Write the mesh with them: np.savez("NAME.points.npz", vertices=mesh.vertices, faces=mesh.faces, labels=classes)'
)


def read_segmentation(path: Path) -> Segmentation:
    """The points or faces in a `.ply`, `.npz` or `.npy` file, with the class of each.

    Raises AssetError naming the file: unreadable, of another kind, without classes, with wrong lengths, not finite.
    """
    match path.suffix.lower():
        case ".ply":
            return read_ply(path)
        case ".npz" | ".npy":
            from meshforge.formats.segmentation.arrays import read_arrays

            return read_arrays(path)
    remedy = f"It is one of {', '.join(POINTS_SUFFIXES)}."
    raise AssetError(
        f"{path.suffix or 'a file without suffix'} is no kind of segmented points", where=str(path), remedy=remedy
    )


def read_ply(path: Path) -> Segmentation:
    """The points or faces of a PLY file with their classes; those of faces count where both have some.

    Raises AssetError: damaged, or nothing in it is a class by its name.
    """
    where, data = str(path), read_content(path)
    text = parse_ply(data, where)
    names = parse_comments(data[: text.header.size].decode("utf-8", "replace").splitlines())
    own = [rows for kind in ("face", "vertex") for rows in text.rows if rows.element.name == kind]
    found = [(rows, key) for rows in own if (key := _find_property(rows))]
    if not found:
        raise _no_classes_error(text, where)
    rows, key = next((pair for pair in found if pair[0].element.rows), found[0])
    classes = to_whole_numbers(rows.values[key], where)
    if rows.element.name == "face":
        return check_segmentation(
            Segmentation(classes[text.face_at], text.vertices, text.faces, names, of_faces=True), where
        )
    return check_segmentation(Segmentation(classes, text.vertices, text.faces, names), where)


def _find_property(rows: PlyRows) -> str | None:
    """The property that is most plainly one of classes."""
    ranks = [
        (rank, p.name) for p in rows.element.properties if not p.count and (rank := label_rank_of(p.name)) is not None
    ]
    return min(ranks)[1] if ranks else None


def _no_classes_error(text: PlyText, where: str) -> AssetError:
    known = [p.name for rows in text.rows for p in rows.element.properties if not p.count and p.name not in "xyz"]
    holds = f"it has {', '.join(np.unique(known))}" if known else "it has none but coordinates"
    remedy = "Export the class of each point or face as a number, called `label`; colours are not read."
    return AssetError(f"no property of this file is a class by its name: {holds}", where=where, remedy=remedy)


def attach_own_mesh(found: Segmentation, asset: Path, where: str) -> Segmentation:
    """Classes with the mesh that they are of; where: their file.

    Raises AssetError: the asset is no single mesh, or has another number of faces, or polygons that tools cut up
    in their own order.
    """
    if asset.suffix.lower() not in _MESHES:
        problem = f"it has classes without points, and {asset.name} is no mesh file to which they could belong"
        raise AssetError(problem, where=where, remedy=_REMEDY)
    vertices, faces, polygon = _read_mesh(asset, where)
    count, polygons = len(found.classes), int(polygon[-1]) + 1 if len(polygon) else 0
    own = replace(found, vertices=vertices, faces=faces)
    if count == polygons and count != len(vertices):
        return replace(own, classes=found.classes[polygon], of_faces=True)
    if count == len(vertices) and count != polygons:
        return own
    problem = f"it has {count:,} classes, {asset.name} has {polygons:,} faces and {len(vertices):,} vertices"
    raise AssetError(problem, where=where, remedy=_REMEDY)


def _read_mesh(asset: Path, where: str) -> tuple[Floats, Ints, Ints]:
    """The vertices (n, 3) and triangles (m, 3) of a mesh file in its order, and the polygon (m,) of each triangle."""
    if asset.suffix.lower() == ".obj":
        from meshforge.formats.meshfile.obj import parse_obj

        text = parse_obj(read_content(asset), str(asset))
        return text.vertices, text.faces, np.unique(text.face_at, return_inverse=True)[1].reshape(-1)
    if asset.suffix.lower() == ".ply":
        from meshforge.formats.meshfile.ply import parse_ply

        rows = parse_ply(read_content(asset), str(asset))
        return rows.vertices, rows.faces, rows.face_at
    surfaces = read_triangles(asset)
    if len(surfaces) > 1:
        problem = f"it has classes without points, and {asset.name} has {len(surfaces)} meshes"
        raise AssetError(problem, where=where, remedy=_REMEDY)
    soup = join_surfaces(surfaces)
    return soup.vertices, soup.faces, np.arange(len(soup.faces))
