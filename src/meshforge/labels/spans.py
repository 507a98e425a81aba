"""Which hulls of a project span parts, by the surface that they stand for, or by look-alikes where there is none, and
the labels that are known."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from types import MappingProxyType

import numpy as np

from meshforge import batch
from meshforge.common import MeshForgeError, ProjectError, describe_error, format_share, join_and
from meshforge.formats import VisualSurfaces, read
from meshforge.geometry import FinePiece, Floats, HullPart, PieceEngine, cache_folder, decompose_finely
from meshforge.label_model import (
    AssetCells,
    AssetPieces,
    CellModel,
    SpanModel,
    SpanPosterior,
    SurfacePieces,
    evidence_beside_splits,
    piece_mesh,
)
from meshforge.labels.family_comparison import Stage
from meshforge.store import Store
from meshforge.symbolic import HUMAN_SOURCES, Asset, SymbolicMesh

_ALIKE = 20.0  # a surface larger or smaller than its hulls by this factor is in another unit
_TINY = 1e-300
_SHOWN = 0.1  # of what a hull stands for: labels of smaller shares are not named


LabelledPart = tuple[HullPart, str, float]
"""A part of a hull, its likeliest label, and the share of that in what it stands for."""


@dataclass(frozen=True, eq=False)
class HullSpan:
    """A hull of an asset that may span parts. chance: of that; shares: of each label in what it stands for, the largest
    first; by_surface: whether a surface says so, or only likeness."""

    hull: str
    chance: float
    shares: Mapping[str, float]
    by_surface: bool = True

    def __str__(self) -> str:
        """`base holds wall and handle, 94%`; without a surface `base holds wall and handle, by likeness, 64%`."""
        how = "" if self.by_surface else ", by likeness"
        return f"{self.hull} holds {join_and(self.labels)}{how}, {format_share(self.chance)}"

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels of at least a tenth of what it stands for, at least two, that of the largest share first."""
        count = sum(share >= _SHOWN for share in self.shares.values())
        return tuple(self.shares)[: max(count, 2)]


@dataclass(frozen=True, eq=False)
class SpanReport:
    """What was found. meshes: the assets that were looked at, as they are prepared; lost: why others were not;

    by_surface, by_cells: what is known of hulls that stand for a surface, and of others; None where no hull is such;
    unseen: the bodies, by asset, that have no surface; engine: which made the fine pieces; notes: by asset, on surfaces
    that could not be used.
    """

    meshes: Mapping[str, SymbolicMesh]
    by_surface: SpanPosterior | None
    by_cells: SpanPosterior | None
    unseen: Mapping[str, frozenset[str]]
    lost: Mapping[str, str]
    engine: PieceEngine = "coacd"
    notes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    @cached_property
    def bare(self) -> Mapping[str, tuple[str, ...]]:
        """Hulls, by asset, that stand for nothing of their body's surface, and of which nothing can be said."""
        found = dict[str, tuple[str, ...]]()
        for place, (asset, mesh) in enumerate(self.meshes.items()):
            held = self.by_surface.assets[place].common.sum(axis=1) if self.by_surface else np.zeros(len(mesh.hulls))
            rows = zip(mesh.hulls, held.tolist(), strict=True)
            names = tuple(hull.name for hull, own in rows if not own > 0 and hull.body not in self.unseen[asset])
            if names:
                found[asset] = names
        return found

    @cached_property
    def _places(self) -> dict[str, int]:
        return {asset: place for place, asset in enumerate(self.meshes)}

    def spans_of(self, asset: str) -> list[HullSpan]:
        """Each hull of an asset that stands for something, in order."""
        found = dict[str, HullSpan]()
        for posterior, unseen in ((self.by_surface, False), (self.by_cells, True)):
            if posterior:
                found.update((span.hull, span) for span in self._list_spans(asset, posterior, unseen))
        return [found[hull.name] for hull in self.meshes[asset].hulls if hull.name in found]

    def divide(self, asset: str, hull: str) -> list[LabelledPart]:
        """The parts of a hull, each with its likeliest label and the share of that in what it stands for."""
        place = self.meshes[asset].index[hull]
        posterior = self.by_cells if self.meshes[asset].hulls[place].body in self.unseen[asset] else self.by_surface
        assert posterior, f"{hull} of {asset} stands for nothing"
        parts = posterior.divide(self._places[asset], place)
        return [(part, posterior.labels[part.kind], float(part.shares[part.kind])) for part in parts]

    def rebuild(self, asset: str, body: str) -> dict[str, list[LabelledPart]]:
        """New hulls for all of a body that stand for its surface, each of one label, by the old hull that has most of
        it; nothing where the body has no surface."""
        mesh, bare = self.meshes[asset], set(self.bare.get(asset, ()))
        own = [k for k, hull in enumerate(mesh.hulls) if hull.body == body and hull.name not in bare]
        if self.by_surface is None or body in self.unseen[asset]:
            return {}
        found: dict[str, list[LabelledPart]] = {mesh.hulls[k].name: [] for k in own}
        for place, part in self.by_surface.rebuild(self._places[asset], np.array(own, dtype=np.int64)):
            label = self.by_surface.labels[part.kind]
            found[mesh.hulls[place].name].append((part, label, float(part.shares[part.kind])))
        return found if any(found.values()) else {}

    def _list_spans(self, asset: str, posterior: SpanPosterior, unseen: bool) -> Iterator[HullSpan]:
        place, mesh = self._places[asset], self.meshes[asset]
        bare = set(self.bare.get(asset, ()))
        rows = zip(mesh.hulls, posterior.chances_of(place).tolist(), posterior.shares_of(place), strict=True)
        for hull, chance, shares in rows:
            if hull.name in bare or (hull.body in self.unseen[asset]) != unseen:
                continue
            if not (unseen and hull.source in HUMAN_SOURCES):  # likeness does not outweigh what a person called it
                yield HullSpan(hull.name, chance, _name_shares(posterior.labels, shares), not unseen)


