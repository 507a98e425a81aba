"""Pictures of the meshes of a category, upright, coloured by label."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from benchmark.assets.storage import Sample
from meshforge.geometry import Pose
from meshforge.rendering import make_contact_sheet, render, write_png
from meshforge.symbolic import SymbolicMesh


def move(mesh: SymbolicMesh, pose: Pose) -> SymbolicMesh:
    """The mesh moved rigidly."""
    return mesh.with_hulls(hull.move(pose) for hull in mesh.hulls)


def upright(sample: Sample, mesh: SymbolicMesh | None = None) -> SymbolicMesh:
    """A mesh of the sample's file, by default its own, in the frame in which the asset stands."""
    return move(mesh or sample.mesh, sample.asset.pose.inverse())


def look(rows: Sequence[Sample], path: Path, side: int = 260, columns: int = 6) -> None:
    """Write a sheet with a picture of each."""
    path.parent.mkdir(parents=True, exist_ok=True)
    vocabulary = sorted({hull.label or "" for row in rows for hull in row.mesh.hulls})
    images = [
        render(upright(row), color_by="label", size=(side, side), legend=False, vocabulary=vocabulary) for row in rows
    ]
    write_png(path, make_contact_sheet(images, columns, [f"{row.name} {row.asset.kind}" for row in rows]))
