"""What the demonstrations say about one rule."""

from __future__ import annotations

from dataclasses import dataclass

from meshforge.symbolic import SymbolicMesh


@dataclass(frozen=True, eq=False, slots=True)
class Example:
    """One mesh as the rule meets it, and the hulls that the rule is to select there, as a bit set.

    name: how messages call the mesh.
    """

    name: str
    mesh: SymbolicMesh
    selection: int
