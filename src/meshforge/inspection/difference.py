"""What an edit changed, hull by hull."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from meshforge.formats import Source, to_mesh
from meshforge.symbolic import SymbolicMesh, find_unchanged


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
