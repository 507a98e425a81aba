"""Labels of a few assets propagated to all others of a project, taken or only proposed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import nullcontext
from dataclasses import dataclass

from meshforge.batch import ExecutionOptions
from meshforge.label_model import reference_label
from meshforge.labels.family_comparison import FamilyComparison, Stage, WriteBlock, compare_assets, write_labels
from meshforge.labels.merge import LabelOutcome, OutcomeCallback, can_replace_less_certain
from meshforge.labels.summary import LabelEvidence, Proposals, group_evidence
from meshforge.store import Store
from meshforge.symbolic import Label


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
    compared = compare_assets(store, store.vocabulary, _speak, execution, stage)
    with write_block(compared.next):
        labels = dict(_share_labels(compared))
        reports = tuple(write_labels(store, labels, compared, can_replace_less_certain, stage, report))
    return PropagationResult(reports, compared.next)


def propose_propagated(
    store: Store, vocabulary: Sequence[str] | None, execution: ExecutionOptions, stage: Stage
) -> Proposals:
    """What `propagate_labels` would write, with nothing written."""
    words = store.vocabulary if vocabulary is None else tuple(vocabulary)
    compared = compare_assets(store, words, _speak, execution, stage)
    found, labelled = list[LabelEvidence](), 0
    for asset, given in _share_labels(compared):
        current = compared.current[asset]
        taken = {name: label for name, label in given.items() if _is_replaced(current.get(name), label)}
        found += [LabelEvidence(asset, label, "likeness", name) for name, label in taken.items()]
        labelled += len(compared.hulls[asset]) - len(taken)
    return group_evidence(found, words, labelled, compared.lost.values())


def _share_labels(compared: FamilyComparison) -> Iterator[tuple[str, dict[str, Label]]]:
    found = compared.found
    return compared.share_out([label for place in range(len(compared.assets)) for label in found.labels(place)])


def _speak(label: Label | None) -> Label | None:
    """A label that others may be taken from."""
    return label if reference_label(label) else None


def _is_replaced(current: Label | None, given: Label) -> bool:
    return current != given and can_replace_less_certain(current, given)
