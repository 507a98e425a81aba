"""The process that runs engines: reads triangles, writes pieces, and may crash without harm to anyone else.

Run by path, so that it loads nothing but numpy and the engine. Arguments: a folder with meshes and their settings, and
the number of the first one to decompose.
"""

import ctypes
import io
import json
import signal
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

JOBS, MESH, PIECES = "jobs.json", "mesh-{}.npz", "pieces-{}.npz"
"""The files of the folder: the settings of all meshes, and by number each mesh and what was made of it."""


def pack_pieces(pieces: Iterable[tuple[Any, Any]], **more: Any) -> bytes:
    """Return pieces, each vertices (n, 3) and faces (m, 3), and more arrays by name, as the content of an `.npz`."""
    rows = [(np.asarray(v, np.float64), np.asarray(f, np.int64)) for v, f in pieces]
    buffer = io.BytesIO()
    np.savez_compressed(
        buffer,
        vertices=np.concatenate([v for v, _ in rows] or [np.zeros((0, 3))]),
        faces=np.concatenate([f for _, f in rows] or [np.zeros((0, 3), np.int64)]),
        counts=np.array([[len(v), len(f)] for v, f in rows], dtype=np.int64).reshape(-1, 2),
        **more,
    )
    return buffer.getvalue()


def main(folder: str, first: str) -> None:
    """Decompose the meshes of a folder from a number on; the pieces of each are written whole or not at all."""
    _die_with_parent()
    jobs: list[dict[str, Any]] = json.loads(Path(folder, JOBS).read_text())
    for number in range(int(first), len(jobs)):
        mesh = np.load(Path(folder, MESH.format(number)), allow_pickle=False)
        settings = jobs[number]
        engine = {"coacd": _run_coacd, "vhacd": _run_vhacd}[settings.pop("engine")]
        partial = Path(folder, "partial.npz")
        partial.write_bytes(pack_pieces(engine(mesh["vertices"], mesh["faces"], settings)))
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
