"""trimesh: mesh files and glTF; the connected pieces of every mesh."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from tests.loads.readers.base import Place, Reader, Seen, hull


def _shapes(path: Path) -> Iterator[Seen]:
    import trimesh

    scene = trimesh.load_scene(path, process=False)
    for node in scene.graph.nodes_geometry:
        matrix, name = scene.graph[node]
        for piece in scene.geometry[name].split(only_watertight=False):
            yield hull(piece.vertices, Place.of_matrix(matrix))


READER = Reader(
    "trimesh",
    "trimesh[easy]",
    "trimesh",
    {**dict.fromkeys((".obj", ".ply", ".glb", ".gltf"), "shape"), ".stl": "file"},
    _shapes,
    rounds=0.06,
)
