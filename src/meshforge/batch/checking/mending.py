"""Mended assets written as `apply` writes edited ones: below a folder of their own, as they lay below the given one."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from meshforge.errors import AssetError
from meshforge.files import plain_path
from meshforge.formats import labels_beside, placed, save
from meshforge.symbolic import SymbolicMesh, write_labels


def write_mended(mesh: SymbolicMesh, base: Path, out: Path, *, overwrite: bool = False) -> Path:
    """Write a mesh with its labels below `out`, in its own format; the main file.

    base: the folder whose tree the output mirrors. Every file is written whole or not at all, the main one last.
    Raises AssetError: `out` is the folder of the assets, a file of the input or another one with other content would
    be written over (this one unless `overwrite`), or the format cannot hold the mesh.
    """
    if mesh.asset is None or plain_path(out) == plain_path(base):
        raise AssetError(
            "the output folder is the folder of the assets", where=str(out), remedy="Choose another --out."
        )
    saved = save(mesh, placed(mesh.asset, base, plain_path(out)), overwrite=overwrite)
    if mesh.labels:
        renamed = mesh.with_hulls(replace(hull, name=saved.names.get(hull.name, hull.name)) for hull in mesh.hulls)
        write_labels(labels_beside(saved.path), renamed, ())
    return saved.path
