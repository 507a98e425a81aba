"""Labels that follow from all that is said of a family: files, names, people, models and look-alikes together."""

from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import replace

from meshforge import label_model, symbolic, synthesis
from meshforge.common import AssetError
from meshforge.labels.classes import find_step_labels
from meshforge.labels.family_comparison import FamilyComparison, HullLabels, compare_assets
from meshforge.labels.from_files.label_by_files import FileLabeler, find_label_files
from meshforge.labels.labeler import AssetLabels, Labeler, LabelFamily, LabelProposal, LabelReason
from meshforge.labels.names.label_by_names import NameLabeler
from meshforge.store import AssetFacts, Store
from meshforge.symbolic import NO_PART, Label, match_labels


class PropagationLabeler(Labeler):
    """Gives each hull the label that all labels of the family together support; labels of people stay.

    Each source counts as far as it is right in this family, beside the labels of hulls that look alike. A label that it
    is right about stays as that source gave it; one that was replaced is kept beside the new one, and counts again.
    Doing it again changes nothing. Descriptions of the hulls are kept in the project, so that the next time is quick.
    Raises ProjectError: no vocabulary, no label to begin with; StoppedError on a stop.
    """

    name = "propagate"
    about = "the labels that there are, propagated to all other hulls, and weighed against each other"
    replaces = True

    def propose(self, family: LabelFamily) -> LabelProposal:
        steps = _find_step_labels(family)
        return _infer(family, lambda asset, current: {**steps.get(asset, {}), **_evidence_on(current)}, {})

    def can_replace(self, current: Label | None, given: Label | None) -> bool:
        """Return whether what the label was inferred from is still the evidence on its hull."""
        return label_model.evidence_of(current) == label_model.evidence_of(given)


class AllLabeler(Labeler):
    """Takes labels from all that there is: files beside the assets, names, and the labels that hulls have, weighed
    together as `PropagationLabeler` does.

    Raises ProjectError: nothing says a label; what `FileLabeler` and `NameLabeler` raise, but for no file at all.
    """

    name = "all"
    about = "files, names, and propagation from these and from what people said"
    replaces = True

    def __init__(self, files: FileLabeler | None = None, names: NameLabeler | None = None) -> None:
        self.files, self.names = files or FileLabeler(), names or NameLabeler()

    def propose(self, family: LabelFamily) -> LabelProposal:
        found, words = list[AssetLabels](), family.vocabulary
        if self.files.source or find_label_files(family.store.found, None):
            proposal = self.files.propose(family)
            words = words or proposal.vocabulary
            found += _collect(proposal)
        family = replace(family, vocabulary=words)
        by_names = _collect(self.names.propose(family)) if words else []
        problems = {one.asset: one.problems for one in found if one.problems}
        problems |= {one.asset: (*problems.get(one.asset, ()), one.error) for one in found if one.error}
        reasons: dict[str, Mapping[str, LabelReason]] = {one.asset: one.reasons for one in by_names}
        reasons |= {one.asset: {**reasons.get(one.asset, {}), **one.reasons} for one in found}
        named, filed, steps = _by_asset(by_names), _by_asset(found), _find_step_labels(family)

        def speak(asset: str, current: HullLabels) -> HullLabels:
            kept = _evidence_on(current)
            beside_names = {hull: one for hull, one in kept.items() if one.source != "name"}
            people = {hull: one for hull, one in kept.items() if one.source in symbolic.HUMAN_SOURCES}
            return {
                **{**steps.get(asset, {}), **kept, **named.get(asset, {})},
                **{**beside_names, **filed.get(asset, {}), **people},
            }

        inferred = _infer(family, speak, reasons)
        return replace(inferred, assets=_add_problems(inferred.assets, problems), vocabulary=words)

    def can_replace(self, current: Label | None, given: Label | None) -> bool:
        return True


