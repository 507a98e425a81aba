"""All hulls of a project compared, and what labels of some say about the others: described in worker processes, to be
stopped at any time."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from functools import cached_property

from meshforge import label_model, symbolic
from meshforge.batch import ExecutionOptions, WorkerFailure, raise_if_stopped, run_isolated
from meshforge.common import AssetError, MeshForgeError, ProjectError
from meshforge.geometry import Floats, Ints
from meshforge.labels.by_hand import label_command
from meshforge.labels.descriptor_cache import DescriptorCache
from meshforge.labels.merge import infer_over
from meshforge.store import Store, iterate_asset_index
from meshforge.symbolic import Label

HullLabels = Mapping[str, Label]
"""Labels by hull."""

Stage = Callable[[int, str], AbstractContextManager[Callable[[], None]]]
"""Given how many assets a part of the work is about and what it is called, what is entered meanwhile: that gives the
function that counts one more."""

WriteBlock = Callable[[str | None], AbstractContextManager[object]]
"""The block in which labels are written, when all is known; given the asset that would help most."""


@contextmanager
def ignore_stage(total: int, what: str) -> Iterator[Callable[[], None]]:
    """A stage that reports nothing."""
    yield lambda: None


@dataclass(frozen=True, eq=False)
class FamilyComparison:
    """What labels say about the hulls of all assets.

    hulls: digests by name, in order, of each asset that could be read; current: their labels; lost: why others are not
    compared; assets: those that were described, in order; said: what speaks of each of their hulls.
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
        return next((self.assets[place] for place in self.found.next_to_label()), None)

    def share_out(self, labels: Sequence[Label | None]) -> Iterator[tuple[str, dict[str, Label]]]:
        """Each asset that is not lost, with its share of labels of all hulls."""
        for place, asset in enumerate(self.assets):
            own = labels[self.found.table.spans.get(place, slice(0, 0))]
            rows, current = zip(self.hulls[asset], own, strict=True), self.current[asset]
            if asset not in self.lost:
                yield asset, {name: infer_over(current.get(name), label) for name, label in rows if label}


def compare_assets(
    store: Store,
    vocabulary: Sequence[str],
    speak: Callable[[Label | None], Label | None],
    execution: ExecutionOptions,
    stage: Stage,
) -> FamilyComparison:
    """Compare the hulls of all assets that can be read.

    speak: what the label of a hull, or none, says to others; words outside of the vocabulary say nothing.
    Raises ProjectError: no vocabulary, or nothing is said at all.
    """
    with stage(len(store.assets()), "reading") as advance:
        facts = dict(iterate_asset_index(store.found, store.layout, execution=execution, progress=advance))
    lost = {asset: own.error for asset, own in facts.items() if own.error}
    current = dict[str, HullLabels]()
    for asset, own in facts.items():
        try:
            current |= (
                {asset: symbolic.match_labels(store.labels(asset), own.hulls).labels} if asset not in lost else {}
            )
        except AssetError as error:
            lost[asset] = error.message
    if not vocabulary and any(current.values()):
        remedy = "Say first what hulls can be: --vocabulary a,b,c."
        raise ProjectError("the vocabulary is empty", where=str(store.folder), remedy=remedy)
    hulls = {asset: facts[asset].hulls for asset in current}
    cache = DescriptorCache(store, {asset: facts[asset] for asset in current}, execution)
    del facts
    described = _describe(cache, list(current), lost, stage)
    assets, table = tuple(described), label_model.FamilyTable.of([*described.values()])
    del described
    spoken = (speak(current[asset].get(name)) for asset in assets for name in hulls[asset])
    observed = tuple(label if label and label.name in vocabulary else None for label in spoken)
    seen = label_model.Observations.of(observed)
    table = _set_upright(cache, assets, table, seen, lost, execution.stop, stage)
    compared = FamilyComparison(hulls, current, lost, assets, observed, _compute_isolated(table, seen, execution.stop))
    if not compared.found.seen.labels:
        best, remedy = compared.next, "Decompose the assets first." if any(current) else _describe_lost(lost)
        if best:
            command = label_command(store.folder, best, next(iter(hulls[best])), vocabulary)
            remedy = f"Label the hulls of one asset first, best {best}. In the studio, or: {command}"
        raise ProjectError("there is no label that others could be taken from", where=str(store.folder), remedy=remedy)
    return compared


def _describe_lost(lost: Mapping[str, str]) -> str:
    return f"No asset can be read; the first problem: {next(iter(lost.values()))}" if lost else "There is no asset."


def _describe(
    cache: DescriptorCache, assets: Sequence[str], lost: dict[str, str], stage: Stage
) -> dict[str, tuple[Floats, Ints]]:
    """Rows and contacts of each asset that can be described; why others cannot goes to `lost`."""
    seen = {asset: cache.read_rows(asset) for asset in assets}
    missing = [asset for asset, own in seen.items() if own is None]
    with stage(len(missing), "describing") as advance:
        lost |= dict(cache.describe(missing, advance))
    seen |= {asset: cache.read_rows(asset) for asset in missing}
    described = {asset: own for asset, own in seen.items() if own}
    lost |= {asset: f"{asset}: how it is described was not kept" for asset in missing if asset not in described | lost}
    return described


def _set_upright(
    cache: DescriptorCache,
    assets: Sequence[str],
    table: label_model.FamilyTable,
    observed: label_model.Observations,
    lost: dict[str, str],
    stop: Callable[[], bool] | None,
    stage: Stage,
) -> label_model.FamilyTable:
    """The table with fallen assets set upright; why some could not be looked at goes to `lost`."""
    doubtful = list(_find_doubtful(table, observed, assets, cache, stop))
    with stage(len(doubtful), "looking at other sides") as advance:
        places = {asset: place for place, asset in enumerate(assets)}
        sides = _collect_sides(cache.describe_sides(doubtful, advance), places, lost)
        return label_model.correct_upright(table, observed, sides)


def _find_doubtful(
    table: label_model.FamilyTable,
    observed: label_model.Observations,
    assets: Sequence[str],
    cache: DescriptorCache,
    stop: Callable[[], bool] | None,
) -> Iterator[tuple[str, tuple[int, ...]]]:
    for place, sides in label_model.find_doubtful_sides(table, observed, lambda place: cache.read_sides(assets[place])):
        raise_if_stopped(stop)
        if sides:
            yield assets[place], sides


def _collect_sides(
    found: Iterable[tuple[str, list[Floats] | str]], places: Mapping[str, int], lost: dict[str, str]
) -> Iterator[tuple[int, list[Floats]]]:
    """What was found of each asset, by its place; why that of some was not found goes to `lost`."""
    for asset, rows in found:
        if isinstance(rows, str):
            lost[asset] = rows
        else:
            yield places[asset], rows


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