def _name_shares(labels: Sequence[str], shares: Floats) -> dict[str, float]:
    rows = sorted(zip(labels, shares.tolist(), strict=True), key=lambda row: (-row[1], row[0]))
    return {label: share for label, share in rows if share > 0}


@dataclass(frozen=True, eq=False, slots=True)
class FinePieces:
    """The fine pieces of the surfaces of an asset, as a mesh that lies as its own does; unseen: the bodies with hulls
    that have no surface; notes: on surfaces that could not be used."""

    mesh: SymbolicMesh
    unseen: frozenset[str] = frozenset()
    notes: tuple[str, ...] = ()

    @staticmethod
    def of(found: SurfacePieces, mesh: SymbolicMesh, notes: Iterable[str] = ()) -> FinePieces:
        """Those found by body, of all bodies that have a surface; one of quite another size than its hulls says nothing
        of them, and does not count."""
        told, kept = list(notes), dict(found)
        for body, pieces in found.items():
            hulls = [hull.vertices for hull in mesh.hulls if hull.body == body]
            if not hulls or not pieces:
                continue
            ratio = _diagonal([piece.shape.vertices for piece in pieces]) / max(_diagonal(hulls), _TINY)
            if not 1 / _ALIKE < ratio < _ALIKE:
                told.append(
                    f"{body}: its surface is {ratio:.3g} times the size of its hulls (another unit?): it does not count"
                )
                del kept[body]
        return FinePieces(piece_mesh(kept, mesh), frozenset(hull.body for hull in mesh.hulls) - kept.keys(), (*told,))


def _diagonal(points: Sequence[Floats]) -> float:
    """That of the box around all [m]."""
    return float(np.linalg.norm(np.ptp(np.concatenate(points), axis=0)))


@dataclass(frozen=True, slots=True)
class _Work:
    """One asset whose surface is decomposed finely; engine: which makes the pieces."""

    path: Path
    engine: PieceEngine


