"""An asset with its labels into another file: in another format, or unedited in its own."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from meshforge.formats.base import Collision
from meshforge.formats.engine_names.conventions import MarkName
from meshforge.formats.mjcf.format import build_spec
from meshforge.formats.output_tree import SaveResult, make_output, save
from meshforge.formats.registry import Source, labels_beside, read, to_mesh
from meshforge.symbolic import SymbolicMesh, write_labels


def convert(
    asset: SymbolicMesh | Source,
    out: str | Path,
    *,
    link: bool = False,
    overwrite: bool = False,
    names: MarkName | None = None,
    collision: Collision | None = None,
    urdf_capsules: bool = False,
) -> SaveResult:
    """Write an asset in the format that the suffix of `out` names, or unchanged in its own; its labels beside it.

    asset: a mesh, or what `load` reads. link: files that are only copied become hard links; overwrite: existing files
    may be replaced. names: how the file marks collision; collision: where the hulls of a scene go in which nothing is
    marked; urdf_capsules: whether a URDF gets `<capsule>`: all as `save` has them.
    The result says what the format cannot hold, in `.notes` and `.report`. Labels keep the names that hulls have there.
    Raises AssetError and UsageError as `load` and `save` do.
    """
    mesh = to_mesh(asset)
    saved = save(
        mesh, out, link=link, overwrite=overwrite, names=names, collision=collision, urdf_capsules=urdf_capsules
    )
    return _write_labels(mesh, saved, overwrite) if mesh.labels else saved


def to_mjspec(mesh: SymbolicMesh) -> Any:
    """The mesh as a `mujoco.MjSpec`; see `SymbolicMesh.to_mjspec`."""
    return build_spec(make_output(mesh, "mjcf", "model.xml"))


def _write_labels(mesh: SymbolicMesh, saved: SaveResult, overwrite: bool) -> SaveResult:
    path = labels_beside(saved.path)
    if path.exists() and not overwrite:
        note = f"{path} is there already and was left as it is"
        report = replace(saved.report, remarks=(*saved.report.remarks, note))
        return replace(saved, notes=(*saved.notes, note), report=report)
    write_labels(path, mesh.as_written(saved.names, read(saved.path)), ())
    return saved
