"""What of an asset can be decomposed: opaque pieces, and bodies that show something but have no collision geometry."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from meshforge.asset import Asset, Surface
from meshforge.geometry.decompose import is_line
from meshforge.preparation.record import Kind

_GRID = 1.4142135e-7
"""[m] Coordinates are compared in these steps; no round number, so that rounding errors tip no round coordinates."""


@dataclass(frozen=True, eq=False, slots=True)
class Source:
    """Geometry without hulls.

    what: the name of the opaque piece or the body; base: what names of its hulls begin with; surface: its triangles.
    """

    what: str
    kind: Kind
    body: str
    base: str
    surface: Surface

    @property
    def is_hopeless(self) -> bool:
        """Whether it has no area, so that no engine makes hulls of it."""
        return is_line(self.surface.vertices[self.surface.faces].reshape(-1, 3))


def sources(asset: Asset) -> tuple[Source, ...]:
    """All that can be decomposed, in the order of the file; planes and the like, which have no triangles, stay."""
    pieces = (
        Source(piece.name, "opaque", piece.body, piece.name, piece.surface)
        for piece in asset.opaque
        if piece.surface is not None and len(piece.surface.faces)
    )
    return (*pieces, *_bare_bodies(asset))


def _bare_bodies(asset: Asset) -> Iterable[Source]:
    """The bodies without collision geometry, by what they show. Their hulls are called as if the file had one geom."""
    solid = {geom.body for geom in asset.geoms} | {piece.body for piece in asset.opaque}
    for body in asset.bodies:
        seen = visual(asset, body.name) if body.name not in solid else None
        if seen:
            yield Source(body.name, "body", body.name, f"{body.name}/geom0", seen)


def visual(asset: Asset, body: str) -> Surface | None:
    """All that a body shows, None where that is nothing; what belongs to no body counts for one that is alone."""
    alone = len(asset.bodies) == 1
    own = [s for s in asset.visuals if len(s.faces) and (s.body == body or (s.body is None and alone))]
    if not own:
        return None
    starts = np.cumsum([0, *(len(s.vertices) for s in own)])
    faces = [s.faces + start for s, start in zip(own, starts, strict=False)]
    return Surface(np.concatenate([s.vertices for s in own]), np.concatenate(faces), body)


def surface_digest(surface: Surface) -> str:
    """A digest of triangles in their order, the same for coordinates that differ by rounding."""
    steps = np.rint(surface.vertices[surface.faces] / _GRID).astype(np.int64)
    return hashlib.blake2b(steps.tobytes(), digest_size=8).hexdigest()