def find_spans(
    store: Store, execution: batch.ExecutionOptions, stage: Stage, engine: PieceEngine = "coacd"
) -> SpanReport:
    """Which hulls span parts, of all assets that can be read. engine: which makes the fine pieces of their surfaces.

    Raises ProjectError where no hull has a label: nothing says what parts there are; and where no asset can be read.
    """
    meshes = dict(store.meshes_by_id())
    if not any(evidence_beside_splits(hull.annotation) for mesh in meshes.values() for hull in mesh.hulls):
        remedy = "Label the hulls of one or two assets first: meshforge label, or the studio."
        raise ProjectError(
            "no hull has a label, so nothing says what parts there are", where=str(store.folder), remedy=remedy
        )
    pieces, lost = find_pieces(store, meshes, execution, stage, engine)
    if not pieces:
        remedy = next(iter(lost.values()), "Give the project assets that can be read: meshforge add.")
        raise ProjectError("no asset can be read", where=str(store.folder), remedy=remedy)
    return replace(infer_spans({asset: meshes[asset] for asset in pieces}, pieces, lost), engine=engine)


def find_pieces(
    store: Store,
    meshes: Mapping[str, SymbolicMesh],
    execution: batch.ExecutionOptions,
    stage: Stage,
    engine: PieceEngine = "coacd",
) -> tuple[dict[str, FinePieces], dict[str, str]]:
    """The fine pieces of the surfaces of assets, by id, and why those of others are not known."""
    work = [_Work(store.path(asset), engine) for asset in meshes]
    pieces, lost = dict[str, FinePieces](), dict[str, str]()
    with stage(len(work), "decomposing finely") as advance:
        options = batch.ExecutionOptions(execution.workers, execution.timeout, progress=advance, stop=execution.stop)
        for asset, found in zip(meshes, batch.run_isolated(_find_pieces, work, options), strict=True):
            if isinstance(found, batch.WorkerFailure | str):
                lost[asset] = found if isinstance(found, str) else found.why
            else:
                pieces[asset] = FinePieces.of(found[0], meshes[asset], found[1])
    return pieces, lost


def infer_spans(
    known: Mapping[str, SymbolicMesh],
    pieces: Mapping[str, FinePieces],
    lost: Mapping[str, str],
    measured: Mapping[str, AssetPieces] = MappingProxyType({}),
    cells: Mapping[str, AssetCells] = MappingProxyType({}),
) -> SpanReport:
    """What labels say about hulls that span parts.

    known, pieces: assets with their labels, and the fine pieces of their surfaces, by the same names; lost: why others
    are not among them; measured, cells: what is known of the pieces and cells of some, which is not measured again.
    """
    said = [evidence_beside_splits(hull.annotation) for mesh in known.values() for hull in mesh.hulls]
    by_surface: SpanPosterior | None = None
    by_cells: SpanPosterior | None = None
    if any(own.mesh.hulls for own in pieces.values()):
        assets = [measured.get(asset) or AssetPieces(mesh, pieces[asset].mesh) for asset, mesh in known.items()]
        by_surface = SpanModel(assets).infer(said)
    if any(own.unseen for own in pieces.values()):
        by_cells = CellModel([cells.get(asset) or AssetCells(mesh) for asset, mesh in known.items()]).infer(said)
    unseen = {asset: own.unseen for asset, own in pieces.items()}
    notes = {asset: own.notes for asset, own in pieces.items()}
    return SpanReport(known, by_surface, by_cells, unseen, lost, notes=notes)


def _find_pieces(work: _Work) -> tuple[SurfacePieces, list[str]] | str:
    """The fine pieces of an asset by body, with notes, or why there are none."""
    try:
        return decompose_surfaces(read(work.path), work.engine)
    except Exception as error:  # one asset never stops the others
        return describe_error(error, str(work.path))


def decompose_surfaces(source: Asset, engine: PieceEngine = "coacd") -> tuple[SurfacePieces, list[str]]:
    """The fine pieces of the surfaces of an asset by body, as it was read; and notes on what it shows that cannot be
    read."""
    found = dict[str, Sequence[FinePiece]]()
    for body, surface in batch.find_surfaces(source).items():
        try:
            found[body] = decompose_finely(surface.vertices, surface.faces, engine, cache=cache_folder())
        except MeshForgeError:  # flat, or without an area: its hulls stand for nothing
            found[body] = []
    absent = source.visuals.explain_absent() if isinstance(source.visuals, VisualSurfaces) else []
    notes = [f"what {body} shows there does not count: {why}" for body, why in absent]
    notes += [f"what {name} shows does not count: there is no such file" for name in source.missing]
    return found, notes
