"""Real assets decomposed as a whole: one call of CoACD on all that an asset shows, so that hulls span parts."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np

from benchmark.assets import Sample
from benchmark.assets.decomposition import coacd
from benchmark.real.family import CACHE, family
from benchmark.real.samples import RealAsset, label_hulls, name_hulls, real_asset
from meshforge.geometry import Floats, Ints, Polytope, decompose
from script.samples.pieces import triangles
from script.samples.solids import union

REAL = "real"
"""The setting of these meshes."""
THRESHOLD = 0.2
"""CoACD's concavity threshold."""
_BODY = "body"


def list_whole(family_name: str) -> tuple[str, ...]:
    """The assets of a family that show a surface to decompose."""
    return tuple(source.name for source in family(family_name).sources if source.decompose)


def list_hidden(family_name: str) -> tuple[str, ...]:
    """The others, of which the corpus has collision geometry alone."""
    return tuple(source.name for source in family(family_name).sources if not source.decompose)


@cache
def whole_sample(family_name: str, name: str) -> Sample:
    """The mesh of an asset. Raises AssetError where the corpus is not here."""
    real = real_asset(family_name, name)
    made = ((_BODY, hull) for hull in _decompose_whole(real))
    return label_hulls(real.asset, REAL, name_hulls(made, real.asset.pose))


def visual_surface(real: RealAsset) -> tuple[Floats, Ints]:
    """Vertices (n, 3) [m], upright, and triangles (m, 3) of all that an asset shows, whatever its body."""
    patches = real.surface.pieces
    offsets = np.cumsum([0, *(len(patch.vertices) for patch in patches)])
    faces = [patch.faces + offset for patch, offset in zip(patches, offsets[:-1].tolist(), strict=True)]
    return np.concatenate([patch.vertices for patch in patches]), np.concatenate(faces)


def _decompose_whole(real: RealAsset) -> list[Polytope]:
    """The hulls, upright: of the union of all solids, or of the surface remeshed by voxels where it is not watertight,
    as in the other settings."""
    settings = coacd(THRESHOLD)
    if all(row.closed for row in real.solids):
        return decompose(*triangles(union([row.solid for row in real.solids])), settings, cache=CACHE)
    return decompose(*visual_surface(real), replace(settings, preprocess_mode="on"), cache=CACHE)
