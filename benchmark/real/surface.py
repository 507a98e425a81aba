"""The surface of an asset as named pieces, upright: what each body shows, split in what hangs together."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase

import numpy as np

from benchmark.real.family import Source
from meshforge.geometry import Floats, Ints, Pose
from meshforge.geometry.connectivity import components_by_vertices, distinct_faces, row_ids
from meshforge.symbolic import Asset

NEAR = 1e-6
"""Of the diagonal: vertices closer than this are one."""


@dataclass(frozen=True, eq=False)
class Patch:
    """Triangles with a name: vertices (n, 3) [m], upright, and faces (m, 3); body: of the file, that they belong to."""

    name: str
    vertices: Floats
    faces: Ints
    body: str = ""

    @property
    def corners(self) -> Floats:
        """The corners of the triangles (m, 3, 3)."""
        return self.vertices[self.faces]

    @property
    def area(self) -> float:
        """[m^2]"""
        return float(areas_of(self.corners).sum())


@dataclass(frozen=True, eq=False)
class AssetSurface:
    """The pieces of an asset's surface, upright, standing on z = 0; pose: file_T_upright; close: as of `Source`."""

    name: str
    pieces: tuple[Patch, ...]
    pose: Pose
    close: tuple[str, ...] = ()

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """The lowest and the highest corner [m]."""
        points = np.concatenate([piece.vertices for piece in self.pieces])
        return points.min(axis=0), points.max(axis=0)


def areas_of(corners: Floats) -> Floats:
    """The areas (m,) [m^2] of triangles (m, 3, 3)."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.asarray(np.linalg.norm(normals, axis=1) / 2)


def read_surface(source: Source) -> AssetSurface:
    """The surface of an asset of a family."""
    asset = source.read()
    found = [row for row in _surfaces(asset, source.surface) if not matches(row[0], source.without)]
    points = np.concatenate([row[2] for row in found])
    pose = _stand(source, asset, points)
    back = pose.inverse()
    reach = NEAR * float(np.linalg.norm(np.ptp(points, axis=0)))
    return AssetSurface(
        source.name,
        tuple(
            replace(bit, body=body)
            for name, body, points, faces in found
            for bit in split_patch(name, back.apply(points), faces, reach)
        ),
        pose,
        source.close,
    )


def matches(name: str, patterns: tuple[str, ...]) -> bool:
    """Whether a name fits one of some patterns."""
    return any(name == pattern or fnmatchcase(name, pattern) for pattern in patterns)


def _stand(source: Source, asset: Asset, points: Floats) -> Pose:
    """file_T_upright: Z up, the middle of the asset's box on the Z axis, its lowest point at height 0."""
    up = source.up or asset.up or "z"
    turn = np.radians(source.turn)
    about = Pose.from_rpy((0, 0, 0), (0.0, 0.0, turn)).rotation
    rotation = {"z": np.eye(3), "y": np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])}[up] @ about
    seen = points @ rotation  # upright, but for the shift
    low, high = seen.min(axis=0), seen.max(axis=0)
    return Pose(rotation, rotation @ np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]]))


def _surfaces(asset: Asset, wanted: str | None) -> Iterator[tuple[str, str, Floats, Ints]]:
    """Name, body, vertices and triangles in the file's frame of what bodies show, or of their collision geometry."""
    first = asset.bodies[0].name if asset.bodies else ""
    visuals = [] if wanted == "collision" else [(v.body or first, v) for v in asset.visuals if len(v.faces)]
    shown = {body for body, _ in visuals}
    counts = {body: sum(name == body for name, _ in visuals) for body in shown}
    number = dict.fromkeys(shown, 0)
    for body, visual in visuals:
        yield (f"{body}.{number[body]}" if counts[body] > 1 else body), body, visual.vertices, visual.faces
        number[body] += 1
    if wanted == "visual":
        return
    for geom in asset.geoms:
        if geom.body not in shown:
            yield geom.name, geom.body, geom.shape.vertices, geom.shape.faces
    for opaque in asset.non_convex:
        if opaque.body not in shown and opaque.surface is not None and opaque.plane is None:
            yield opaque.name, opaque.body, opaque.surface.vertices, opaque.surface.faces


def split_patch(name: str, vertices: Floats, faces: Ints, reach: float) -> Iterator[Patch]:
    """The parts of a surface that hang together once vertices in one place are one; doubled triangles are one."""
    ids, first = row_ids(*np.round(vertices / reach).T)
    corners = ids[faces]
    component = components_by_vertices(corners)
    proper = distinct_faces(corners, component)
    corners, component = corners[proper], component[proper]
    numbers = list(dict.fromkeys(component.tolist()))
    for k, number in enumerate(numbers):
        mine = corners[component == number]
        used, local = np.unique(mine, return_inverse=True)
        yield Patch(f"{name}#{k}" if len(numbers) > 1 else name, vertices[first[used]], local.reshape(-1, 3))
