"""From the parts of a table to its labelled hulls: CoACD on every part, as pipelines do that know the parts."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from manifold3d import Manifold

from meshforge.geometry import Floats, Ints, Polytope, Pose, convex_hull
from meshforge.geometry.decomposition.engines import CoacdSettings
from meshforge.geometry.decomposition.run import decompose
from script.samples.part import Part

DIGITS = 5  # of coordinates in the files: hundredths of a millimetre


@dataclass(frozen=True)
class Piece:
    """A convex hull with the name and the label of its part."""

    hull: Polytope
    part: str
    label: str


def pieces_of(part: Part, pose: Pose, settings: CoacdSettings, cache: Path | None = None) -> list[Piece]:
    """The hulls of a part put at `pose`, with rounded coordinates, in CoACD's order."""
    placed = part.solid.transform(np.column_stack([pose.rotation, pose.translation]))
    hulls = decompose(*triangles(placed), settings, cache=cache)
    rounded = [convex_hull(np.round(h.vertices, DIGITS), name=part.name) for h in hulls]
    return [Piece(hull, part.name, part.label) for hull in rounded]


def triangles(solid: Manifold) -> tuple[Floats, Ints]:
    """Vertices (n, 3) and triangles (m, 3) of a solid."""
    mesh = solid.simplify(1e-4).to_mesh64()
    points = np.round(np.asarray(mesh.vert_properties, float)[:, :3], 7)  # CoACD's search feels the last bit
    return points, np.asarray(mesh.tri_verts, np.int64)
