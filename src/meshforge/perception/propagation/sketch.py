"""What propagation keeps of a mesh: arrays, so that of a family of very many no mesh has to stay in memory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.perception.propagation.describe import SHAPES, WIDTH, Describer
from meshforge.perception.propagation.upright import other_sides, upright
from meshforge.symbolic import SymbolicMesh

_SIDES = 5  # on which a mesh may lie, besides the one it seems to lie on


@dataclass(frozen=True, eq=False, slots=True)
class Sketch:
    """A mesh as it is described.

    rows: (n, WIDTH), one a hull, with up what seems to be up; touching: pairs (m, 2) of hulls in contact, in order;
    sides: (k, n, columns), `SHAPES` of the rows if it lay on another side than it seems to.
    """

    rows: Floats
    touching: Ints
    sides: Floats


class Sketcher:
    """A mesh to be described, as it seems to stand and on other sides."""

    def __init__(self, mesh: SymbolicMesh) -> None:
        self._mesh = mesh
        if mesh.hulls:
            self._describer = Describer(mesh)
            self._up = upright(mesh)
            self._ups = other_sides(mesh, self._up, _SIDES)

    def describe(self) -> Sketch:
        """The mesh as it seems to stand, and what is quickly told of its other sides."""
        count, columns = len(self._mesh.hulls), SHAPES.stop - SHAPES.start
        if not count:
            return Sketch(np.zeros((0, WIDTH)), np.zeros((0, 2), np.int64), np.zeros((0, 0, columns)))
        touching = np.array(sorted(self._mesh.contacts), dtype=np.int64).reshape(-1, 2)
        sides = np.array([self._describer.describe_shapes(up) for up in self._ups]).reshape(-1, count, columns)
        return Sketch(self._describer.describe(self._up), touching, sides)

    def describe_side(self, side: int) -> Floats:
        """The rows (n, WIDTH) on one of the sides of the sketch."""
        return self._describer.describe(self._ups[side])
