"""Labels that follow from other labels of a family: of a few assets propagated to all, of all sources weighed together;
and the labels that the sources gave, restored."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence

from meshforge import label_model, symbolic
from meshforge.common import AssetError
from meshforge.labels.family_comparison import FamilyComparison, compare_assets
from meshforge.labels.labeler import AssetLabels, Labeler, LabelFamily, LabelProposal
from meshforge.symbolic import Label


class PropagationLabeler(Labeler):
    """Propagates the labels of a few assets to all others; labels of people and files stay.

    Descriptions of the hulls are kept in the project, so that the next time is quick.
    Raises ProjectError: no vocabulary, no label to begin with; StoppedError on a stop.
    """

    name = "propagate"
    about = "labels of a few assets propagated to all others"

    def propose(self, family: LabelFamily) -> LabelProposal:
        compared = compare_assets(family, lambda label: label if label_model.reference_label(label) else None)
        labels = [label for place in range(len(compared.assets)) for label in compared.found.labels(place)]
        return LabelProposal(_share_labels(family, compared, labels, lambda current, label: "likeness"), compared.next)


def _share_labels(
    family: LabelFamily,
    compared: FamilyComparison,
    labels: Sequence[Label | None],
    kind_of: Callable[[Label | None, Label], str],
) -> Generator[AssetLabels, None, None]:
    shares = dict(compared.share_out(labels))
    for asset in family.store.assets():
        if asset in compared.lost:
            yield AssetLabels(asset, error=compared.lost[asset])
            continue
        current, given = compared.current[asset], shares[asset]
        reasons = {hull: (kind_of(current.get(hull), label), hull) for hull, label in given.items()}
        yield AssetLabels(asset, compared.hulls[asset], given, reasons)


class ConsensusLabeler(Labeler):
    """Gives each hull the label that all sources together support; labels of people stay.

    Each source counts as far as it is right in this family, beside the labels of hulls that look alike. A label that it
    is right about stays as that source gave it; one that was replaced is kept beside the new one, for `SourceRestorer`.
    Doing it again changes nothing. Raises ProjectError: no vocabulary, no label at all; StoppedError on a stop.
    """

    name = "consensus"
    about = "labels that all sources together support"
    replaces = True

    def propose(self, family: LabelFamily) -> LabelProposal:
        compared = compare_assets(family, label_model.evidence_of)
        labels = compared.found.agree(compared.observed)
        assets = _share_labels(family, compared, labels, _name_kind)
        return LabelProposal(assets, compared.next, compared.found.find_alike_labels())

    def can_replace(self, current: Label | None, given: Label | None) -> bool:
        """Return whether what the label was inferred from is still the evidence on its hull."""
        return label_model.evidence_of(current) == label_model.evidence_of(given)


def _name_kind(current: Label | None, label: Label) -> str:
    """What a label follows from, hulls that look alike or its own source; and which label it replaces."""
    by = "consensus" if label.source == "consensus" else "its source"
    return f"{by}, not {current.name}" if current and current.name != label.name else by


class SourceRestorer(Labeler):
    """Restores the labels of sources where labels were inferred: a hull that had none before has none then.

    It undoes `ConsensusLabeler` and `PropagationLabeler`.
    """

    name = "sources"
    about = "labels as their sources gave them, before consensus and propagate"
    replaces = True

    def propose(self, family: LabelFamily) -> LabelProposal:
        return LabelProposal(_restore(family))

    def can_replace(self, current: Label | None, given: Label | None) -> bool:
        return label_model.evidence_of(current) == given


def _restore(family: LabelFamily) -> Generator[AssetLabels, None, None]:
    for asset, facts in family.iterate_facts():
        if facts.error:
            yield AssetLabels(asset, error=facts.error)
            continue
        try:
            current = symbolic.match_labels(family.store.labels(asset), facts.hulls).labels
        except AssetError as error:
            yield AssetLabels(asset, error=error.message)
            continue
        inferred = {hull: label for hull, label in current.items() if label.source in symbolic.INFERRED_SOURCES}
        reasons = {hull: (f"not {label.name}", hull) for hull, label in inferred.items()}
        yield AssetLabels(
            asset, facts.hulls, {hull: label_model.evidence_of(label) for hull, label in current.items()}, reasons
        )
