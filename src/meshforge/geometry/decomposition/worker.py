"""The process that runs engines: reads triangles, writes pieces, and may crash without harm to anyone else.

Run by path, so that it loads nothing but numpy and the engine. Arguments: a folder with meshes and their settings, and
the number of the first one to decompose.
"""

from __future__ import annotations

import ctypes
import json
import signal
import sys
from pathlib import Path
from typing import Any

import numpy as np

JOBS, MESH, PIECES = "jobs.json", "mesh-{}.npz", "pieces-{}.npz"
"""The files of the folder: the settings of all meshes, and by number each mesh and what was made of it."""


def main(folder: str, first: str) -> None:
    """Decompose the meshes of a folder from a number on; the pieces of each are written whole or not at all."""
    _die_with_parent()
    jobs: list[dict[str, Any]] = json.loads(Path(folder, JOBS).read_text())
    for number in range(int(first), len(jobs)):
        mesh = np.load(Path(folder, MESH.format(number)), allow_pickle=False)
        settings = jobs[number]
        engine = {"coacd": _run_coacd, "vhacd": _run_vhacd}[settings.pop("engine")]
        pieces = [(np.asarray(v, float), np.asarray(f)) for v, f in engine(mesh["vertices"], mesh["faces"], settings)]
        partial = Path(folder, "partial.npz")
        np.savez(
            partial,
            vertices=np.concatenate([v for v, _ in pieces] or [np.zeros((0, 3))]),
            faces=np.concatenate([f for _, f in pieces] or [np.zeros((0, 3))]),
            counts=np.array([[len(v), len(f)] for v, f in pieces], dtype=np.int64).reshape(-1, 2),
        )
        partial.replace(Path(folder, PIECES.format(number)))


def _run_coacd(vertices: Any, faces: Any, settings: dict[str, Any]) -> Any:
    import coacd  # lazy: this process runs one of two engines

    coacd.set_log_level("info")  # its lines are the only sign of progress
    return coacd.run_coacd(coacd.Mesh(vertices, faces.astype(np.int32)), **settings)


def _run_vhacd(vertices: Any, faces: Any, settings: dict[str, Any]) -> Any:
    import vhacdx  # lazy: this process runs one of two engines

    a, b, c = (vertices[faces[:, k]] - vertices.mean(axis=0) for k in range(3))
    outward = np.einsum("ij,ij->", a, np.cross(b, c)) > 0
    if outward:  # its ray casting takes triangles that face inward for a filled inside, and others for a shell
        faces = faces[:, ::-1]
    return vhacdx.compute_vhacd(
        vertices,
        np.column_stack([np.full(len(faces), 3), faces]).astype(np.uint32).ravel(),  # each with its corner count
        maxConvexHulls=settings["max_convex_hulls"],
        resolution=settings["resolution"],
        minimumVolumePercentErrorAllowed=settings["volume_error"],
        maxRecursionDepth=settings["max_recursion_depth"],
        shrinkWrap=settings["shrink_wrap"],
        fillMode=settings["fill_mode"],
        maxNumVerticesPerCH=settings["max_hull_vertices"],
        minEdgeLength=settings["min_edge_length"],
        findBestPlane=settings["find_best_plane"],
    )


def _die_with_parent() -> None:
    """Let the system end this process with the one that started it, which may be killed itself (a pool that stops)."""
    if sys.platform == "linux":
        pr_set_pdeathsig = 1  # from linux/prctl.h
        ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGKILL)


if __name__ == "__main__":
    main(*sys.argv[1:])