def _collect(proposal: LabelProposal) -> list[AssetLabels]:
    """The labels of all assets, with the reasons of those alone: of many hulls nothing is said."""
    with closing(proposal.assets) as assets:
        return [replace(one, reasons={h: why for h, why in one.reasons.items() if one.given.get(h)}) for one in assets]


def _by_asset(found: Sequence[AssetLabels]) -> dict[str, HullLabels]:
    """What a source says, by asset."""
    return {one.asset: _evidence_on({hull: label for hull, label in one.given.items() if label}) for one in found}


def _add_problems(
    assets: Generator[AssetLabels, None, None], problems: Mapping[str, Sequence[str]]
) -> Generator[AssetLabels, None, None]:
    with closing(assets):
        for one in assets:
            yield replace(one, problems=(*one.problems, *problems.get(one.asset, ())))


def _evidence_on(current: HullLabels) -> HullLabels:
    return {hull: known for hull, label in current.items() if (known := label_model.evidence_of(label))}


def _find_step_labels(family: LabelFamily) -> dict[str, dict[str, Label]]:
    """The classes of hulls without a label on demonstrated assets, while no asset tells what all its hulls are: nothing
    but these says that a hull may be none of the parts that have names."""
    store = family.store
    shown = dict(store.meshes_by_id(store.demonstration_ids()))
    if not shown or any(_is_named(store, asset, facts) for asset, facts in family.iterate_facts()):
        return {}
    demos = {asset: synthesis.Demonstration(mesh, store.steps(asset), asset) for asset, mesh in shown.items()}
    return find_step_labels(shown, demos, (), store.templates_in(demos.values()))


def _is_named(store: Store, asset: str, facts: AssetFacts) -> bool:
    try:
        labels = match_labels(store.labels(asset), facts.hulls).labels
    except AssetError:  # said where it is compared
        return False
    return bool(facts.hulls) and facts.hulls.keys() == _evidence_on(labels).keys()


def _infer(
    family: LabelFamily,
    speak: Callable[[str, HullLabels], HullLabels],
    reasons: Mapping[str, Mapping[str, LabelReason]],
) -> LabelProposal:
    compared = compare_assets(family, speak)
    known = {label.name for label in compared.observed if label}
    labels = compared.found.agree(compared.observed) if len(known) > 1 else compared.observed
    alone = f"{next(iter(known))} is the only label, and nothing follows from one alone: label a hull that is another"
    notes = () if len(known) > 1 else (alone,)
    assets = _share_labels(family, compared, labels, reasons)
    alike = tuple(pair for pair in compared.found.find_alike_labels() if NO_PART not in pair)
    return LabelProposal(assets, compared.next, alike, notes=notes)


def _share_labels(
    family: LabelFamily,
    compared: FamilyComparison,
    labels: Sequence[Label | None],
    reasons: Mapping[str, Mapping[str, LabelReason]],
) -> Generator[AssetLabels, None, None]:
    shares = dict(compared.share_out(labels))
    for asset in family.store.assets():
        if asset in compared.lost:
            yield AssetLabels(asset, error=compared.lost[asset])
            continue
        current, known = compared.current[asset], reasons.get(asset, {})
        given: dict[str, Label | None] = {}
        for hull, label in shares[asset].items():
            if not symbolic.is_class_name(label.name):
                given[hull] = label
            elif hull in current and not label_model.evidence_of(current[hull]):  # it got the name of another part
                given[hull] = None
        rows = ((hull, label) for hull, label in given.items() if label)
        why = {hull: _reason_of(current.get(hull), label, known.get(hull), hull) for hull, label in rows}
        yield AssetLabels(asset, compared.hulls[asset], given, why)


def _reason_of(current: Label | None, label: Label, known: LabelReason | None, hull: str) -> LabelReason:
    """What a label follows from, hulls that look alike or its own source; and which label it replaces."""
    if label.source not in symbolic.INFERRED_SOURCES and known:
        return known
    by = "likeness" if label.source in symbolic.INFERRED_SOURCES else "its source"
    return (f"{by}, not {current.name}" if current and current.name != label.name else by), hull
