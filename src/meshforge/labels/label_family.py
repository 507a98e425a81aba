"""The hulls of a project labelled by a labeler, or its labels only shown."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass, replace

from meshforge import rendering
from meshforge.batch import IN_PROCESS, ExecutionOptions
from meshforge.common import AssetError
from meshforge.labels.label_sources import keep_label_source
from meshforge.labels.labeler import NO_REASON, AssetLabels, Labeler, LabelFamily, Stage, WriteBlock, ignore_stage
from meshforge.labels.merge import LabelMerge, LabelOutcome, LabelWriter, OutcomeCallback
from meshforge.labels.registry import make_labeler
from meshforge.store import Store
from meshforge.symbolic import HUMAN_SOURCES


@dataclass(frozen=True, slots=True)
class Proposal:
    """Hulls that would get the same label, None for none, for the like reason.

    names: those that say so, the most frequent first; hulls, assets: how many there are, and in how many assets;
    low, high: how sure the label is.
    """

    label: str | None
    kind: str
    names: tuple[str, ...]
    hulls: int
    assets: int
    low: float
    high: float

    @property
    def is_unsure(self) -> bool:
        return self.label is not None and self.low < rendering.UNSURE


@dataclass(frozen=True, slots=True)
class Proposals:
    """What would be taken, and what would be left without a label; problems: a sentence on each thing left out.

    labelled: hulls whose label stays.
    """

    rows: tuple[Proposal, ...]
    left: tuple[Proposal, ...]
    labelled: int = 0
    problems: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class LabelChange:
    """Hulls that had one label, None for none, and have another one, None for none, now; in how many assets."""

    was: str | None
    label: str | None
    hulls: int
    assets: int


@dataclass(frozen=True, slots=True)
class LabelResult:
    """What became of the labels of a labeler, or what would have.

    outcomes: of each asset, in their order; proposals: what a dry run would take; changes: the most frequent first;
    next: the asset that would help most if it were labelled, None: all are, or the labeler does not know; alike: pairs
    of labels that may be two names of one part; free: hulls whose label no person gave; notes: what else the user is to
    know, a sentence each.
    """

    outcomes: tuple[LabelOutcome, ...]
    proposals: Proposals
    changes: tuple[LabelChange, ...] = ()
    next: str | None = None
    alike: tuple[tuple[str, str], ...] = ()
    free: int = 0
    notes: tuple[str, ...] = ()


def label_project(
    store: Store,
    by: Labeler | str = "all",
    *,
    vocabulary: Sequence[str] | None = None,
    dry_run: bool = False,
    execution: ExecutionOptions = IN_PROCESS,
    stage: Stage = ignore_stage,
    report: OutcomeCallback = lambda outcome: None,
    write_block: WriteBlock | None = None,
) -> LabelResult:
    """Give hulls the labels of a labeler; a label of a person stays, and of others what the labeler may not replace.

    by: a labeler, or its name for one without options. vocabulary: to be set first, None for that of the project.
    dry_run: write nothing. stage: entered for each part of the work. report: called with the outcome of each asset, as
    soon as its labels are written. write_block: the block in which all labels are written, given the asset that would
    help most; without it those of an asset are written as soon as they are known.
    Raises what `Labeler.propose` raises, and UsageError for a name of no labeler.
    """
    labeler = make_labeler(by) if isinstance(by, str) else by
    if vocabulary is not None and not dry_run:
        store.set_vocabulary(vocabulary)
    words = store.vocabulary if vocabulary is None else tuple(vocabulary)
    proposal = labeler.propose(LabelFamily(store, words, execution, stage))
    run = _LabelRun(store, labeler, None if not dry_run else words or proposal.vocabulary)

    def write(found: Iterable[AssetLabels]) -> None:
        if not words:
            store.set_vocabulary(proposal.vocabulary)
        run.take(found, report)
        keep_label_source(store, run.outcomes.values(), labeler)

    with closing(proposal.assets) as assets:
        found = _count(assets, len(store.assets()), labeler.work, stage)
        if dry_run:
            run.take(found, report)
        elif write_block:
            known = list(found)
            with write_block(proposal.next):
                write(_count(known, len(known), "writing labels", stage))
        else:
            write(found)
    return replace(run.result(), next=proposal.next, alike=proposal.alike, notes=proposal.notes)


def _count(assets: Iterable[AssetLabels], total: int, what: str, stage: Stage) -> Iterator[AssetLabels]:
    with stage(total, what) as advance:
        for one in assets:
            yield one
            advance()


class _LabelRun:
    """Takes the labels of one asset after the other. vocabulary: that of a dry run, None to write."""

    def __init__(self, store: Store, labeler: Labeler, vocabulary: Sequence[str] | None) -> None:
        self.outcomes: dict[str, LabelOutcome] = {}
        self._store, self._labeler, self._vocabulary = store, labeler, vocabulary
        self._writer = LabelWriter(store)
        self._hulls, self._changes = Counter[tuple[str | None, str | None]](), Counter[tuple[str | None, str | None]]()
        self._groups = defaultdict[tuple[str | None, str, bool], list[tuple[str, str, float]]](list)
        self._labelled, self._free = 0, 0

    def take(self, assets: Iterable[AssetLabels], report: OutcomeCallback) -> None:
        for found in assets:
            outcome = self.outcomes[found.asset] = self._take_asset(found)
            report(outcome)

    def _take_asset(self, found: AssetLabels) -> LabelOutcome:
        if found.error:
            return LabelOutcome(found.asset, problems=(found.error,))
        arguments = found.asset, found.hulls, found.given, self._labeler.can_replace
        try:
            if self._vocabulary is None:
                merged = self._writer.write(*arguments)
            else:
                merged = self._writer.merge(*arguments, self._vocabulary)
                self._add_evidence(found, merged)
        except AssetError as error:
            return LabelOutcome(found.asset, problems=(error.message,))
        self._count(merged)
        self._free += len(found.hulls) - sum(label.source in HUMAN_SOURCES for label in merged.before.values())
        return replace(merged.outcome, problems=(*merged.outcome.problems, *found.problems), open=found.open)

    def _count(self, merged: LabelMerge) -> None:
        pairs = Counter(_iterate_renames(merged))
        self._hulls += pairs
        self._changes.update(pairs.keys())

    def _add_evidence(self, found: AssetLabels, merged: LabelMerge) -> None:
        for hull in found.hulls:
            label = merged.after.get(hull)
            if label is not None and label == merged.before.get(hull):
                self._labelled += 1
                continue
            is_meant = label is not None or found.given.get(hull) is None
            kind, name = found.reasons.get(hull, (NO_REASON, hull)) if is_meant else (NO_REASON, hull)
            sure = label.confidence if label else 0.0
            is_unsure = label is not None and sure < rendering.UNSURE
            self._groups[label.name if label else None, kind, is_unsure].append((found.asset, name, sure))

    def result(self) -> LabelResult:
        changes = [LabelChange(*pair, count, self._changes[pair]) for pair, count in self._hulls.items()]
        changes.sort(key=lambda one: (-one.hulls, one.was or "", one.label or ""))
        outcomes = tuple(self.outcomes[asset] for asset in self._store.assets() if asset in self.outcomes)
        problems = [f"{outcome.asset}: {problem}" for outcome in outcomes for problem in outcome.problems]
        order = {label: k for k, label in enumerate(self._vocabulary or ())}
        rows = [_summarize_group(label, kind, group) for (label, kind, _), group in self._groups.items()]
        rows.sort(key=lambda row: (order.get(row.label or "", len(order)), row.is_unsure, -row.hulls, row.kind))
        taken, left = (tuple(row for row in rows if (row.label is None) is bare) for bare in (False, True))
        shown = Proposals(taken, left, self._labelled, tuple(problems))
        return LabelResult(outcomes, shown, tuple(changes), free=self._free)


def _summarize_group(label: str | None, kind: str, group: Sequence[tuple[str, str, float]]) -> Proposal:
    assets, names, sure = zip(*group, strict=True)
    counts = Counter(names)
    ordered = sorted(counts, key=lambda name: (-counts[name], name))
    return Proposal(label, kind, tuple(ordered), len(group), len({*assets}), min(sure), max(sure))


def _iterate_renames(merged: LabelMerge) -> Iterator[tuple[str | None, str | None]]:
    for hull in merged.before.keys() | merged.after.keys():
        before, after = merged.before.get(hull), merged.after.get(hull)
        names = before.name if before else None, after.name if after else None
        if names[0] != names[1]:
            yield names
