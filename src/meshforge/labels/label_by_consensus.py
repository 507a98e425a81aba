"""Labels of all sources weighed together, taken or only proposed; and what sources said put back."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass

from meshforge import label_model, symbolic
from meshforge.batch import ExecutionOptions
from meshforge.common import AssetError
from meshforge.labels import family_comparison
from meshforge.labels.merge import LabelOutcome, LabelWriter, OutcomeCallback
from meshforge.labels.summary import LabelEvidence, Proposals, group_evidence
from meshforge.store import Store, iterate_survey
from meshforge.symbolic import Label

_BeforeAndAfter = tuple[family_comparison.HullLabels, Mapping[str, Label | None]]
"""The labels of an asset, by hull, and those that were given to it."""


@dataclass(frozen=True, slots=True)
class LabelChange:
    """Hulls that had one label, None for none, and have another one, None for none, now; in how many assets."""

    was: str | None
    label: str | None
    hulls: int
    assets: int


@dataclass(frozen=True, slots=True)
class ConsensusResult:
    """What became of each asset.

    changes: the most frequent first; next: the asset that would help most if it were labelled, None: all are; free:
    hulls whose label no person gave; alike: pairs of labels that may be two names of one part.
    """

    reports: tuple[LabelOutcome, ...]
    changes: tuple[LabelChange, ...]
    next: str | None
    free: int
    alike: tuple[tuple[str, str], ...]


def label_by_consensus(
    store: Store,
    execution: ExecutionOptions,
    stage: family_comparison.Stage,
    report: OutcomeCallback,
    write_block: family_comparison.WriteBlock = nullcontext,
) -> ConsensusResult:
    """Give each hull the label that all sources together speak for; see `LabelStore.label_by_consensus`."""
    compared = family_comparison.compare_assets(store, store.vocabulary, label_model.evidence_of, execution, stage)
    labels = dict(_share_labels(compared))
    with write_block(compared.next):
        reports = tuple(family_comparison.write_labels(store, labels, compared, _is_said_still, stage, report))
    free = sum(len(hulls) for hulls in compared.hulls.values()) - sum(
        label.source in symbolic.HUMAN_SOURCES for current in compared.current.values() for label in current.values()
    )
    written = {one.asset: labels[one.asset] for one in reports if not one.problems}
    changes = count_changes((compared.current[asset], now) for asset, now in written.items())
    return ConsensusResult(reports, changes, compared.next, free, compared.found.find_alike_labels())


def propose_consensus(
    store: Store, vocabulary: Sequence[str] | None, execution: ExecutionOptions, stage: family_comparison.Stage
) -> Proposals:
    """What `label_by_consensus` would write, with nothing written."""
    words = store.vocabulary if vocabulary is None else tuple(vocabulary)
    compared = family_comparison.compare_assets(store, words, label_model.evidence_of, execution, stage)
    found, labelled = list[LabelEvidence](), 0
    for asset, given in _share_labels(compared):
        current = compared.current[asset]
        taken = {name: label for name, label in given.items() if current.get(name) != label}
        found += [
            LabelEvidence(asset, label, _name_kind(current.get(name), label), name) for name, label in taken.items()
        ]
        labelled += len(compared.hulls[asset]) - len(taken)
    return group_evidence(found, words, labelled, compared.lost.values())


def _name_kind(current: Label | None, label: Label) -> str:
    """What a label follows from: the hulls that are like its own, or what was said of it; and what it replaces."""
    by = "consensus" if label.source == "consensus" else "its source"
    return f"{by}, not {current.name}" if current and current.name != label.name else by


def _share_labels(compared: family_comparison.FamilyComparison) -> Iterator[tuple[str, dict[str, Label]]]:
    """The label of each hull that all that is said speaks for, asset by asset; what a person said stays."""
    for asset, labels in compared.share_out(compared.found.agree(compared.said)):
        current = compared.current[asset]
        yield asset, {name: label for name, label in labels.items() if not _is_overruled(current.get(name), label)}


def _is_overruled(current: Label | None, label: Label) -> bool:
    """Whether a label would take the place of a person's, whose word may have left the vocabulary."""
    return current is not None and current.source in symbolic.HUMAN_SOURCES and current != label


def _is_said_still(current: Label | None, given: Label) -> bool:
    """Whether what a label was inferred from is still what was said of its hull."""
    return label_model.evidence_of(current) == label_model.evidence_of(given)


def count_changes(labels: Iterable[_BeforeAndAfter]) -> tuple[LabelChange, ...]:
    """Which labels were replaced by which, given those of each asset before, and the new ones."""
    counts = dict[tuple[str | None, str | None], list[int]]()
    for before, after in labels:
        seen = set[tuple[str | None, str | None]]()
        for name, label in after.items():
            was = before.get(name)
            pair = was.name if was else None, label.name if label else None
            if pair[0] != pair[1]:
                count = counts.setdefault(pair, [0, 0])
                count[0] += 1
                count[1] += pair not in seen
                seen.add(pair)
    found = [LabelChange(was, label, *count) for (was, label), count in counts.items()]
    return tuple(sorted(found, key=lambda one: (-one.hulls, one.was or "", one.label or "")))


@dataclass(frozen=True, slots=True)
class SourceRestoration:
    """What became of each asset, and which labels went for which, the most frequent first."""

    reports: tuple[LabelOutcome, ...]
    changes: tuple[LabelChange, ...]


def restore_sources(store: Store, execution: ExecutionOptions, report: OutcomeCallback) -> SourceRestoration:
    """Put what sources said in the place of labels that were inferred; see `LabelStore.restore_sources`."""
    writer, reports, changed = LabelWriter(store), list[LabelOutcome](), list[_BeforeAndAfter]()
    for asset, facts in iterate_survey(store.found, store.layout, execution=execution):
        if facts.error:
            reports.append(LabelOutcome(asset, problems=(facts.error,)))
        else:
            try:
                inferred, outcome = writer.remove_inferred(asset, facts.hulls)
                changed.append((inferred, {name: label.given for name, label in inferred.items()}))
                reports.append(outcome)
            except AssetError as error:
                reports.append(LabelOutcome(asset, problems=(error.message,)))
        report(reports[-1])
    return SourceRestoration(tuple(reports), count_changes(changed))


def propose_sources(store: Store, execution: ExecutionOptions) -> Proposals:
    """What `restore_sources` would write, with nothing written."""
    found, labelled, problems = list[LabelEvidence](), 0, list[str]()
    for asset, facts in iterate_survey(store.found, store.layout, execution=execution):
        try:
            current = symbolic.match_labels(store.labels(asset), facts.hulls).labels
        except AssetError as error:
            problems.append(f"{asset}: {error.message}")
            continue
        problems += [facts.error] if facts.error else []
        inferred = {name: label for name, label in current.items() if label.source in symbolic.INFERRED_SOURCES}
        found += [LabelEvidence(asset, one.given, f"not {one.name}", name) for name, one in inferred.items()]
        labelled += len(current) - len(inferred)
    return group_evidence(found, store.vocabulary, labelled, problems)
