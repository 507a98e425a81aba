"""Whether the hulls of an asset are legal, within an engine's limits, fit, leave free what is free, and rest."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.formats import Source, to_mesh

if TYPE_CHECKING:
    from meshforge.checks import Examination
    from meshforge.symbolic import SymbolicMesh


def check(
    asset: SymbolicMesh | Source,
    engine: str | None = None,
    *,
    fit: bool = False,
    clearance: bool = False,
    physics: bool = False,
    against: SymbolicMesh | Source | None = None,
    cell: float | None = None,
) -> Examination:
    """What is wrong with an asset, as `.findings`, and what was measured; print it to read it.

    asset: a mesh, or what `load` reads. engine: also check the limits of `mujoco`, `physx-cpu`, `physx-gpu`, `unreal`,
    `unity`, `bullet` or `godot`. fit: how far hulls stick out of the visual mesh, and what of it lies bare [m];
    clearance: what hulls close and open of the space that can be reached [l]; physics: rest the asset on a plane in
    MuJoCo; against: the asset before an edit, for clearance and physics; cell: side of the cells of fit and clearance
    [m], by default a 112th of the diagonal.
    Raises AssetError for a file that cannot be read, UsageError for an engine that is not known.
    """
    from meshforge.checks import CheckOptions, examine_mesh  # lazy: 60 modules that a difference does not need

    wanted = CheckOptions(engine, fit, clearance, physics, cell)
    return examine_mesh(to_mesh(asset), wanted, None if against is None else to_mesh(against))
