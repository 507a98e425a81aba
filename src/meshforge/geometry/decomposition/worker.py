"""The process that runs an engine: reads triangles, writes pieces, and may crash without harm to anyone else.

Run by path, so that it loads nothing but numpy and the engine. Arguments: input .npz, output .npz, settings as
JSON.
"""

from __future__ import annotations

import ctypes
import json
import signal
import sys
from typing import Any

import numpy as np


def main(source: str, target: str, job: str) -> None:
    """Decompose the triangles in `source` and write the pieces to `target`."""
    _die_with_parent()
    mesh = np.load(source, allow_pickle=False)
    settings: dict[str, Any] = json.loads(job)
    engine = {"coacd": _run_coacd, "vhacd": _run_vhacd}[settings.pop("engine")]
    pieces = [(np.asarray(v, float), np.asarray(f)) for v, f in engine(mesh["vertices"], mesh["faces"], settings)]
    np.savez(
        target,
        vertices=np.concatenate([v for v, _ in pieces] or [np.zeros((0, 3))]),
        faces=np.concatenate([f for _, f in pieces] or [np.zeros((0, 3), np.int64)]),
        counts=np.array([[len(v), len(f)] for v, f in pieces], dtype=np.int64).reshape(-1, 2),
    )


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
