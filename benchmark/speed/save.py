"""Writing mesh files: MeshForge against trimesh, the same triangles."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

from benchmark.clock import Run, in_turns, medians, once
from benchmark.report import Goal, Result, Table, Tell
from benchmark.speed.assets import multi_hull
from meshforge.common import AssetError
from meshforge.formats import save
from meshforge.formats.gltf.format import GltfFormat
from meshforge.formats.plain.obj import ObjFormat
from meshforge.formats.plain.parts import to_parts
from meshforge.formats.plain.stl import StlFormat
from meshforge.geometry import Pose
from meshforge.symbolic import Asset, Body, Document, Geom, SymbolicMesh

OURS, CHECKED, THEIRS = "MeshForge", "MeshForge, read back", "trimesh"
_SUFFIXES = (".obj", ".stl", ".glb")
_ROUNDS = 5


def measure(tell: Tell, quick: bool) -> Result:
    """Time both on meshes of several hulls."""
    found = multi_hull(tell, 2, bundled_only=True) if quick else multi_hull(tell)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for k, (name, mesh) in enumerate(found.items()):
            tell(f"save: {k + 1} of {len(found)}")
            rows += [one_file(name, mesh, suffix, Path(folder), 1 if quick else _ROUNDS) for suffix in _SUFFIXES]
    return _result(rows)


def one_file(name: str, mesh: SymbolicMesh, suffix: str, folder: Path, rounds: int) -> dict[str, Any]:
    """Median seconds of writing the hulls of a mesh into a file of a suffix, and the bytes of the files."""
    asset = _polytopes(mesh)
    ours = partial(_content, asset, suffix)
    turns: dict[str, Run] = {OURS: lambda: ours, THEIRS: lambda: _trimesh(asset, suffix)}
    checked = partial(save, asset, folder / f"saved{suffix}", overwrite=True)
    seconds = medians(in_turns(turns, rounds))
    with suppress(AssetError):  # an STL cannot tell hulls apart that share a corner
        seconds[CHECKED] = once(checked)
    size = {OURS: len(ours()), THEIRS: len(_trimesh(asset, suffix)())}
    return {"asset": name, "kind": suffix, "seconds": seconds, "bytes": size}


def _polytopes(mesh: SymbolicMesh) -> Asset:
    """The hulls of a mesh as an asset of no format."""
    geoms = tuple(Geom(hull.name, "body", hull.shape.tessellate()) for hull in mesh.hulls)
    return Asset(Path("memory"), "memory", (Body("body", Pose.identity()),), geoms, Document())


def _content(asset: Asset, suffix: str) -> bytes:
    """The bytes of a file of the hulls."""
    match suffix:
        case ".obj":
            return ObjFormat().format_parts(to_parts(asset.geoms)[0])
        case ".stl":
            return StlFormat().format_parts(to_parts(asset.geoms)[0])
        case _:
            return GltfFormat().create(asset, "saved.glb").main


def _trimesh(asset: Asset, suffix: str) -> Callable[[], str | bytes]:
    """trimesh's own objects of the hulls, and the writing of these."""
    import trimesh

    meshes = {g.name: trimesh.Trimesh(g.shape.vertices, g.shape.faces, process=False) for g in asset.geoms}
    if suffix == ".stl":
        return partial(trimesh.util.concatenate(list(meshes.values())).export, file_type="stl")
    scene = trimesh.Scene()
    for name, mesh in meshes.items():
        scene.add_geometry(mesh, node_name=name, geom_name=name)
    return partial(scene.export, file_type=suffix[1:])


def _result(rows: list[dict[str, Any]]) -> Result:
    kinds = {kind: [row for row in rows if row["kind"] == kind] for kind in _SUFFIXES}
    return Result(
        "save",
        "Writing mesh files",
        (
            Table(
                "Time of all files of a kind, ms",
                ("", "files", "MB", "MB of trimesh", OURS, THEIRS, "ratio", CHECKED, "refused"),
                tuple(_line(kind, found) for kind, found in kinds.items()),
            ),
        ),
        tuple(Goal(f"times trimesh's time, {kind}", "at most", 1.5, _ratio(found)) for kind, found in kinds.items()),
        (
            "Like work: from hulls in memory to the bytes of a file; OBJ and GLB with an object for each hull.",
            "MeshForge writes OBJ in full precision, so that a hull is bit for bit the same when read again; trimesh "
            "writes eight decimals. Making a GLB, MeshForge also reads its names back, within the time shown.",
            "*Read back*: what `save` does besides, to hand over no file that reads back as other hulls;",
            "*refused*: files that would, as an STL does of hulls that share a corner. They are not in its time.",
        ),
        tuple(rows),
    )


def _line(kind: str, rows: list[dict[str, Any]]) -> tuple[str | int | float, ...]:
    whos = (OURS, THEIRS, CHECKED)
    total = {who: 1e3 * math.fsum(row["seconds"].get(who, 0.0) for row in rows) for who in whos}
    refused = sum(CHECKED not in row["seconds"] for row in rows)
    size = {who: sum(row["bytes"][who] for row in rows) / 1e6 for who in (OURS, THEIRS)}
    return kind, len(rows), size[OURS], size[THEIRS], total[OURS], total[THEIRS], _ratio(rows), total[CHECKED], refused


def _ratio(rows: list[dict[str, Any]]) -> float:
    ours, theirs = (math.fsum(row["seconds"][who] for row in rows) for who in (OURS, THEIRS))
    return ours / theirs
