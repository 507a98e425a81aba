"""The labelled assets of a project, against which assets are looked at that are not of it, or new in it: one at a time,
so that what is found of one does not depend on the others, nor on how many there are."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

from meshforge import batch
from meshforge.geometry import PieceEngine
from meshforge.label_model import AssetPieces, SpanModel, evidence_beside_rebuilt, model_family
from meshforge.label_model.describe import describe_mesh
from meshforge.labels.labeler import Stage
from meshforge.labels.spans import FinePieces, SpanReport, decompose_surfaces, find_pieces, is_given
from meshforge.store import Store
from meshforge.symbolic import CERTAIN_SOURCES, Asset, Label, LabelFile, SymbolicMesh, is_class_name

MOST_COMPARED = 32
"""Labelled assets that a new one is compared with: those with labels of people first, evenly chosen of more."""


@dataclass(frozen=True, eq=False)
class ReferenceFamily:
    """Assets of which hulls are labelled. meshes: as they are prepared, by id; pieces: with the fine pieces of their
    surfaces, by id; words: the project's vocabulary; engine: which makes the pieces; lost: why some are not known."""

    meshes: Mapping[str, SymbolicMesh]
    pieces: Mapping[str, AssetPieces]
    words: tuple[str, ...]
    engine: PieceEngine = "coacd"
    lost: Mapping[str, str] = field(default_factory=dict)

    def find_spans(self, source: Asset, mesh: SymbolicMesh) -> SpanReport:
        """Return which hulls of an asset that is not among these span parts; where a person or a file labelled all, its
        surface is not looked at.

        source: the asset as it was read; mesh: it as it is prepared, with its labels.
        """
        if all(map(is_given, mesh.hulls)):
            return SpanReport(mesh, None, FinePieces(mesh.with_hulls(())))
        found, notes = decompose_surfaces(source, self.engine)
        own = FinePieces.of(found, mesh, notes)
        if not own.mesh.hulls:
            return SpanReport(mesh, None, own)
        assets = [AssetPieces(mesh, own.mesh), *self.pieces.values()]
        labels = [evidence_beside_rebuilt(hull.annotation) for one in assets for hull in one.mesh.hulls]
        return SpanReport(mesh, SpanModel(assets).infer(labels), own)

    def without(self, asset: str) -> "ReferenceFamily":
        """Return the family without one of its assets, to which that is to be compared."""
        if asset not in self.meshes:
            return self
        meshes = {name: mesh for name, mesh in self.meshes.items() if name != asset}
        return replace(self, meshes=meshes, pieces={n: one for n, one in self.pieces.items() if n != asset})

    def infer_labels(self, mesh: SymbolicMesh) -> dict[str, Label]:
        """Return the likeliest label of each hull of an asset that has none, by its name, with its probability; where
        parts have no names, its class."""
        meshes = [mesh, *self.meshes.values()]
        known = (evidence_beside_rebuilt(hull.annotation) for own in meshes for hull in own.hulls)
        heard = [one if one and (one.name in self.words or is_class_name(one.name)) else None for one in known]
        rows = zip(mesh.hulls, model_family(meshes).infer(heard).labels(0), strict=True)
        guesses = {hull.name: label for hull, label in rows if label and not hull.annotation}
        return {n: replace(one, source="class") if is_class_name(one.name) else one for n, one in guesses.items()}


def read_reference_family(
    store: Store,
    execution: batch.ExecutionOptions,
    stage: Stage,
    engine: PieceEngine = "coacd",
    *,
    without: Collection[str] = (),
    spans: bool = True,
) -> ReferenceFamily | None:
    """Return the labelled assets of a project; None where no hull has a label that was not inferred.

    engine: which makes the fine pieces of surfaces; without: assets that do not count; spans: whether their surfaces
    are needed. Raises AssetError where a labels file cannot be read.
    """
    chosen = choose_labelled(
        {asset: store.labels_and_classes(asset) for asset in store.assets() if asset not in set(without)}
    )
    meshes = {
        asset: mesh
        for asset, mesh in store.meshes_by_id(chosen)
        if any(evidence_beside_rebuilt(hull.annotation) for hull in mesh.hulls)
    }
    if not meshes:
        return None
    found, lost = find_pieces(store, meshes, execution, stage, engine) if spans else ({}, {})
    pieces = {asset: AssetPieces(meshes[asset], own.mesh) for asset, own in found.items()}
    for one in pieces.values():
        assert one.common is not None  # measured here, so that no worker does it again; likewise below
    for mesh in (*meshes.values(), *(mesh for own in pieces.values() for mesh in (own.pieces, own.regions))):
        describe_mesh(mesh)
    return ReferenceFamily(meshes, pieces, store.vocabulary, engine, lost)


Item = TypeVar("Item")


def pick_evenly(items: Sequence[Item], most: int) -> Sequence[Item]:
    """Return the items in their order; of more than `most` so many, the first among them."""
    return [items[place * len(items) // most] for place in range(most)] if len(items) > most else items


def choose_labelled(files: Mapping[str, LabelFile], most: int = MOST_COMPARED) -> list[str]:
    """Return the assets that new ones are compared with, in the order of the project."""
    observed = {
        asset: [label for own in file.labels.values() if (label := evidence_beside_rebuilt(own))]
        for asset, file in files.items()
    }
    by_people = [asset for asset, labels in observed.items() if any(one.source in CERTAIN_SOURCES for one in labels)]
    others = [asset for asset, labels in observed.items() if labels and asset not in set(by_people)]
    chosen = {*pick_evenly(by_people, most)}
    chosen |= {*pick_evenly(others, most - len(chosen))}
    return [asset for asset in files if asset in chosen]
