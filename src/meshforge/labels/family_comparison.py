"""All hulls of a project compared, and what labels of some say about the others, in worker processes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshforge import label_model, symbolic
from meshforge.batch import ExecutionOptions, WorkerFailure, raise_if_stopped, run_isolated
from meshforge.common import AssetError, MeshForgeError, ProjectError, quote_path
from meshforge.geometry import Floats, Ints
from meshforge.label_model.describe import ROW_WIDTH
from meshforge.labels.descriptor_cache import DescriptorCache
from meshforge.labels.labeler import LabelFamily
from meshforge.labels.merge import infer_over
from meshforge.labels.summary import label_command
from meshforge.store import AssetFacts, iterate_asset_index
from meshforge.symbolic import Label

HullLabels = Mapping[str, Label]
"""Labels by hull."""
DescribedAsset = tuple[Floats, Ints, Sequence[Label | None]]
"""An asset of another family: `rows` and `touching` of its `ShapeDescriptor`, and the label of each hull."""


@dataclass(frozen=True, eq=False)
class FamilyComparison:
    """What labels say about the hulls of all assets.

    hulls: digests by name, in order, of each asset that could be read; current: their labels; lost: why others are not
    compared; assets: those that were described, in order; observed: what speaks of each of their hulls, then of those
    of other families.
    """

    hulls: Mapping[str, Mapping[str, str]]
    current: Mapping[str, HullLabels]
    lost: Mapping[str, str]
    assets: tuple[str, ...]
    observed: tuple[Label | None, ...]
    found: label_model.FamilyPosterior

    @cached_property
    def next(self) -> str | None:
        """The asset that would help most if it were labelled; None: all are."""
        return next((self.assets[place] for place in self.found.next_to_label(below=len(self.assets))), None)

    def share_out(self, labels: Sequence[Label | None]) -> Iterator[tuple[str, dict[str, Label]]]:
        """Yield each asset that is not lost, with its share of labels of all hulls."""
        for place, asset in enumerate(self.assets):
            own = labels[self.found.table.spans.get(place, slice(0, 0))]
            rows, current = zip(self.hulls[asset], own, strict=True), self.current[asset]
            if asset not in self.lost:
                yield asset, {name: infer_over(current.get(name), label) for name, label in rows if label}


@dataclass(frozen=True, eq=False)
class FamilyDescription:
    """The hulls of all assets, not yet compared. hulls, current, lost: as in `FamilyComparison`; rows: `rows` and
    `touching` of the assets that were described, in order."""

    hulls: Mapping[str, Mapping[str, str]]
    current: Mapping[str, HullLabels]
    lost: dict[str, str]
    rows: Mapping[str, tuple[Floats, Ints]]
    describer: _Describer


def describe_assets(family: LabelFamily) -> FamilyDescription:
    """Describe the hulls of all assets that can be read."""
    store = family.store
    with family.stage(len(store.assets()), "reading") as advance:
        facts = dict(iterate_asset_index(store.found, store.layout, execution=family.execution, progress=advance))
    lost = {asset: own.error for asset, own in facts.items() if own.error}
    current = dict[str, HullLabels]()
    for asset, own in facts.items():
        try:
            current |= (
                {asset: symbolic.match_labels(store.labels(asset), own.hulls).labels} if asset not in lost else {}
            )
        except AssetError as error:
            lost[asset] = error.message
    hulls = {asset: facts[asset].hulls for asset in current}
    describer = _Describer(family, {asset: facts[asset] for asset in current}, lost)
    del facts
    return FamilyDescription(hulls, current, lost, describer.describe(list(current)), describer)


def compare_assets(
    family: LabelFamily,
    speak: Callable[[str, HullLabels], HullLabels],
    beside: Sequence[DescribedAsset] = (),
    described: FamilyDescription | None = None,
) -> FamilyComparison:
    """Compare the hulls of all assets that can be read.

    speak: what speaks for hulls of an asset, given it and the labels that they have; words outside of the vocabulary
    say nothing. beside: assets of other families, all whose labels speak; described: the assets, if they are already.
    Raises ProjectError: no vocabulary, or nothing is said at all.
    """
    store, vocabulary, known = family.store, family.vocabulary, described or describe_assets(family)
    hulls, current, lost, assets = known.hulls, known.current, known.lost, tuple(known.rows)
    evidence = {asset: speak(asset, labels) for asset, labels in current.items()}
    if any(evidence.values()):
        family.require_vocabulary()
    table = label_model.FamilyTable.of([*known.rows.values(), *((rows, touching) for rows, touching, _ in beside)])
    words = {*vocabulary, symbolic.NO_PART}
    spoken = (evidence[asset].get(name) for asset in assets for name in hulls[asset])
    observed = tuple(label if label and label.name in words else None for label in spoken)
    observed += tuple(label for _, _, labels in beside for label in labels)
    seen = label_model.Observations.of(observed)
    describer = known.describer
    del known, described, evidence  # a quarter of a GiB of ten thousand assets
    table = describer.set_upright(assets, table, seen)
    compared = FamilyComparison(
        hulls, current, lost, assets, observed, _compute_isolated(table, seen, family.execution.stop)
    )
    if not compared.found.seen.labels:
        best, remedy = compared.next, "Decompose the assets first." if any(current) else _describe_lost(lost)
        if best:
            command = label_command(store.folder, best, next(iter(hulls[best])), vocabulary)
            show_it = f"meshforge demonstrate {quote_path(store.folder)} ASSET 'HULLS => ACTION' ..."
            remedy = f"Label the hulls of one asset first, best {best}. In the studio, or: {command}"
            remedy += f"\n  Or show the steps, without names: {show_it}"
        raise ProjectError("there is no label that others could be taken from", where=str(store.folder), remedy=remedy)
    return compared


def _describe_lost(lost: Mapping[str, str]) -> str:
    return f"No asset can be read; the first problem: {next(iter(lost.values()))}" if lost else "There is no asset."


class _Describer:
    """Describes assets, and looks at other sides of those that may have fallen; why some cannot be goes to `lost`."""

    def __init__(self, family: LabelFamily, facts: Mapping[str, AssetFacts], lost: dict[str, str]) -> None:
        self._cache = DescriptorCache(family.store, facts, family.execution)
        self._lost, self._stop, self._stage = lost, family.execution.stop, family.stage
        self._sizes = {asset: len(own.hulls) for asset, own in facts.items()}

    def describe(self, assets: Sequence[str]) -> dict[str, tuple[Floats, Ints]]:
        room, used = np.empty((sum(self._sizes[asset] for asset in assets), ROW_WIDTH)), 0

        def read(asset: str) -> tuple[Floats, Ints] | None:
            """In one block of memory, for thousands of small ones would not go back to the system."""
            nonlocal used
            if not (found := self._cache.read_rows(asset)):
                return None
            rows = room[used : (used := used + len(found[0]))]
            rows[:] = found[0]
            return rows, found[1]

        seen = {asset: read(asset) for asset in assets}
        missing = [asset for asset, own in seen.items() if own is None]
        with self._stage(len(missing), "describing") as advance:
            self._lost |= dict(self._cache.describe(missing, advance))
        seen |= {asset: read(asset) for asset in missing}
        described = {asset: own for asset, own in seen.items() if own}
        gone = [asset for asset in missing if asset not in described | self._lost]
        self._lost |= {asset: f"{asset}: how it is described was not kept" for asset in gone}
        return described

    def set_upright(
        self, assets: Sequence[str], table: label_model.FamilyTable, observed: label_model.Observations
    ) -> label_model.FamilyTable:
        doubtful, own = dict[str, tuple[int, tuple[int, ...]]](), len(assets)
        for place, sides in label_model.find_doubtful_sides(
            table, observed, lambda k: self._cache.read_sides(assets[k]) if k < own else table.rows[:0, None]
        ):
            raise_if_stopped(self._stop)
            if sides:
                doubtful[assets[place]] = place, sides
        closer = dict[int, list[Floats]]()
        with self._stage(len(doubtful), "looking at other sides") as advance:
            wanted = [(asset, sides) for asset, (_, sides) in doubtful.items()]
            for asset, rows in self._cache.describe_sides(wanted, advance):
                if isinstance(rows, str):
                    self._lost[asset] = rows
                else:
                    closer[doubtful[asset][0]] = rows
        return label_model.correct_upright(table, observed, closer)


def _compute_isolated(
    table: label_model.FamilyTable, observed: label_model.Observations, stop: Callable[[], bool] | None
) -> label_model.FamilyPosterior:
    """What labels say, in a process of its own where that may have to be stopped in the midst."""
    (found,) = run_isolated(_compute, [(table, observed)], ExecutionOptions(1 if stop else 0, None, stop=stop))
    if isinstance(found, WorkerFailure):
        raise MeshForgeError(f"what labels say could not be computed: {found.why}")
    return label_model.FamilyPosterior(table, observed, *found)


def _compute(work: tuple[label_model.FamilyTable, label_model.Observations]) -> tuple[Floats, Floats]:
    """Only what is new goes back to the process that asks."""
    found = label_model.FamilyPosterior.of(*work)
    return found.chances, found.by_others
