"""Hulls of one mesh that look alike, as the studio's key `J` selects them."""

from __future__ import annotations

import numpy as np

from meshforge.label_model import FamilyTable, MeshDescriber, find_similar
from meshforge.symbolic import SymbolicMesh


class LookAlikes:
    """Of a mesh that is described once."""

    def __init__(self, mesh: SymbolicMesh) -> None:
        self._places = {hull.name: place for place, hull in enumerate(mesh.hulls)}
        self._names = tuple(self._places)
        self._table = FamilyTable.of([(MeshDescriber(mesh).describe().rows, np.zeros((0, 2), np.int64))])
        self._free = np.zeros(len(self._names), np.bool_)

    def find(self, hull: str) -> frozenset[str]:
        """What one press of the key selects with a hull, this included; of a hull that an edit made, itself."""
        if hull not in self._places:
            return frozenset({hull})
        found, _ = find_similar(self._table, np.array([self._places[hull]]), self._free, None, 0)
        return frozenset(self._names[place] for place in found.tolist())
