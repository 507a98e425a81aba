"""Collision meshes of real assets with true labels: as they come, and decomposed by CoACD at three settings."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from pathlib import Path

import numpy as np
from manifold3d import Manifold

from benchmark.assets import SEPARATE, Asset, Sample
from benchmark.assets.decomposition import coacd, shares, threshold_of
from benchmark.criteria.solid import near
from benchmark.real.family import CACHE, Family, Source, family
from benchmark.real.parts import SolidPiece, cut_parts, make_solids
from benchmark.real.regions import read_regions
from benchmark.real.sites import sites_of
from benchmark.real.surface import AssetSurface, matches, read_surface
from benchmark.tasks import Task
from meshforge.common import AssetError, pluralize
from meshforge.geometry import CoacdSettings, Polytope, Pose, convex_hull, decompose, spans_volume
from meshforge.symbolic import Hull, Label, SymbolicMesh
from script.samples.part import Part
from script.samples.pieces import DIGITS, triangles
from script.samples.solids import union

AS_IS = "as_is"
"""The setting of meshes as their files have them."""
ALL_SETTINGS = (AS_IS, *SEPARATE)
RECORD = "decompositions.json"
"""File of a family: for each asset and setting the digest of its hulls."""
BARE = 0.2
"""A part with less than this of its volume in hulls has no collision geometry."""
MERGED = 0.5
"""A part with less than this of what is in hulls in hulls of its label was merged into others."""
_CONVEX = 0.999  # of the volume of its convex hull: such a solid is one hull at any setting


@dataclass(frozen=True, eq=False)
class RealAsset:
    """An asset of a family: its source, its surface, the solids of its pieces, and what criteria ask of it."""

    source: Source
    surface: AssetSurface
    solids: tuple[SolidPiece, ...]
    asset: Asset


@cache
def real_asset(family_name: str, name: str) -> RealAsset:
    """An asset of a family."""
    one = family(family_name)
    source = one.source(name)
    surface = read_surface(source)
    solids = make_solids(surface)
    parts = cut_parts(surface, read_regions(one, name), solids)
    sites = sites_of(family_name, parts)
    about = f"{source.repository} {source.origin}"
    asset = Asset(name, family_name, source.kind, source.rare, about, parts, sites, surface.pose, False)
    return RealAsset(source, surface, tuple(solids), asset)


@cache
def family_samples(family_name: str, setting: str) -> tuple[Sample, ...]:
    """The meshes of a family at one setting: of each asset one, but for those that have none (`why_absent`)."""
    one = family(family_name)
    return tuple(s for name in one.names for s in [make_sample(one, name, setting)] if s is not None)


@cache
def choose_samples(family_name: str) -> tuple[Sample, ...]:
    """A mesh of each asset of a family: as it comes, else the fine one."""
    one = family(family_name)
    found = (make_sample(one, name, AS_IS) or make_sample(one, name, SEPARATE[-1]) for name in one.names)
    return tuple(sample for sample in found if sample)


def make_sample(one: Family, name: str, setting: str) -> Sample | None:
    """The mesh of an asset at one setting, None where it has none."""
    source = one.source(name)
    if why_absent(source) if setting == AS_IS else not source.decompose:
        return None
    real = real_asset(one.name, name)
    hulls = _as_is(real.source) if setting == AS_IS else _decompose(real, coacd(threshold_of(setting, one.name)))
    asset = real.asset
    if setting == AS_IS and (lacking := find_bare(hulls, asset)):
        parts = tuple(part for part in asset.parts if part.name not in lacking)
        asset = replace(asset, parts=parts, sites=sites_of(one.name, parts))
    return label_hulls(asset, setting, hulls)


def label_hulls(asset: Asset, setting: str, hulls: Sequence[Hull]) -> Sample:
    """Hulls of an asset with their true labels; setting: what they were made by."""
    told = tuple(shares(_polytope(hull), asset.parts, asset.pose) for hull in hulls)
    named = [replace(h, annotation=Label(next(iter(row)), 1.0, "file")) for h, row in zip(hulls, told, strict=True)]
    return Sample(f"{asset.name}_{setting}", asset, setting, SymbolicMesh(tuple(named)), told)


def why_absent(source: Source) -> str | None:
    """Why an asset has no mesh as it comes; None where it has one."""
    asset = source.read()
    concave = [o.name for o in asset.non_convex if o.plane is None and not matches(o.name, source.without)]
    if concave:
        return f"{pluralize(len(concave), 'non-convex piece')}, such as {concave[0]}"
    count = len(_as_is(source))
    return f"{count} hull" if count < 2 else None


def find_bare(hulls: Sequence[Hull], asset: Asset) -> list[str]:
    """The parts that a file has hardly any collision geometry for; a mesh as it comes is judged without them."""
    solids = union([_solid(hull, asset.pose.inverse()) for hull in hulls])
    return [part.name for part in asset.parts if (part.solid ^ solids).volume() < BARE * part.solid.volume()]


@lru_cache(maxsize=1024)
def find_merged(sample: Sample) -> tuple[Part, ...]:
    """The parts that are mostly in hulls of other labels: a decomposition merged them into these.

    The purity of such a hull may be high all the same, where the part is small beside it.
    """
    back = sample.asset.pose.inverse()
    solids = [(hull.label, _solid(hull, back)) for hull in sample.mesh.hulls]
    merged = []
    for part in sample.asset.parts:
        there = [(label, solid) for label, solid in solids if near(solid, part.solid)]
        everywhere = union([solid for _, solid in there] or [Manifold()])
        own = union([solid for label, solid in there if label == part.label] or [Manifold()])
        if (part.solid ^ own).volume() < MERGED * (part.solid ^ everywhere).volume():
            merged.append(part)
    return tuple(merged)


def is_pure(task: Task, sample: Sample) -> bool:
    """Whether no hull and no part that the task's rules are about was merged with others by the decomposition."""
    return not task.impure(sample) and not any(part.label in task.labels for part in find_merged(sample))


