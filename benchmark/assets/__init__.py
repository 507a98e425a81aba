"""The assets of the benchmark: parametric generators, and the collision meshes that CoACD made of them, frozen."""

from benchmark.assets.asset import Asset, Built, Site
from benchmark.assets.decomposing import SETTINGS, Decomposed
from benchmark.assets.frozen import Sample, samples
from benchmark.assets.making import CATEGORIES

__all__ = ["CATEGORIES", "SETTINGS", "Asset", "Built", "Decomposed", "Sample", "Site", "samples"]
