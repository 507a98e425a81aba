"""What must hold of a family before it is used: digests, labels on all of the surface, and no geometry twice."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np

from benchmark.real.family import Family
from benchmark.real.regions import label_surface, read_regions
from benchmark.real.surface import AssetSurface, areas_of, read_surface
from meshforge.common import MeshForgeError
from meshforge.geometry import Floats, convex_hull

FEWEST = 8
"""Assets of a family."""
_ALIKE = 0.003  # of the measures of a shape: closer ones are the same


def find_faults(family: Family) -> list[str]:
    """All that is wrong with a family, a sentence each."""
    faults = [f"{family.name}: {len(family.sources)} assets, {FEWEST} at least wanted"] * (len(family.sources) < FEWEST)
    shapes: dict[str, Floats] = {}
    for source in family.sources:
        try:
            if source.measure_digest() != source.digest:
                faults.append(f"{source.name}: its files are not those that were labelled (digest)")
            surface = read_surface(source)
            faults += find_unlabelled(family, surface)
            shapes[source.name] = measure_shape(surface)
        except MeshForgeError as error:
            faults.append(error.message)
    return [*faults, *_find_twins(shapes)]


def find_unlabelled(family: Family, surface: AssetSurface) -> Iterator[str]:
    """A sentence on each piece that has surface without a label."""
    patches = label_surface(surface, read_regions(family, surface.name))
    for name in dict.fromkeys(row.patch.name for row in patches if row.region is None):
        yield f"{surface.name}: piece {name} has surface without a label"


def measure_shape(surface: AssetSurface) -> Floats:
    """Measures (5,) of a surface that turn and scale do not change: spread along its axes, hull volume, area."""
    corners = np.concatenate([piece.corners for piece in surface.pieces])
    weights = areas_of(corners)
    centers = corners.mean(axis=1)
    spread = np.linalg.eigvalsh(np.cov(centers.T, aweights=weights))
    size = float(np.sqrt(spread.sum()))
    volume = convex_hull(corners.reshape(-1, 3)).volume
    return np.array([*np.sqrt(spread) / size, np.cbrt(volume) / size, np.sqrt(weights.sum()) / size])


def _find_twins(shapes: dict[str, Floats]) -> Iterator[str]:
    for (one, a), (other, b) in itertools.combinations(shapes.items(), 2):
        if np.abs(a - b).max() < _ALIKE:
            yield f"{one} and {other} have the same geometry"
