"""Splits of hulls that span parts: the parts kept until a person is asked about them, and put in the hull's place."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from meshforge import batch
from meshforge.batch.preparation.record import free_names
from meshforge.common import ProjectError
from meshforge.formats import read
from meshforge.geometry import Polytope
from meshforge.labels.descriptor_cache import read_arrays, write_arrays
from meshforge.labels.hull_arrays import HULL_ARRAYS, pack_hulls, unpack_hulls
from meshforge.project.prepare import PreparationResult, exchange_preparation
from meshforge.store import SpanLine, Store, hull_digests
from meshforge.symbolic import Asset, Hull, Label, SymbolicMesh

LIKELY = 0.5
"""The probability from which a hull is named, and asked about."""
WENT_ELSEWHERE = "what it held went to hulls named after others"
"""Of a hull of a body that is rebuilt, in place of its parts."""
_FIND = "Find them again: meshforge prepare PROJECT --split-spanning --dry-run"


@dataclass(frozen=True, eq=False, slots=True)
class Split:
    """A hull that spans parts, or one that is made anew with its body, and what takes its place. shapes: the parts, in
    the order of `span.parts`."""

    hull: str
    span: SpanLine
    shapes: tuple[Polytope, ...]
    with_body: bool = False

    def __str__(self) -> str:
        """`base holds wall and handle, 94%: into 2 wall (97% to 98%), handle (93%)`."""
        parts = self.span.parts_told
        return f"{self.span.told}: {f'into {parts}' if parts else WENT_ELSEWHERE}"

    def divide(self, mesh: SymbolicMesh) -> tuple[SymbolicMesh, tuple[str, ...]]:
        """A mesh to look at, with the parts in the place of the hull, each with its label; and their names."""
        whole = mesh.hull_of(self.hull)
        names = free_names(self.hull, len(self.shapes), mesh.index)
        parts = [
            Hull(name, whole.body, shape, Label(part.label, part.share, "split"), self.hull)
            for name, shape, part in zip(names, self.shapes, self.span.parts, strict=True)
        ]
        others = (one for hull in mesh.hulls for one in (parts if hull is whole else [hull]))
        return mesh.with_hulls(others), tuple(names)


def write_splits(
    store: Store, asset: str, splits: Sequence[Split], settings: Mapping[str, Any], seen: str | None
) -> PreparationResult:
    """Split hulls of an asset in one step of its preparation, with labels that the project knows.

    settings: of the step, besides the probabilities; seen: the digest of the preparation that was looked at. Raises
    GeometryError: no such hull; ProjectError where someone else has prepared the asset meanwhile.
    """
    before = batch.read_preparation(store.layout.preparation(asset)) or batch.Preparation()
    after, made = make_splits(read(store.path(asset)), before, splits, settings)
    labels = {name: label for name, label in made.items() if label.name in store.vocabulary}
    notes = exchange_preparation(store, asset, after, seen, labels)
    return PreparationResult(asset, after.steps[-1].replaced, tuple(notes))


def make_splits(
    source: Asset, before: batch.Preparation, splits: Sequence[Split], settings: Mapping[str, Any]
) -> tuple[batch.Preparation, dict[str, Label]]:
    """A preparation with one step more, which splits hulls, and the label of each part by its name.

    source: the asset as it was read; settings: of the step, besides the probabilities. Raises GeometryError: no such
    hull.
    """
    divisions = [batch.HullDivision(one.hull, one.shapes, str(one), one.with_body) for one in splits]
    chances = {one.hull: one.span.chance for one in splits}
    after = batch.divide_hulls(source, before, divisions, {**settings, "chances": chances})
    labels = {
        name: Label(part.label, part.share, "split")
        for entry, one in zip(after.steps[-1].replaced, splits, strict=True)
        for name, part in zip(entry.made, one.span.parts, strict=True)
    }
    return after, labels


def keep_shapes(path: Path, spans: Mapping[str, SpanLine], shapes: Mapping[str, Sequence[Polytope]]) -> None:
    """Keep the parts of hulls of an asset, by name, as they were found."""
    write_arrays(path, _digest(spans), pack_hulls(shapes))


def find_split(store: Store, asset: str, hull: str) -> Split:
    """The split of a hull that likely spans parts, as was found last.

    Raises ProjectError where the hull is not as it was then, or no plane divides it.
    """
    span = store.spans().likely(asset, hull_digests(store.mesh(asset))).get(hull)
    if span is None:
        raise ProjectError(
            "nothing is known of parts of this hull as it is now", where=f"{asset}: {hull}", remedy=_FIND
        )
    if not span.parts:
        raise ProjectError("no plane divides this hull", where=f"{asset}: {hull}", remedy="Split it: meshforge split")
    kept = read_arrays(store.layout.span_parts(asset), _digest(store.last_spans().assets[asset]), *HULL_ARRAYS)
    shapes = tuple(unpack_hulls(*kept).get(hull, ())) if kept else ()
    if len(shapes) != len(span.parts):
        raise ProjectError("the parts of this hull are not kept any more", where=f"{asset}: {hull}", remedy=_FIND)
    return Split(hull, span, shapes)


def split_as_found(store: Store, asset: str, hull: str) -> PreparationResult:
    """Split one hull into the parts that were found last, as a step of the asset's preparation.

    Raises ProjectError as `find_split` does, and where someone else has prepared the asset meanwhile.
    """
    seen = batch.record_digest(store.layout.preparation(asset))
    split = find_split(store, asset, hull)
    return write_splits(store, asset, [split], {"asked": True, "pieces": split.span.pieces}, seen)


def mark_as_one_part(store: Store, asset: str, hull: str) -> None:
    """Keep that a hull is one part, as long as its geometry is the same. Raises ProjectError: no such hull."""
    digests = hull_digests(store.mesh(asset))
    if hull not in digests:
        raise ProjectError(f"there is no hull {hull!r}", where=asset)
    with store.lock():
        store.write_single_parts(store.single_parts().with_hull(asset, hull, digests[hull]))


def _digest(spans: Mapping[str, SpanLine]) -> str:
    """A digest of all that is said of the hulls of an asset, so that parts found at another time are not mixed up."""
    rows = {hull: span.model_dump(mode="json") for hull, span in spans.items()}
    return batch.text_digest(json.dumps(rows, sort_keys=True))
