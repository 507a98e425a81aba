"""Where the landmarks of some meshes lie, and how much alike the directions between them are."""

from collections.abc import Sequence
from itertools import combinations

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats
from meshforge.language import All, BaseExtractor, Is, LandmarkPair, Orient
from meshforge.symbolic import SymbolicMesh

APART = 0.02
"""Landmarks nearer than this share of the diagonal are not paired: how the hulls were cut may move them as far."""

ALONG = float(np.cos(np.radians(10)))
"""Landmarks lie along an axis where they are no farther off than this."""
NEARLY_ALL, _USUAL = 0.9, 0.5
"""The share of the meshes on which they must, to support the axis; and on which they are to be there at all."""
_BETTER_PART, _NEAR = 0.4, float(np.radians(15))

Bools = npt.NDArray[np.bool_]


class Landmarks:
    """The centres of all landmarks of some meshes, in the frames in which they came.

    bases: the labels in their order, then `All`.
    """

    def __init__(self, meshes: Sequence[SymbolicMesh], vocabulary: Sequence[str]) -> None:
        self.bases: tuple[BaseExtractor, ...] = (*map(Is, vocabulary), All())
        centres = [_centres(mesh, vocabulary) for mesh in meshes]
        self._centres = np.array(centres).reshape(len(meshes), len(self.bases), 3)
        self._least = APART * np.array([mesh.diagonal for mesh in meshes])

    def place(self, base: BaseExtractor) -> int:
        """Return the position of a base in their order."""
        return self.bases.index(base)

    def directions(self, start: BaseExtractor, end: BaseExtractor) -> Floats:
        """Return from one landmark's centre to another's on each mesh (n, 3) [m]; NaN where one is missing."""
        return self._centres[:, self.place(end)] - self._centres[:, self.place(start)]

    def apart(self, start: BaseExtractor, end: BaseExtractor) -> Bools:
        """Return on which meshes both landmarks are present, and apart (n,)."""
        far: Bools = np.linalg.norm(self.directions(start, end), axis=1) >= self._least
        return far

    def holds(self, orient: Orient) -> Bools:
        """Return on which meshes (n,) the landmarks of a directive are apart, a second pair across the first."""
        first = orient.pairs[0]
        satisfied = self.apart(first.start, first.end)
        for second in orient.pairs[1:]:
            satisfied = satisfied & self._across(first, second)
        return satisfied

    def supports(self, letter: str) -> bool:
        """Return whether two landmarks lie along a coordinate axis on nearly all meshes, the same way round."""
        present = [(a, b) for a, b in combinations(self.bases, 2) if self.apart(a, b).mean() >= _USUAL]
        return any(self._lie_along(a, b, "XYZ".index(letter)) for a, b in present)

    def _lie_along(self, start: BaseExtractor, end: BaseExtractor, place: int) -> bool:
        cosines = self._units(start, end)[:, place]
        return max(float((sign * cosines >= ALONG).mean()) for sign in (1, -1)) >= NEARLY_ALL

    def deviation(self, pair: LandmarkPair) -> float:
        """Return the angle [rad] between a pair and its axis on the better part of the meshes; no more than counts as
        near.

        A frame in which most meshes stand well shows which landmarks lie along its axes.
        """
        sign = 1.0 if pair.axis[0] == "+" else -1.0
        cosines = sign * self._units(pair.start, pair.end)[:, "XYZ".index(pair.axis[1])]
        angle = float(np.arccos(np.clip(np.quantile(cosines, 1 - _BETTER_PART), -1, 1)))
        return min(angle, _NEAR)

    def likeness(self, pair: LandmarkPair) -> float:
        """Return the share of the distances of all landmarks from the middle that a height along the pair explains,
        which each landmark has on all meshes alike."""
        there = self.apart(pair.start, pair.end)
        units = np.zeros((len(there), 3))
        units[there] = self._units(pair.start, pair.end)
        offsets = (self._centres - self._centres[:, -1:])[there] / self._least[there, None, None]
        heights = np.einsum("mlk,mk->ml", offsets, units[there])
        known = ~np.isnan(heights)
        counts = known.sum(axis=0)
        means = np.where(known, heights, 0.0).sum(axis=0) / np.maximum(counts, 1)
        total = float(np.nansum(offsets**2))
        return float((counts * means**2).sum()) / total if total else 0.0

    def _units(self, start: BaseExtractor, end: BaseExtractor) -> Floats:
        """The directions from one landmark to another where they are apart, at unit length (n, 3)."""
        gaps = self.directions(start, end)[self.apart(start, end)]
        units: Floats = gaps / np.linalg.norm(gaps, axis=1, keepdims=True)
        return units

    def _across(self, first: LandmarkPair, second: LandmarkPair) -> Bools:
        one, other = (self.directions(pair.start, pair.end) for pair in (first, second))
        far: Bools = np.linalg.norm(np.cross(one, other), axis=1) >= self._least * np.linalg.norm(one, axis=1)
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
    return moments.sum(axis=0) / total if total > 0 else np.full(3, np.nan)
