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
from meshforge.geometry import FinePiece, Polytope, cache_folder, decompose_finely
from meshforge.label_model import AssetPieces, SpanModel, SpanPosterior, piece_mesh
from meshforge.symbolic import Hull, Label, SymbolicMesh

KNOWN = 3
"""Assets of a family that a person labelled."""
BY_PIECES, BY_HULLS = "pieces", "hulls"
"""What a person labelled of these: the fine pieces and the pure hulls, or the hulls alone."""
LABELLED = (BY_PIECES, BY_HULLS)
_SEED = 28


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
    def assets(self) -> tuple[AssetPieces, ...]:
        """Each with its pieces and no label."""
        meshes = [_without_labels(sample.mesh) for sample in self.samples]
        rows = zip(meshes, self.fine, strict=True)
        return tuple(AssetPieces(mesh, piece_mesh({mesh.hulls[0].body: own}, mesh)) for mesh, own in rows)

    @property
    def unknown(self) -> Iterator[tuple[int, Sample]]:
        """The assets that nobody labelled, with their numbers."""
        return ((place, sample) for place, sample in enumerate(self.samples) if place not in self.known)

    def infer(self, place: int, labelled: str) -> SpanPosterior:
        """What follows for one asset, the first of the posterior, from what a person labelled of the known ones, of
        `LABELLED`: as the product looks at each asset beside the labelled ones alone."""
        chosen = [place, *sorted(self.known - {place})]
        rows = [self._label(one, labelled) for one in chosen]
        labels, of_pieces = ([label for row in rows for label in row[kind]] for kind in (0, 1))
        return SpanModel([self.assets[one] for one in chosen]).infer(labels, of_pieces)

    def _label(self, place: int, labelled: str) -> tuple[list[Label | None], list[Label | None]]:
        """The labels of the hulls and of the pieces of an asset."""
        sample, pieces = self.samples[place], self.pieces[place]
        if place not in self.known:
            return [None] * len(sample.mesh.hulls), [None] * len(pieces)
        by_pieces = labelled == BY_PIECES
        hulls = [
            Label(hull.label) if hull.label and not (by_pieces and is_spanning(row)) else None
            for hull, row in zip(sample.mesh.hulls, sample.shares, strict=True)
        ]
        return hulls, list(map(Label, label_truly(pieces, sample.asset))) if by_pieces else [None] * len(pieces)


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


def replace_hulls(sample: Sample, shapes: Sequence[Polytope]) -> Sample:
    """The mesh with other hulls in place of all of its own, with their true labels."""
    rows = [shares(shape, sample.asset.parts, sample.asset.pose) for shape in shapes]
    hulls = (
        Hull(f"hull_{number}", sample.mesh.hulls[0].body, shape, Label(next(iter(row)), 1.0, "file"))
        for number, (shape, row) in enumerate(zip(shapes, rows, strict=True))
    )
    return Sample(sample.name, sample.asset, sample.setting, SymbolicMesh(tuple(hulls)), tuple(rows))


def _without_labels(mesh: SymbolicMesh) -> SymbolicMesh:
    return mesh.with_labels(dict.fromkeys(mesh.index))
