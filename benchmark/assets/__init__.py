"""The assets of the benchmark: parametric generators, and the collision meshes that CoACD made of them, frozen."""

from benchmark.assets.asset import Asset, Design, Site
from benchmark.assets.decomposition import MERGED, SEPARATE, SETS, SETTINGS, Decomposition
from benchmark.assets.families import family
from benchmark.assets.generation import CATEGORIES
from benchmark.assets.storage import Sample, samples

__all__ = [
    "CATEGORIES",
    "MERGED",
    "SEPARATE",
    "SETS",
    "SETTINGS",
    "Asset",
    "Decomposition",
    "Design",
    "Sample",
    "Site",
    "family",
    "samples",
]
