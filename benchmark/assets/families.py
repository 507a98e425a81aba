"""Families to learn from: all assets of a category at one decomposition each.

Decompositions of one asset are much alike. In one family they would vote for each other, and in folds of a
cross-validation one would be tested on what another taught; so no family has two of an asset.
"""

from __future__ import annotations

from benchmark.assets.storage import Sample, samples


def family(category: str, setting: str, calibration: bool = False) -> tuple[Sample, ...]:
    """All assets of a category, each once, at one setting of `SETTINGS`."""
    return samples(category, calibration, (setting,))
