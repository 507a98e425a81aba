"""Hulls that stand for no surface: each is cut into cells, whose labels are those of look-alike cells of labelled
hulls. A hull likely spans parts where its cells do not look alike, where it is large and where it touches many."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry import Floats, Ints, Polytope, cut, planes_of
from meshforge.label_model.asset_pieces import AssetPieces
from meshforge.label_model.describe import find_up, rotation_to_z
from meshforge.label_model.spans import SpanPosterior, scale_rows, span_weights
from meshforge.label_model.surroundings import (
    NEAR_COLUMNS,
    PICTURE_COLUMNS,
    SURROUNDINGS_WIDTH,
    describe_surroundings,
    whole_of,
)
from meshforge.label_model.table import ColumnScale, Observations, metric_weights
from meshforge.label_model.ties import pick_evenly
from meshforge.symbolic import Hull, Label, SymbolicMesh

CELLS = 32
"""Cells that a hull is cut into, where it is not too thin."""
_LEAST_REST = 0.005  # a share of other labels is at least this, for its logarithm
_LEAST = 0.15  # of a cell's width that must lie on each side of a plane which cuts it
_NEAR_WORTH, _PICTURE_WORTH = 3.0, 0.5  # of what is close to a cell, and of the picture of the whole, beside hulls
_NEAREST = 40  # cells of labelled hulls that are looked at
_MOST = 4000  # of these that are compared, evenly chosen of more
_SOFT = 2.0  # distances in which likeness ends, at the farthest of those that are looked at
_MOST_SURE = 0.85  # on real families of other kinds than it was fitted on, pure hulls had more than 90%
_UNKNOWN = 0.02  # weight of each label beside what look-alikes say


def cut_into_cells(shape: Polytope, others: Sequence[Polytope], count: int = CELLS) -> list[Polytope]:
    """Convex cells that fill a convex shape, of about equal volume: up to `count`, cut one by one from the largest.

    A cell is cut along the plane of a face of `others` where one passes well through it, else in the middle of its
    length.
    """
    normals, offsets = _find_planes(shape, others)
    found = [shape]
    while len(found) < count:
        place = max(range(len(found)), key=lambda k: (found[k].volume, -k))
        halves = _halve(found[place], normals, offsets)
        if halves is None:
            break
        found[place : place + 1] = halves
    return found


def _find_planes(shape: Polytope, others: Sequence[Polytope]) -> tuple[Floats, Floats]:
    """Unit normals (p, 3) and offsets (p,) [m] of the faces of others that are near, whose planes pass through a
    shape."""
    near = [other for other in others if other.aabb.intersects(shape.aabb)]
    planes = [planes_of(other.vertices, other.faces) for other in near]
    normals = np.concatenate([np.zeros((0, 3)), *(own.normals for own in planes)])
    offsets = np.concatenate([np.zeros(0), *(own.offsets + own.normals @ own.middle for own in planes)])
    heights = shape.vertices @ normals.T - offsets
    through = (heights.min(axis=0) < 0) & (heights.max(axis=0) > 0)
    return normals[through], offsets[through]


def _halve(cell: Polytope, normals: Floats, offsets: Floats) -> tuple[Polytope, Polytope] | None:
    """Both sides of a cell, None where it is too thin to be cut."""
    point, normal = _choose_plane(cell, normals, offsets)
    try:
        below, above = cut(cell, point, normal)
    except GeometryError:
        return None
    return (below, above) if below and above else None


def _choose_plane(cell: Polytope, normals: Floats, offsets: Floats) -> tuple[Floats, Floats]:
    """A point on the plane and its normal, both (3,): of planes that leave enough on both sides the one across which
    the cell is longest and most evenly halved."""
    heights = cell.vertices @ normals.T - offsets
    below, above = -heights.min(axis=0), heights.max(axis=0)
    width = below + above
    smaller = np.minimum(below, above)
    worth = np.where(smaller >= _LEAST * width, smaller, 0.0)
    if worth.max(initial=0.0) > 0:
        best = int(worth.argmax())
        return normals[best] * offsets[best], normals[best]
    spread = cell.vertices - cell.vertices.mean(axis=0)
    return cell.centroid, np.linalg.eigh(spread.T @ spread)[1][:, -1]


class AssetCells(AssetPieces):
    """The hulls of an asset, and their cells as its pieces. owner: (cells,) the hull of each."""

    owner: Ints

    def __init__(self, mesh: SymbolicMesh) -> None:
        shapes = [hull.shape.tessellate() for hull in mesh.hulls]
        cells = list[Hull]()
        owner = list[int]()
        for place, (hull, shape) in enumerate(zip(mesh.hulls, shapes, strict=True)):
            own = cut_into_cells(shape, [*shapes[:place], *shapes[place + 1 :]])
            cells += (Hull(f"{hull.name}/{k}", hull.body, cell) for k, cell in enumerate(own))
            owner += [place] * len(own)
        super().__init__(mesh, SymbolicMesh(tuple(cells), mesh.asset, mesh.epsilon, mesh.scale))
        object.__setattr__(self, "owner", np.array(owner, dtype=np.int64))

    @cached_property
    def common(self) -> Floats:
        found = np.zeros((len(self.mesh.hulls), len(self.owner)))
        found[self.owner, np.arange(len(self.owner))] = [cell.volume for cell in self.pieces.hulls]
        return found

    @cached_property
    def region_of(self) -> Ints:
        """Each cell is a region by itself: nothing shows which are of one part."""
        return np.arange(len(self.owner))

    @cached_property
    def solid_of(self) -> Ints:
        return self.region_of

    @cached_property
    def surroundings(self) -> Floats:
        """What is around each cell (cells, columns), as `describe_surroundings` has it of hulls."""
        if not self.mesh.hulls:
            return np.zeros((0, SURROUNDINGS_WIDTH))
        turn = rotation_to_z(find_up(self.mesh))
        hulls = self.mesh.hulls
        whole = whole_of(tuple(hull.vertices for hull in hulls), tuple(hull.vertices[hull.faces] for hull in hulls))
        cells = tuple(cell.vertices @ turn.T for cell in self.pieces.hulls)
        return describe_surroundings(replace(whole.rotate(turn), pieces=cells))


class CellModel:
    """Assets of one kind, each with the cells of its hulls."""

    def __init__(self, assets: Sequence[AssetCells]) -> None:
        self.assets = assets
        rows = [asset.surroundings for asset in assets]
        scale, weights = ColumnScale.of(np.concatenate([np.zeros((0, SURROUNDINGS_WIDTH)), *rows])), _weigh_columns()
        self._rows = [scale(own) * weights for own in rows]

    def infer(self, labels: Sequence[Label | None]) -> CellPosterior:
        """What labels of the hulls of all meshes in order say, None for an unlabelled one."""
        seen = Observations.of(labels)
        solids = [np.zeros(len(asset.owner)) for asset in self.assets]
        return CellPosterior(self.assets, seen.labels, self._infer_cells(seen), span_weights("cells"), solids)

    def _infer_cells(self, seen: Observations) -> list[Floats]:
        """The probability of each label for the cells (cells, labels) of each mesh: what the nearest cells of labelled
        hulls have, but those of the same hull."""
        from scipy.spatial.distance import cdist  # lazy: 0.5 s, half of all imports

        starts = np.cumsum([0, *(len(asset.mesh.hulls) for asset in self.assets)])[:-1]
        hulls = [asset.owner + start for asset, start in zip(self.assets, starts.tolist(), strict=True)]
        of_all = np.concatenate([np.zeros(0, np.int64), *hulls])
        told = pick_evenly(np.flatnonzero(seen.known[of_all]), _MOST)
        rows = np.concatenate([np.zeros((0, SURROUNDINGS_WIDTH)), *self._rows])[told]
        says = np.eye(len(seen.labels))[seen.codes[of_all[told]]] * seen.confidence[of_all[told], None]
        found = list[Floats]()
        for own, owner in zip(self._rows, hulls, strict=True):
            apart = cdist(own, rows, "cityblock")
            apart[owner[:, None] == of_all[told][None]] = np.inf
            weights = _liken(apart) @ says + _UNKNOWN
            found.append(weights / weights.sum(axis=1, keepdims=True))
        return found


def _weigh_columns() -> Floats:
    """The weight of each column of what is around cells (columns,): that of hulls, but what is close counts more."""
    weights = metric_weights()[:SURROUNDINGS_WIDTH].copy()
    weights[NEAR_COLUMNS] *= _NEAR_WORTH
    weights[PICTURE_COLUMNS] *= _PICTURE_WORTH
    return weights


def _liken(apart: Floats) -> Floats:
    """How much each of n cells is like m others, from 0 to 1, by their distances (n, m)."""
    if not apart.size:
        return np.zeros(apart.shape)
    nearest = min(_NEAREST, apart.shape[1]) - 1
    reach = np.partition(apart, nearest, axis=1)[:, nearest]
    reach = np.where(np.isfinite(reach) & (reach > 0), reach, 1.0)
    found: Floats = np.exp(-((apart / reach[:, None] * _SOFT) ** 2))
    return found


@dataclass(frozen=True, eq=False)
class CellPosterior(SpanPosterior):
    """The same of hulls that stand for no surface."""

    def chances_of(self, mesh: int) -> Floats:
        """As by a surface, but likeness alone never makes it surer than 85%."""
        return np.minimum(super().chances_of(mesh), _MOST_SURE)

    def collect_evidence(self, mesh: int) -> Floats:
        """What the probability is made from (hulls, 5): one, and the logit of how often a hull spans parts where labels
        are drawn; the logit of the share of other labels by the likeliest label of each cell; the logarithm of the
        hull's volume by the mean of the hulls of the asset, and how many hulls it touches."""
        own = self.assets[mesh].mesh
        rest = np.clip(1 - self._main_shares(mesh), _LEAST_REST, 1 - _LEAST_REST)
        volumes = np.maximum([hull.volume for hull in own.hulls], np.finfo(float).tiny)
        touching = np.bincount(np.array(sorted(own.contacts), np.int64).ravel(), minlength=len(own.hulls))
        size = np.log(volumes / volumes.mean()) if len(volumes) else volumes
        return np.column_stack([super().collect_evidence(mesh), np.log(rest / (1 - rest)), size, touching])

    def _main_shares(self, mesh: int) -> Floats:
        """The share (hulls,) of the label that has most of each hull, where each piece has its likeliest label."""
        common, chances = self.assets[mesh].common, self.chances[mesh]
        if not chances.size:
            return np.ones(len(common))
        likeliest = np.eye(chances.shape[1])[chances.argmax(axis=1)]
        found: Floats = scale_rows(common @ likeliest, common.sum(axis=1)).max(axis=1)
        return found
