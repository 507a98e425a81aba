"""The parts of what is read from a mesh file: its groups, objects and nodes, each by its materials; and what hulls of a
part are called."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from meshforge.formats.meshfile.surface import RawSurface
from meshforge.geometry import Ints, SurfaceParts

_ODD = re.compile(r"[^A-Za-z0-9_]+")
_MATERIALS = tuple[Ints, tuple[str, ...]]


def parts_of_surfaces(surfaces: Sequence[RawSurface], name: str = "") -> SurfaceParts:
    """Return the parts of surfaces one after the other; name: what one is called that has no name."""
    group = np.repeat(np.arange(len(surfaces)), [len(surface.faces) for surface in surfaces])
    own_materials = [surface.materials or (np.zeros(len(surface.faces), dtype=np.int64), ("",)) for surface in surfaces]
    known = tuple(dict.fromkeys(name for _, names in own_materials for name in names))
    owners = [np.array([known.index(name) for name in names])[owner] for owner, names in own_materials]
    materials = (np.concatenate(owners), known) if owners else None
    return parts_of_groups(group, [surface.name or name for surface in surfaces], materials)


def parts_of_groups(group: Ints, names: Sequence[str | None], materials: _MATERIALS | None = None) -> SurfaceParts:
    """Return the parts of triangles of some groups (m,); each group with several materials is a part a material.

    group: negative for triangles that are only seen; names: of the groups. A part is called by its group, or by its
    material where it has no other name, or there are several in the group.
    """
    owner, known = materials or (np.zeros(len(group), dtype=np.int64), ("",))
    keys, of_face = np.unique(group * len(known) + owner, return_inverse=True)
    pairs = np.column_stack(np.divmod(keys, len(known)))
    several = {int(k) for k, count in zip(*np.unique(pairs[:, 0], return_counts=True), strict=True) if count > 1}
    called: list[str] = []
    for k, material in pairs.tolist():
        own = (names[k] if 0 <= k < len(names) else None) or ""
        words = [own, known[material] if k in several or not own else ""]
        called.append("_".join(filter(None, words)) or f"part_{len(called)}")
    return SurfaceParts(of_face.reshape(-1), tuple(called))


def plain_part_name(name: str) -> str:
    """Return the name of a part as names of hulls begin in every format: letters, digits and underscores, no digit
    first."""
    plain = _ODD.sub("_", name.strip()).strip("_")
    return plain if plain and not plain[0].isdigit() else f"part_{plain}".rstrip("_")
