"""What a criterion is tried on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from benchmark.assets.asset import Asset
from benchmark.assets.decomposition import bounds
from meshforge.checks.physics.scene import TOLERANCE
from meshforge.symbolic import SymbolicMesh


@dataclass(frozen=True, eq=False)
class Case:
    """An edited mesh in the frame in which its asset stands (z up), with true labels; before: the unedited one."""

    mesh: SymbolicMesh
    asset: Asset
    before: SymbolicMesh

    @property
    def touching(self) -> float:
        """How deep two things may be in each other without counting as such [m]."""
        low, high = bounds(self.asset.parts)
        return TOLERANCE * float(np.linalg.norm(high - low))
