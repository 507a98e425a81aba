"""Blender as a module: its importers of mesh files, glTF and USD; the loose parts of every object."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from tests.loads.readers.base import Place, Reader, Seen, hull

_USD = (".usda", ".usdc", ".usdz")


def _shapes(path: Path) -> Iterator[Seen]:
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    with contextlib.redirect_stdout(io.StringIO()):
        _import(path)
        split = () if path.suffix in _USD else [thing for thing in bpy.data.objects if thing.type == "MESH"]
        for thing in split:
            bpy.context.view_layer.objects.active = thing
            thing.select_set(True)
            bpy.ops.mesh.separate(type="LOOSE")
            thing.select_set(False)
    turn = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]]) if path.suffix in (".glb", ".gltf") else np.eye(3)
    for thing in bpy.data.objects:
        if thing.type == "MESH":
            points = np.array([vertex.co for vertex in thing.data.vertices])
            yield hull(points, Place(turn, np.zeros(3)) @ Place.of_matrix(thing.matrix_world))


def _import(path: Path) -> None:
    import bpy

    name = str(path)
    match path.suffix:
        case ".obj":
            bpy.ops.wm.obj_import(filepath=name, forward_axis="Y", up_axis="Z")
        case ".stl":
            bpy.ops.wm.stl_import(filepath=name)
        case ".ply":
            bpy.ops.wm.ply_import(filepath=name)
        case ".glb" | ".gltf":
            bpy.ops.import_scene.gltf(filepath=name)
        case _:
            bpy.ops.wm.usd_import(filepath=name, import_guide=True)


READER = Reader(
    "Blender",
    "bpy",
    "bpy",
    {**dict.fromkeys((".obj", ".ply", ".glb", ".gltf", *_USD), "shape"), ".stl": "file"},
    _shapes,
    rounds=0.06,
    besides=_USD,
    about="It turns glTF, which is y-up, to z-up; here it is turned back. From USD it reads visual meshes, too.",
    limits={(usd, "legs"): "it scales a sphere unevenly, where USD's own physics has a ball" for usd in _USD},
)
