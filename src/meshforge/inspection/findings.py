"""Whether the hulls of an asset are legal, within an engine's limits, fit, leave free what is free, and rest."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from meshforge.formats import Source, path_of, to_mesh

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
    checks: Iterable[str] = (),
    against: SymbolicMesh | Source | None = None,
    cell: float | None = None,
) -> Examination:
    """What is wrong with an asset, as `.findings`, and what was measured; print it to read it.

    asset: a mesh, or what `load` reads. engine: also check the limits of `mujoco`, `physx-cpu`, `physx-gpu`, `unreal`,
    `unity`, `bullet` or `godot`, and ask MuJoCo, or Bullet about a URDF file, itself. fit: how far hulls stick out of
    the visual mesh, and what of it lies bare [m]; clearance: what hulls close and open of the space that can be
    reached [l]; physics: rest the asset on a plane in MuJoCo; checks: others by name, such as those of plug-ins;
    against: the asset before an edit, for clearance and physics; cell: side of the cells of fit and clearance [m], by
    default a 112th of the diagonal.
    Raises AssetError for a file that cannot be read, UsageError for an engine that is not known.
    """
    from meshforge.batch import examine_file  # lazy: 200 modules that a difference does not need
    from meshforge.checks import CheckOptions  # lazy: 60 modules that a difference does not need

    mesh = to_mesh(asset)
    chosen = {engine: engine is not None, "fit": fit, "clearance": clearance, "physics": physics}
    wanted = CheckOptions.of([*(name for name, is_on in chosen.items() if name and is_on), *checks], cell)
    found = examine_file(path_of(asset), mesh, wanted, None if against is None else to_mesh(against))
    return found.add_notes(mesh.asset.notes if mesh.asset else ())
