"""The CoACD settings that the family was decomposed with, from one block a drawer to crumbs."""

from __future__ import annotations

from meshforge.geometry.decomposition.engines import CoacdSettings


def coacd(threshold: float, *, merge: bool = True, most: int = -1, seed: int = 0) -> CoacdSettings:
    """CoACD at a concavity threshold; the parts are watertight, so nothing needs to be remeshed."""
    return CoacdSettings(
        threshold=threshold, merge=merge, max_convex_hull=most, seed=seed, preprocess_mode="off", resolution=1000
    )


BLOCK = coacd(0.5)
CHUNKS = coacd(0.25)
COARSE = coacd(0.15)
MEDIUM = coacd(0.05)
FINE = coacd(0.025)
FINEST = coacd(0.012)
UNMERGED = coacd(0.04, merge=False)
SHATTERED = coacd(0.02, merge=False)
PLUGGED = coacd(0.3, seed=1)
"""Coarse enough that two hulls fill a drawer."""
