"""The surface that the hulls of each body stand for: what the body shows, or else what hulls were decomposed from."""

from __future__ import annotations

import numpy as np

from meshforge.batch.preparation.record import merge_visuals
from meshforge.symbolic import Asset, Surface


def find_surfaces(asset: Asset) -> dict[str, Surface]:
    """The surface by body, of an asset as it was read; bodies without any are left out.

    Non-convex collision pieces of a body count where it has any, since hulls are made of these; else what it shows.
    """
    found = dict[str, Surface]()
    for body in asset.bodies:
        pieces = [p.surface for p in asset.opaque if p.body == body.name and p.surface and len(p.surface.faces)]
        if surface := _merge(pieces, body.name) or merge_visuals(asset, body.name):
            found[body.name] = surface
    return found


def _merge(pieces: list[Surface], body: str) -> Surface | None:
    if not pieces:
        return None
    starts = np.cumsum([0, *(len(piece.vertices) for piece in pieces)])
    faces = [piece.faces + start for piece, start in zip(pieces, starts, strict=False)]
    return Surface(np.concatenate([piece.vertices for piece in pieces]), np.concatenate(faces), body)
