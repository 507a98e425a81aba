"""Where the landmarks of many meshes lie, and which pairs of them give a direction that can be relied on."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats
from meshforge.language import All, Base, Is, LandmarkPair, Orient
from meshforge.symbolic import SymbolicMesh

APART = 0.02
"""Landmarks nearer than this share of the diagonal are not paired: how the hulls were cut may move them as far."""

Bools = npt.NDArray[np.bool_]


class Landmarks:
    """The centres of all landmarks of some meshes, in the frames in which they came.

    bases: the labels in their order, then `All`.
    """

    def __init__(self, meshes: Sequence[SymbolicMesh], vocabulary: Sequence[str]) -> None:
        self.bases: tuple[Base, ...] = (*map(Is, vocabulary), All())
        centres = [_centres(mesh, vocabulary) for mesh in meshes]
        self._centres = np.array(centres).reshape(len(meshes), len(self.bases), 3)
        self._least = APART * np.array([mesh.diagonal for mesh in meshes])

    def place(self, base: Base) -> int:
        """The position of a base in their order."""
        return self.bases.index(base)

    def directions(self, start: Base, end: Base) -> Floats:
        """From the centre of one landmark to that of another on each mesh (n, 3) [m]; NaN where one is missing."""
        gap: Floats = self._centres[:, self.place(end)] - self._centres[:, self.place(start)]
        return gap

    def apart(self, start: Base, end: Base) -> Bools:
        """On which meshes both landmarks are present, and apart (n,)."""
        far: Bools = np.linalg.norm(self.directions(start, end), axis=1) >= self._least
        return far

    def holds(self, orient: Orient) -> Bools:
        """On which meshes the landmarks of a directive are apart, those of a second pair across the first (n,)."""
        first = orient.pairs[0]
        held = self.apart(first.start, first.end)
        for second in orient.pairs[1:]:
            held = held & self._across(first, second)
        return held

    def _across(self, first: LandmarkPair, second: LandmarkPair) -> Bools:
        one, other = (self.directions(pair.start, pair.end) for pair in (first, second))
        area = np.linalg.norm(np.cross(one, other), axis=1)
        far: Bools = area >= self._least * np.linalg.norm(one, axis=1)
        return far


def _centres(mesh: SymbolicMesh, vocabulary: Sequence[str]) -> Floats:
    """The volume-weighted centre of the hulls with each label, and of all (labels + 1, 3); NaN where there is none."""
    volumes = np.array([hull.volume for hull in mesh.hulls])
    moments = volumes[:, None] * np.array([hull.shape.centroid for hull in mesh.hulls]).reshape(-1, 3)
    labels = np.array([hull.label or "" for hull in mesh.hulls], dtype=np.str_)
    masks = [*(labels == label for label in vocabulary), np.ones(len(labels), dtype=np.bool_)]
    return np.array([_centre(volumes[mask], moments[mask]) for mask in masks])


def _centre(volumes: Floats, moments: Floats) -> Floats:
    total = float(volumes.sum())
    centre: Floats = moments.sum(axis=0) / total if total > 0 else np.full(3, np.nan)
    return centre
