"""The hulls of one mesh, or of several side by side, as arrays: what extractors are evaluated on."""

from collections.abc import Callable, Hashable, Sequence
from functools import cached_property
from typing import Self, TypeVar

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats, Ints
from meshforge.symbolic import Hull, SymbolicMesh

Bools = npt.NDArray[np.bool_]
Value = TypeVar("Value")

EXTREMITY = 0.05
"""delta: how near the boundary counts as extreme, as a share of the base selection's diagonal (paper)."""


class HullTable:
    """The hulls of some meshes in a row. A mesh may come several times, under other labels.

    labels: of each hull, where they are not those of the meshes; extremity: delta of the program.
    """

    def __init__(
        self, meshes: Sequence[SymbolicMesh], labels: Sequence[str | None] | None = None, extremity: float = EXTREMITY
    ) -> None:
        self.meshes, self.extremity, self._labels = tuple(meshes), extremity, labels
        self._known: dict[Hashable, object] = {}

    def __len__(self) -> int:
        return int(self.starts[-1])

    @cached_property
    def starts(self) -> Ints:
        """Where the hulls of each mesh begin, and the end of the last."""
        return np.cumsum([0, *(len(mesh.hulls) for mesh in self.meshes)], dtype=np.int64)

    @cached_property
    def owner(self) -> Ints:
        """The place of the mesh that each hull is of."""
        return np.repeat(np.arange(len(self.meshes)), np.diff(self.starts))

    @cached_property
    def hulls(self) -> tuple[Hull, ...]:
        return tuple(hull for mesh in self.meshes for hull in mesh.hulls)

    @cached_property
    def low(self) -> Floats:
        """The lowest corner of the box of each hull (hulls, 3) [m]."""
        return np.concatenate([np.zeros((0, 3)), *(mesh.corners[0] for mesh in self.meshes)])

    @cached_property
    def high(self) -> Floats:
        """The highest corner of the box of each hull (hulls, 3) [m]."""
        return np.concatenate([np.zeros((0, 3)), *(mesh.corners[1] for mesh in self.meshes)])

    @cached_property
    def lengths(self) -> Floats:
        """L of each mesh, the length [m] that relative thresholds refer to."""
        return np.array([reference_length(mesh) for mesh in self.meshes])

    @cached_property
    def contacts(self) -> Ints:
        """The pairs of hulls in contact (pairs, 2)."""
        known = {id(mesh): np.array(list(mesh.contacts), dtype=np.int64).reshape(-1, 2) for mesh in self.meshes}
        pairs = [known[id(mesh)] + start for mesh, start in zip(self.meshes, self.starts, strict=False)]
        return np.concatenate([np.zeros((0, 2), dtype=np.int64), *pairs])

    @cached_property
    def _places(self) -> dict[str | None, list[int]]:
        labels = [hull.label for hull in self.hulls] if self._labels is None else self._labels
        places: dict[str | None, list[int]] = {}
        for place, label in enumerate(labels):
            places.setdefault(label, []).append(place)
        return places

    def with_label(self, label: str) -> Bools:
        """Return the hulls with a label."""
        found = np.zeros(len(self), dtype=np.bool_)
        found[self._places.get(label, [])] = True
        return found

    def split(self) -> tuple[Self, ...]:
        """Return the same for each mesh by itself."""
        return self.recall("meshes", self._split)

    def _split(self) -> tuple[Self, ...]:
        parts = []
        for mesh, start, end in zip(self.meshes, self.starts, self.starts[1:], strict=False):
            labels = None if self._labels is None else self._labels[start:end]
            parts.append(type(self)([mesh], labels, self.extremity))
        return tuple(parts)

    def recall(self, key: Hashable, make: Callable[[], Value]) -> Value:
        """Return what `make` gave for this key when it was first asked for."""
        if key not in self._known:
            self._known[key] = make()
        found: Value = self._known[key]  # type: ignore[assignment]  # of this key
        return found


def reference_length(mesh: SymbolicMesh) -> float:
    """Return l, the length [m] that relative thresholds refer to: fixed in a run, else the diagonal."""
    return mesh.diagonal if mesh.scale is None else mesh.scale
