"""Looking at an asset: a picture of its hulls; whether these are legal, within an engine's limits, fit, leave free what
is free, and rest; and what an edit changed, hull by hull."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from meshforge.formats import Source, path_of, to_mesh
from meshforge.symbolic import SymbolicMesh, find_unchanged

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


@dataclass(frozen=True, eq=False, slots=True)
class Difference:
    """Two meshes compared by the names of their hulls; print it to read it.

    removed, made, changed, kept: names of hulls, in the order of the mesh before; made ones in that of the mesh after.
    """

    before: SymbolicMesh
    after: SymbolicMesh
    removed: tuple[str, ...]
    made: tuple[str, ...]
    changed: tuple[str, ...]
    kept: tuple[str, ...]

    @property
    def is_empty(self) -> bool:
        """Whether all hulls are as they were."""
        return not (self.removed or self.made or self.changed)

    def to_json(self) -> dict[str, Any]:
        """Return the names, and counts of hulls and vertices and volumes [m^3] of both, as JSON-able data."""
        return {
            "removed": list(self.removed),
            "made": list(self.made),
            "changed": list(self.changed),
            "kept": list(self.kept),
            "hulls": {"before": len(self.before.hulls), "after": len(self.after.hulls)},
            "vertices": {"before": _count_vertices(self.before), "after": _count_vertices(self.after)},
            "volume": {"before": _sum_volumes(self.before), "after": _sum_volumes(self.after)},
        }

    def __str__(self) -> str:
        """A line for each count, and each hull that is not as it was."""
        data = self.to_json()
        lines = [f"{what:9} {data[what]['before']:.6g} -> {data[what]['after']:.6g}" for what in _COUNTS]
        lines[-1] += " m^3, overlaps counted twice"
        signs = (("-", self.removed), ("+", self.made), ("~", self.changed))
        lines += [f"{sign} {name}" for sign, names in signs for name in names]
        return "\n".join([*lines, f"  {len(self.kept)} kept as they were"])


_COUNTS = ("hulls", "vertices", "volume")


def diff(before: SymbolicMesh | Source, after: SymbolicMesh | Source, out: str | Path | None = None) -> Difference:
    """Compare two assets hull by hull: which hulls were removed, made and changed.

    before, after: meshes, or what `load` reads. out: a PNG or JPEG to write: before beside after, what changed marked.
    Raises AssetError for a file that cannot be read, UsageError for a picture that cannot be written.
    """
    if out is None:
        return compare_meshes(to_mesh(before), to_mesh(after))
    from meshforge.rendering import check_picture_path, draw_changes, write_picture  # lazy: 40 modules of a picture

    check_picture_path(Path(out))
    found = compare_meshes(to_mesh(before), to_mesh(after))
    write_picture(Path(out), draw_changes(found.before, found.after))
    return found


def compare_meshes(before: SymbolicMesh, after: SymbolicMesh) -> Difference:
    """Return the difference of two meshes; shapes count as one within a millionth of the larger diagonal."""
    both, kept = [name for name in before.index if name in after.index], find_unchanged(before, after)
    return Difference(
        before,
        after,
        removed=tuple(name for name in before.index if name not in after.index),
        made=tuple(name for name in after.index if name not in before.index),
        changed=tuple(name for name in both if name not in kept),
        kept=tuple(name for name in both if name in kept),
    )


def _count_vertices(mesh: SymbolicMesh) -> int:
    return sum(len(hull.vertices) for hull in mesh.hulls)


def _sum_volumes(mesh: SymbolicMesh) -> float:
    return sum(hull.volume for hull in mesh.hulls)
