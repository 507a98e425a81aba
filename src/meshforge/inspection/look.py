"""Looking at an asset: a picture of its hulls; and whether these are legal, within an engine's limits, fit, leave free
what is free, and rest."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.formats import Source, path_of, to_mesh
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image

    from meshforge.checks import Examination
    from meshforge.rendering import ColorBy, View


def render(
    asset: SymbolicMesh | Source,
    out: str | Path | None = None,
    *,
    views: View | Sequence[View] = "iso",
    color_by: ColorBy | None = None,
    size: tuple[int, int] = (900, 700),
    highlight: Collection[str] | None = None,
    ghost: bool = False,
    names: bool = False,
) -> Image:
    """Draw an asset, one colour a hull or a label; the same input gives the same picture. It needs no display.

    asset: a mesh, or what `load` reads. out: a PNG or JPEG to write. views: one, or several that share the picture:
    `iso`, `front`, `left`, `top`, `front-right-above` and so on. color_by: `hull`, `label` or `body`, by default
    the label where there are labels, else the hull. size: width and height [px]. highlight: names of hulls to
    show in a strong colour. ghost: show the visual mesh, too. names: write the names of hulls on them, or numbers with
    a list of names below.
    Raises AssetError for a file that cannot be read, UsageError for an unknown view or colouring, an impossible size,
    or a picture that cannot be written.
    """
    from meshforge import rendering  # lazy: 40 modules that checks and differences do not need

    if out is not None:
        rendering.check_picture_path(Path(out))
    mesh = to_mesh(asset)
    image = rendering.render(
        mesh,
        views=(views,) if isinstance(views, str) else views,
        color_by=color_by or ("label" if mesh.labels else "hull"),
        size=size,
        highlight=None if highlight is None else frozenset(highlight),
        ghost=tuple(mesh.asset.visuals) if ghost and mesh.asset else None,
        names=names,
    )
    if out is not None:
        rendering.write_picture(Path(out), image)
    return image


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
    """Return what is wrong with an asset, as `.findings`, and what was measured; print it to read it.

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
