"""Labels of a few assets propagated to all others of a project."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence

from meshforge.label_model import reference_label
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
        compared = compare_assets(family.store, family.vocabulary, _as_evidence, family.execution, family.stage)
        found = compared.found
        labels = [label for place in range(len(compared.assets)) for label in found.labels(place)]
        return LabelProposal(share_labels(family, compared, labels, lambda current, label: "likeness"), compared.next)


def share_labels(
    family: LabelFamily,
    compared: FamilyComparison,
    labels: Sequence[Label | None],
    kind_of: Callable[[Label | None, Label], str],
) -> Generator[AssetLabels, None, None]:
    """Each asset with its share of the labels of all hulls; kind_of: the kind of reason for replacing one."""
    shares = dict(compared.share_out(labels))
    for asset in family.store.assets():
        if asset in compared.lost:
            yield AssetLabels(asset, error=compared.lost[asset])
            continue
        current, given = compared.current[asset], shares[asset]
        reasons = {hull: (kind_of(current.get(hull), label), hull) for hull, label in given.items()}
        yield AssetLabels(asset, compared.hulls[asset], given, reasons)


def _as_evidence(label: Label | None) -> Label | None:
    """A label that others may be taken from."""
    return label if reference_label(label) else None