def _solid(hull: Hull, back: Pose) -> Manifold:
    return Manifold.hull_points(back.apply(hull.vertices))


def _as_is(source: Source) -> list[Hull]:
    """The hulls as the file has them."""
    mesh = SymbolicMesh.of(source.read())
    return [hull for hull in mesh.hulls if not matches(hull.name, source.without)]


def _polytope(hull: Hull) -> Polytope:
    return hull.shape if isinstance(hull.shape, Polytope) else convex_hull(hull.vertices)


def _decompose(real: RealAsset, settings: CoacdSettings) -> list[Hull]:
    """The hulls that CoACD makes of what each body shows, body by body, in the frame of the file."""
    bodies: dict[str, list[SolidPiece]] = {}
    for row in real.solids:
        bodies.setdefault(row.patch.body, []).append(row)
    made = [(body, hull) for body, rows in bodies.items() for hull in _decompose_body(rows, settings)]
    return name_hulls(made, real.asset.pose)


def name_hulls(made: Iterable[tuple[str, Polytope]], pose: Pose) -> list[Hull]:
    """Hulls with their bodies, upright, as hulls of a file, in an order that tells nothing of parts; pose: of the
    asset."""
    made = sorted(made, key=lambda row: tuple(row[1].centroid.round(4)))
    rounded = [(body, np.round(pose.apply(hull.vertices), DIGITS)) for body, hull in made]
    placed = [row for row in rounded if spans_volume(row[1])]  # slivers have none once they are rounded
    width = len(str(max(len(placed) - 1, 0)))
    return [Hull(f"hull_{k:0{width}}", body, convex_hull(points), None) for k, (body, points) in enumerate(placed)]


def _decompose_body(rows: Sequence[SolidPiece], settings: CoacdSettings) -> Iterator[Polytope]:
    """The hulls of one body, upright: of each connected solid, or of all where a piece is not watertight."""
    if all(row.closed for row in rows):
        for solid in union([row.solid for row in rows]).decompose():
            if solid.volume() > 0:  # a void within is a shell of its own, inside out
                yield from _decompose_solid(solid, settings)
        return
    offsets = np.cumsum([0, *(len(row.patch.vertices) for row in rows)])
    points = np.concatenate([row.patch.vertices for row in rows])
    faces = np.concatenate([row.patch.faces + offset for row, offset in zip(rows, offsets[:-1], strict=True)])
    yield from decompose(points, faces, replace(settings, preprocess_mode="on"), cache=CACHE)


def _decompose_solid(solid: Manifold, settings: CoacdSettings) -> list[Polytope]:
    points, faces = triangles(solid)
    hull = convex_hull(points)
    return [hull] if solid.volume() >= _CONVEX * hull.volume else decompose(points, faces, settings, cache=CACHE)


def digest_of(sample: Sample) -> str:
    """A digest of the hulls of a sample, their corners in hundredths of a millimetre."""
    total = hashlib.sha256()
    for hull in sample.mesh.hulls:
        corners = np.round(np.asarray(hull.vertices), DIGITS) + 0.0
        total.update(np.ascontiguousarray(corners[np.lexsort(corners.T)]).tobytes())
    return total.hexdigest()[:16]


def record_digests(one: Family) -> Path:
    """Write the digests of all samples of a family."""
    rows = {s.name: digest_of(s) for setting in SEPARATE for s in family_samples(one.name, setting)}
    path = one.folder / RECORD
    path.write_text(json.dumps(rows, indent=1) + "\n", "utf-8")
    return path


def find_changed_samples(one: Family) -> list[str]:
    """Samples whose hulls are not those that were recorded. Raises AssetError where none were."""
    path = one.folder / RECORD
    if not path.is_file():
        raise AssetError("no decompositions are recorded", where=one.name, remedy="python -m benchmark.real record")
    known = json.loads(path.read_text("utf-8"))
    here = {s.name: digest_of(s) for setting in SEPARATE for s in family_samples(one.name, setting)}
    return sorted(name for name in known.keys() | here.keys() if known.get(name) != here.get(name))
