"""A family whose assets were each decomposed as a whole, with the fine pieces of their surfaces and what is known of
their labels."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from benchmark.assets import Asset, Sample
from benchmark.assets.decomposition import shares
from benchmark.spanning.sets import list_samples, surface_of
from benchmark.tasks.task import PURE
from meshforge.geometry import FinePiece, Polytope, cache_folder, decompose_finely, divide
from meshforge.label_model import AssetCells, AssetPieces, CellModel, SpanModel, SpanPosterior, piece_mesh
from meshforge.symbolic import Hull, Label, SymbolicMesh

KNOWN = 3
"""Assets of a family that a person labelled."""
BY_PIECES, BY_HULLS = "pieces", "hulls"
"""What a person labelled of these: the fine pieces and the pure hulls, or the hulls alone."""
LABELLED = (BY_PIECES, BY_HULLS)
NO_SURFACE = "hulls, no surface"
"""The hulls alone were labelled, and nobody knows the surface."""
WAYS = (*LABELLED, NO_SURFACE)
_SEED = 28
Parts = Mapping[int, Sequence[Polytope]]
"""The parts of the hulls that are split, by the number of the hull."""


@dataclass(frozen=True, eq=False)
class SpanFamily:
    """The assets of a category in one of the sets.

    fine: the fine pieces of the surface of each asset, in the frame of its file; known: the assets that a
    person labelled.
    """

    samples: tuple[Sample, ...]
    fine: tuple[tuple[FinePiece, ...], ...] = field(repr=False)
    known: frozenset[int]

    @cached_property
    def pieces(self) -> tuple[tuple[Polytope, ...], ...]:
        """The fine pieces of each asset."""
        return tuple(tuple(piece.shape for piece in own) for own in self.fine)

    @cached_property
    def model(self) -> SpanModel:
        """The model of the family, which knows shapes and no label."""
        meshes = [_without_labels(sample.mesh) for sample in self.samples]
        rows = zip(meshes, self.fine, strict=True)
        return SpanModel([AssetPieces(mesh, piece_mesh({mesh.hulls[0].body: own}, mesh)) for mesh, own in rows])

    @cached_property
    def cells(self) -> CellModel:
        """The same of hulls that stand for no surface."""
        return CellModel([AssetCells(_without_labels(sample.mesh)) for sample in self.samples])

    @property
    def unknown(self) -> Iterator[tuple[int, Sample]]:
        """The assets that nobody labelled, with their numbers."""
        return ((place, sample) for place, sample in enumerate(self.samples) if place not in self.known)

    def infer(self, labelled: str) -> SpanPosterior:
        """What follows for all assets from what a person labelled of the known ones, of `WAYS`."""
        labels: list[Label | None] = []
        of_pieces: list[Label | None] = []
        for place, (sample, pieces) in enumerate(zip(self.samples, self.pieces, strict=True)):
            known = place in self.known
            for hull, row in zip(sample.mesh.hulls, sample.shares, strict=True):
                told = known and (labelled != BY_PIECES or not is_spanning(row))
                labels.append(Label(hull.label) if told and hull.label else None)
            told_pieces = known and labelled == BY_PIECES
            of_pieces += map(Label, label_truly(pieces, sample.asset)) if told_pieces else [None] * len(pieces)
        return self.cells.infer(labels) if labelled == NO_SURFACE else self.model.infer(labels, of_pieces)


def open_family(category: str, setting: str, calibration: bool = False) -> SpanFamily:
    """A family with its fine pieces, which are made anew where the cache of decompositions has them not."""
    rows = list_samples(category, setting, calibration)
    return SpanFamily(rows, tuple(make_pieces(sample) for sample in rows), choose_known(len(rows)))


def choose_known(count: int) -> frozenset[int]:
    """The numbers of the labelled assets: one at random of each third of the family."""
    rng = np.random.default_rng(_SEED)
    return frozenset(int(rng.choice(third)) for third in np.array_split(np.arange(count), KNOWN))


def make_pieces(sample: Sample) -> tuple[FinePiece, ...]:
    """The fine pieces of the surface of an asset."""
    return decompose_finely(*surface_of(sample), cache=cache_folder())


def is_spanning(share: Mapping[str, float]) -> bool:
    """Whether no label has nine tenths of what of a hull is in parts."""
    return max(share.values()) < PURE


def label_truly(hulls: Sequence[Polytope], asset: Asset) -> list[str]:
    """The label that has the most of each hull."""
    return [next(iter(shares(hull, asset.parts, asset.pose))) for hull in hulls]


def split_hulls(sample: Sample, parts: Parts) -> Sample:
    """The mesh with its hulls split, all hulls with their true labels."""
    hulls: list[Hull] = []
    rows: list[Mapping[str, float]] = []
    for place, (hull, row) in enumerate(zip(sample.mesh.hulls, sample.shares, strict=True)):
        if place not in parts:
            hulls.append(hull)
            rows.append(row)
        for number, shape in enumerate(parts.get(place, ())):
            share = shares(shape, sample.asset.parts, sample.asset.pose)
            hulls.append(
                Hull(name_part(sample, place, number), hull.body, shape, Label(next(iter(share)), 1.0, "file"))
            )
            rows.append(share)
    return Sample(sample.name, sample.asset, sample.setting, SymbolicMesh(tuple(hulls)), tuple(rows))


def name_part(sample: Sample, hull: int, number: int) -> str:
    """What `split_hulls` calls a part of a hull."""
    return f"{sample.mesh.hulls[hull].name}_{number}"


def replace_hulls(sample: Sample, shapes: Sequence[Polytope]) -> Sample:
    """The mesh with other hulls in place of all of its own, with their true labels."""
    rows = [shares(shape, sample.asset.parts, sample.asset.pose) for shape in shapes]
    hulls = (
        Hull(f"hull_{number}", sample.mesh.hulls[0].body, shape, Label(next(iter(row)), 1.0, "file"))
        for number, (shape, row) in enumerate(zip(shapes, rows, strict=True))
    )
    return Sample(sample.name, sample.asset, sample.setting, SymbolicMesh(tuple(hulls)), tuple(rows))


def divide_truly(sample: Sample, pieces: Sequence[Polytope]) -> Parts:
    """The parts of the spanning hulls of an asset, by the true labels of its pieces."""
    labels = label_truly(pieces, sample.asset)
    chances = np.eye(len(set(labels)))[np.unique(labels, return_inverse=True)[1]]
    spanning = [place for place, row in enumerate(sample.shares) if is_spanning(row)]
    found = {place: divide(sample.mesh.hulls[place].shape, pieces, chances) for place in spanning}
    return {place: tuple(part.shape for part in some) for place, some in found.items() if len(some) > 1}


def _without_labels(mesh: SymbolicMesh) -> SymbolicMesh:
    return mesh.with_labels(dict.fromkeys(mesh.index))
