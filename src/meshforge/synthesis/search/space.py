"""The hulls of several meshes side by side, so that a selection on all of them is one integer."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import accumulate

from meshforge.symbolic import SymbolicMesh


class Space:
    """Places the bit sets of several meshes one after the other, the first mesh lowest."""

    __slots__ = ("_starts", "everything", "meshes")

    def __init__(self, meshes: Sequence[SymbolicMesh]) -> None:
        self.meshes = tuple(meshes)
        self._starts = tuple(accumulate((len(mesh.hulls) for mesh in meshes), initial=0))
        self.everything = (1 << self._starts[-1]) - 1

    def join(self, masks: Iterable[int]) -> int:
        """One bit set of what is selected on each mesh."""
        whole = 0
        for mask, start in zip(masks, self._starts[:-1], strict=True):
            whole |= mask << start
        return whole

    def split(self, whole: int) -> tuple[int, ...]:
        """The bit set of each mesh."""
        return tuple(
            whole >> start & ((1 << len(mesh.hulls)) - 1)
            for mesh, start in zip(self.meshes, self._starts[:-1], strict=True)
        )
