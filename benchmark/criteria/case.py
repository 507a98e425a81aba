"""What a criterion is tried on."""

from __future__ import annotations

from dataclasses import dataclass

from benchmark.assets.asset import Asset
from meshforge.symbolic import SymbolicMesh


@dataclass(frozen=True, eq=False)
class Case:
    """An edited mesh in the frame in which its asset stands (z up), with true labels; before: the unedited one."""

    mesh: SymbolicMesh
    asset: Asset
    before: SymbolicMesh
