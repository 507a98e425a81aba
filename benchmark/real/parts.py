"""The true parts of an asset as solids, from its labelled surface.

A piece of the surface that is watertight is a solid as it is; one that lies in another with its inside out is a cavity
of that. Of another piece it is the union of the hulls of a fine decomposition, which CoACD makes after it has remeshed
the piece by voxels: a bent sheet gets the thickness of about two voxels, a flat one `SHEET` of the asset's size.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from manifold3d import Error, Manifold, Mesh

from benchmark.real.family import CACHE, Family, Source
from benchmark.real.regions import Region, planes_of_box, read_regions
from benchmark.real.surface import AssetSurface, Patch, matches, read_surface
from meshforge.batch.preparation.decompose import decompose_surface
from meshforge.geometry import CoacdSettings, Floats, Ints, Polytope, is_sheet, principal_extents
from meshforge.geometry.decomposition.triangles import cap_holes, clean_triangles
from meshforge.symbolic import Surface
from script.samples.part import Part
from script.samples.solids import block, union

FINE = CoacdSettings(
    threshold=0.03,
    preprocess_mode="on",
    preprocess_resolution=100,
    resolution=1000,
    mcts_iterations=20,
    mcts_nodes=10,
    mcts_max_depth=2,
)
"""How a piece that is not watertight is decomposed to become a solid."""
SHEET = 0.002
"""Thickness of a flat sheet, of the diagonal of its asset."""
_LEAST = 1e-5  # volume of a bit that counts, of that of its piece


@dataclass(frozen=True, eq=False)
class SolidPiece:
    """A piece of the surface with its solid; closed: whether the piece is watertight."""

    patch: Patch
    solid: Manifold
    closed: bool


def make_parts(family: Family, source: Source) -> tuple[AssetSurface, tuple[Part, ...]]:
    """The surface of an asset and its true parts, upright."""
    surface = read_surface(source)
    return surface, cut_parts(surface, read_regions(family, source.name), make_solids(surface))


def make_solids(surface: AssetSurface) -> list[SolidPiece]:
    """Each piece of a surface as a solid, but for cavities, which are taken out of the pieces around them."""
    low, high = surface.bounds
    size = float(np.linalg.norm(high - low))
    pieces = [_cap(piece) if matches(piece.name, surface.close) else piece for piece in surface.pieces]
    made = [(piece, close_piece(piece)) for piece in pieces]
    outer: list[SolidPiece] = []
    cavities: list[Manifold] = []
    for piece, solid in made:
        if solid is None:
            outer.append(SolidPiece(piece, _fill(piece, size), False))
        elif solid.volume() < 0 and any(_surrounds(other, piece) for other, _ in made if other is not piece):
            cavities.append(_turn_out(piece))
        else:
            outer.append(SolidPiece(piece, solid if solid.volume() >= 0 else _turn_out(piece), True))
    if not cavities:
        return outer
    return [SolidPiece(row.patch, row.solid - union(cavities), row.closed) for row in outer]


def close_piece(piece: Patch) -> Manifold | None:
    """A piece as a solid, of negative volume where it is inside out; None where it is not watertight."""
    if not _is_balanced(piece.faces):  # Manifold crashes on some of these
        return None
    solid = Manifold(Mesh(piece.vertices.astype(np.float32), piece.faces.astype(np.uint32)))
    return solid if solid.status() == Error.NoError and abs(solid.volume()) > 0 else None


def _is_balanced(faces: Ints) -> bool:
    """Whether along every edge as many triangles of faces (m, 3) run one way as the other."""
    start, end, count = faces.ravel(), faces[:, [1, 2, 0]].ravel(), int(faces.max()) + 1
    return np.array_equal(np.sort(start * count + end), np.sort(end * count + start))


def _cap(piece: Patch) -> Patch:
    """A piece with caps on its planar holes, where these close it."""
    mesh, _ = cap_holes(clean_triangles(piece.vertices, piece.faces))
    return replace(piece, vertices=mesh.vertices, faces=mesh.faces)


def _turn_out(piece: Patch) -> Manifold:
    return Manifold(Mesh(piece.vertices.astype(np.float32), piece.faces[:, ::-1].astype(np.uint32)))


def _surrounds(one: Patch, other: Patch) -> bool:
    inside = (
        other.vertices.min(axis=0) > one.vertices.min(axis=0),
        other.vertices.max(axis=0) < one.vertices.max(axis=0),
    )
    return bool(np.all(inside))


def _fill(piece: Patch, size: float) -> Manifold:
    """The solid of a piece that is not watertight."""
    surface = Surface(piece.vertices, piece.faces)
    hulls = decompose_surface(surface, FINE, piece.name, hollow=True, cache=CACHE, note=lambda _: None)
    if is_sheet(piece.vertices):
        return union([_thicken(hull, piece.vertices, SHEET * size / 2) for hull in hulls])
    return union([Manifold.hull_points(hull.vertices) for hull in hulls])


def _thicken(hull: Polytope, points: Floats, reach: float) -> Manifold:
    """A hull of a flat sheet of points (n, 3), to `reach` [m] on either side of it."""
    normal = principal_extents(points)[1][2]
    return Manifold.hull_points(np.concatenate([hull.vertices + reach * normal, hull.vertices - reach * normal]))


def cut_parts(surface: AssetSurface, regions: Sequence[Region], solids: Sequence[SolidPiece]) -> tuple[Part, ...]:
    """The parts: solids cut where regions end, those of one part united."""
    low, high = surface.bounds
    bits: list[tuple[Region, Manifold]] = []
    for row in solids:
        rest = row.solid
        for region in regions:
            if matches(row.patch.name, region.pieces) and not rest.is_empty():
                taken, rest = _take(rest, region, low, high)
                found = taken.decompose() if region.boxes else [taken]
                bits += [(region, bit) for bit in found if bit.volume() > _LEAST * row.solid.volume()]
    return tuple(_unite(bits))


def _take(rest: Manifold, region: Region, low: Floats, high: Floats) -> tuple[Manifold, Manifold]:
    """What of a solid a region takes, and what it leaves."""
    if not region.boxes:
        return rest, Manifold()
    taken = Manifold()
    for box in region.boxes:
        corners = np.stack([low - (high - low), high + (high - low)])
        for axis, side, at in planes_of_box(box, low, high):
            corners[0 if side > 0 else 1, axis] = at
        room = block(tuple(corners[0].tolist()), tuple(corners[1].tolist()))
        taken, rest = taken + (rest ^ room), rest - room
    return taken, rest


def _unite(bits: Sequence[tuple[Region, Manifold]]) -> Iterator[Part]:
    """Parts by name: what a region says, or the label with a number."""
    named: dict[tuple[str, str], list[Manifold]] = {}
    count: dict[str, int] = {}
    for region, bit in bits:
        if region.part is None:
            count[region.label] = count.get(region.label, 0) + 1
        name = region.part or f"{region.label}_{count[region.label]}"
        named.setdefault((name, region.label), []).append(bit)
    for (name, label), solids in named.items():
        yield Part(name, label, union(solids))
