"""Labels of a few assets propagated to all others of a project, taken or only proposed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from functools import cached_property

from meshforge.batch import ExecutionOptions, WorkerFailure, raise_if_stopped, run_isolated
from meshforge.common import AssetError, MeshForgeError, ProjectError
from meshforge.geometry import Floats
from meshforge.label_model import (
    FamilyPosterior,
    FamilyTable,
    Observations,
    correct_upright,
    find_doubtful_sides,
    reference_label,
)
from meshforge.labels.descriptor_cache import DescriptorCache
from meshforge.labels.merge import LabelOutcome, LabelWriter, OutcomeCallback, can_replace_less_certain, infer_over
from meshforge.labels.summary import LabelEvidence, Proposals, group_evidence
from meshforge.store import AssetFacts, Store, survey
from meshforge.symbolic import Label, LabelFile, match_labels

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
    """What labels say about all hulls. assets: those that were described, in order; lost: why others were not."""

    assets: tuple[str, ...]
    found: FamilyPosterior
    lost: dict[str, str]

    @property
    def has_labels(self) -> bool:
        """Whether there is any label to go by."""
        return bool(self.found.seen.labels)

    @cached_property
    def next(self) -> str | None:
        """The asset that would help most if it were labelled; None: all are."""
        return next((self.assets[place] for place in self.found.next_to_label()), None)

    def labels(self, asset: str) -> list[Label | None]:
        """The labels of the hulls of an asset."""
        return self.found.labels(self._places[asset])

    @cached_property
    def _places(self) -> dict[str, int]:
        return {asset: place for place, asset in enumerate(self.assets)}


def compare_family(
    cache: DescriptorCache, known: Mapping[str, Sequence[Label | None]], execution: ExecutionOptions, stage: Stage
) -> FamilyComparison:
    """Compare all hulls. known: of each asset what is said of its hulls, None where nothing is."""
    seen = {asset: cache.read_rows(asset) for asset in known}
    missing = [asset for asset, own in seen.items() if own is None]
    with stage(len(missing), "describing") as advance:
        lost = dict(cache.describe(missing, advance))
    seen |= {asset: cache.read_rows(asset) for asset in missing}
    described = {asset: own for asset, own in seen.items() if own}
    lost |= {asset: f"{asset}: how it is described was not kept" for asset in missing if asset not in described | lost}
    assets = tuple(described)
    table = FamilyTable.of([*described.values()])
    said = Observations.of([label for asset in assets for label in known[asset]])
    del seen, described
    doubtful = list(_find_doubtful(table, said, assets, cache, execution.stop))
    with stage(len(doubtful), "looking at other sides") as advance:
        places = {asset: place for place, asset in enumerate(assets)}
        sides = _collect_sides(cache.describe_sides(doubtful, advance), places, lost)
        table = correct_upright(table, said.given, sides)
    return FamilyComparison(assets, _compute_isolated(table, said, execution.stop), lost)


def _find_doubtful(
    table: FamilyTable,
    said: Observations,
    assets: Sequence[str],
    cache: DescriptorCache,
    stop: Callable[[], bool] | None,
) -> Iterator[tuple[str, tuple[int, ...]]]:
    """The assets that may lie on another side, and on which."""
    for place, sides in find_doubtful_sides(table, said.given, lambda place: cache.read_sides(assets[place])):
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


def _compute_isolated(table: FamilyTable, said: Observations, stop: Callable[[], bool] | None) -> FamilyPosterior:
    """What labels say, in a process of its own where that may have to be stopped in the midst."""
    (found,) = run_isolated(_compute, [(table, said)], ExecutionOptions(1 if stop else 0, None, stop=stop))
    if isinstance(found, WorkerFailure):
        raise MeshForgeError(f"the labels could not be propagated: {found.why}")
    return found


def _compute(work: tuple[FamilyTable, Observations]) -> FamilyPosterior:
    return FamilyPosterior.of(*work)


@dataclass(frozen=True, slots=True)
class PropagationResult:
    """What became of each asset, and which one would help most if it were labelled next; None: all are."""

    reports: tuple[LabelOutcome, ...]
    next: str | None


def propagate_labels(
    store: Store,
    execution: ExecutionOptions,
    stage: Stage,
    report: OutcomeCallback,
    write_block: WriteBlock = nullcontext,
) -> PropagationResult:
    """Give labels to hulls that have none, or a less certain one of a machine; see `LabelStore.propagate_labels`."""
    findings = _compare_assets(store, store.vocabulary, execution, stage)
    writer, reports = LabelWriter(store), list[LabelOutcome]()
    with write_block(findings.next), stage(len(store.assets()), "labelling") as advance:
        for asset in store.assets():
            if why := findings.lost.get(asset):
                reports.append(LabelOutcome(asset, problems=(why,)))
            else:
                reports.append(
                    writer.try_write(asset, findings.hulls[asset], findings.labels_of(asset), can_replace_less_certain)
                )
            report(reports[-1])
            advance()
    return PropagationResult(tuple(reports), findings.next)


def propose_propagated(
    store: Store, vocabulary: Sequence[str] | None, execution: ExecutionOptions, stage: Stage
) -> Proposals:
    """What `propagate_labels` would write, with nothing written."""
    words = store.vocabulary if vocabulary is None else tuple(vocabulary)
    findings = _compare_assets(store, words, execution, stage)
    found, labelled = list[LabelEvidence](), 0
    for asset in (asset for asset in store.assets() if asset not in findings.lost):
        hulls, given = findings.hulls[asset], findings.labels_of(asset)
        current = match_labels(store.labels(asset), hulls).labels
        over = {name: infer_over(current.get(name), label) for name, label in given.items()}
        taken = {name: label for name, label in over.items() if is_replaced(current.get(name), label)}
        found += [LabelEvidence(asset, label, "likeness", name) for name, label in taken.items()]
        labelled += len(hulls) - len(taken)
    return group_evidence(found, words, labelled, findings.lost.values())


def is_replaced(current: Label | None, given: Label) -> bool:
    """Whether a label takes the place of another, or of none."""
    return current != given and can_replace_less_certain(current, given)


@dataclass(frozen=True, eq=False)
class _Findings:
    """What labels say of all assets. hulls: digests by name, in order, of those that could be read; lost: why others
    have no labels; next: the one that would help most if it were labelled."""

    hulls: Mapping[str, Mapping[str, str]]
    lost: Mapping[str, str]
    next: str | None
    found: FamilyComparison

    def labels_of(self, asset: str) -> dict[str, Label]:
        """The labels of an asset, by hull."""
        return {name: label for name, label in zip(self.hulls[asset], self.found.labels(asset), strict=True) if label}


def _compare_assets(store: Store, vocabulary: Sequence[str], execution: ExecutionOptions, stage: Stage) -> _Findings:
    if not vocabulary:
        remedy = "Say first what hulls can be: --vocabulary a,b,c."
        raise ProjectError("the vocabulary is empty", where=str(store.folder), remedy=remedy)
    with stage(len(store.assets()), "reading") as advance:
        facts = survey(store.found, store.layout, execution=execution, progress=advance)
    lost = {asset: own.error for asset, own in facts.items() if own.error}
    known = dict[str, list[Label | None]]()
    for asset, own in facts.items():
        try:
            known |= {asset: _reference_labels(store.labels(asset), own, vocabulary)} if asset not in lost else {}
        except AssetError as error:
            lost[asset] = error.message
    cache = DescriptorCache(store, {asset: facts[asset] for asset in known}, execution)
    hulls = {asset: facts[asset].hulls for asset in known}
    del facts
    found = compare_family(cache, known, execution, stage)
    if not found.has_labels:
        remedy = (
            f"Label the hulls of one asset first, best {found.next}." if found.next else "Decompose the assets first."
        )
        raise ProjectError("there is no label that others could be taken from", where=str(store.folder), remedy=remedy)
    return _Findings(hulls, lost | found.lost, found.next, found)


def _reference_labels(file: LabelFile, facts: AssetFacts, vocabulary: Sequence[str]) -> list[Label | None]:
    """The labels of the hulls of an asset that others may be taken from."""
    labels = match_labels(file, facts.hulls).labels
    found = [labels.get(name) for name in facts.hulls]
    return [label if reference_label(label) in vocabulary else None for label in found]
