"""Labels given to hulls beside the labels that are there: a person's are never overwritten by a machine; and labels
that follow hulls which others replace."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace

from meshforge import label_model, rendering, symbolic
from meshforge.common import ProjectError, file_state, join_names, suggest_match
from meshforge.geometry import Shape, digest, overlap_volume
from meshforge.store import Store, hull_digests, iterate_asset_index
from meshforge.symbolic import Label

ReplacePolicy = Callable[[Label | None, Label | None], bool]
"""Whether a label, or none, may be replaced by a given one, or none, at all; what people said stays in any case."""

_MOST_OVERLAP = 0.5  # a hull takes a label that more than this share of what it overlaps has
_WHOLE_OVERLAP = 0.99  # from here on it is that hull, or a part of it, and the label is as sure as it was


@dataclass(frozen=True, slots=True)
class LabelOutcome:
    """What became of labels that were given to one asset; all but `asset` and `problems` are numbers of labels.

    taken: written; same: those the hulls have already; kept: not written, since a person's label stands there.
    problems: a sentence for each label that was left out; unlabelled: hulls that still have none; unsure: those whose
    label is less certain than not; open: why the source left hulls without one, by hull, where that is known.
    """

    asset: str
    taken: int = 0
    same: int = 0
    kept: int = 0
    unlabelled: int = 0
    unsure: int = 0
    problems: tuple[str, ...] = ()
    open: Mapping[str, str] = field(default_factory=dict)


def set_labels(
    store: Store,
    asset: str,
    labels: Mapping[str, str | None],
    *,
    source: symbolic.LabelSource = "user",
    confidence: float = 1.0,
) -> LabelOutcome:
    """Label some hulls of an asset, or remove their labels by None. A machine never overwrites a person's label.

    Raises ProjectError, with nothing written, for an unknown hull or a label that is not in the vocabulary.
    """
    (outcome,) = set_labels_of(store, {asset: labels}, source=source, confidence=confidence)
    return outcome


def set_labels_of(
    store: Store,
    labels: Mapping[str, Mapping[str, str | None]],
    *,
    source: symbolic.LabelSource = "user",
    confidence: float = 1.0,
) -> tuple[LabelOutcome, ...]:
    """Label hulls of several assets as `set_labels` does, all or none. labels: by asset and hull.

    A hull with a class whose label is removed is none of the parts.
    """
    texts, outcomes = dict[str, str | None](), list[LabelOutcome]()
    with store.lock():
        vocabulary, every = store.vocabulary, _read_digests(store, labels)
        for asset, wanted in labels.items():
            hulls = every[asset]
            classes = store.classes(asset).labels
            words = {name: label or (symbolic.NO_PART if name in classes else None) for name, label in wanted.items()}
            given = {name: Label(label, confidence, source) if label else None for name, label in words.items()}
            current = symbolic.match_labels(store.labels(asset), hulls).labels
            labelled, outcome = merge_labels(asset, hulls, current, given, vocabulary)
            made = {label for label in words.values() if label and symbolic.is_class_name(label)} - {symbolic.NO_PART}
            unknown = sorted(made.difference(store.words)) if made else []
            if problem := next(iter(outcome.problems), f"no step made the class {unknown[0]!r}" if unknown else None):
                remedy = f"The vocabulary is: {', '.join(store.words) or 'empty'}."
                raise ProjectError(problem, where=asset, remedy=remedy)
            texts[asset] = store.labels_text(asset, hulls, labelled, vocabulary)
            outcomes.append(outcome)
        store.write_labels_files(texts)
    return tuple(outcomes)


def _read_digests(store: Store, assets: Collection[str]) -> dict[str, Mapping[str, str]]:
    """The digests of the hulls of assets, by name, in order; of many, without reading those that did not change.

    Raises AssetError where one cannot be read.
    """
    facts = dict(iterate_asset_index(store.found, store.layout, assets)) if len(assets) > 1 else {}
    known = {asset: one.hulls for asset, one in facts.items() if not one.error}
    return {asset: known[asset] if asset in known else hull_digests(store.mesh(asset)) for asset in assets}


def merge_labels(
    asset: str,
    hulls: Collection[str],
    current: Mapping[str, Label],
    given: Mapping[str, Label | None],
    vocabulary: Sequence[str],
) -> tuple[dict[str, Label], LabelOutcome]:
    """Return the labels of an asset with those that may be taken, and what became of each of these.

    hulls: the names of all; current: the labels that there are, by hull; given: by hull, None to remove its label.
    """
    labels, taken, same, kept, problems = dict(current), 0, 0, 0, list[str]()
    for name, label in given.items():
        label = infer_over(current.get(name), label) if label else None
        if problem := _problem(name, label, hulls, vocabulary):
            problems.append(problem)
        elif current.get(name) == label:
            same += label is not None
        elif label is None:
            labels.pop(name, None)
        elif is_protected(current.get(name), label):
            kept += 1
        else:
            labels[name] = label
            taken += 1
    unsure = sum(label.confidence < rendering.UNSURE for label in labels.values())
    return labels, LabelOutcome(asset, taken, same, kept, len(hulls) - len(labels), unsure, tuple(problems))


def is_protected(current: Label | None, given: Label) -> bool:
    """Return whether a label stays though another one is given: a machine's does not take the place of a person's."""
    return (
        current is not None and current.source in symbolic.HUMAN_SOURCES and given.source not in symbolic.HUMAN_SOURCES
    )


def infer_over(current: Label | None, given: Label) -> Label:
    """Return a given label; one that was inferred with the evidence on its hull before that."""
    return (
        replace(given, given=given.given or label_model.evidence_of(current))
        if given.source in symbolic.INFERRED_SOURCES
        else given
    )


def _problem(name: str, label: Label | None, hulls: Collection[str], vocabulary: Sequence[str]) -> str | None:
    if name not in hulls:
        return f"there is no hull {name!r}{suggest_match(name, hulls)}"
    if label and label.name not in vocabulary and not symbolic.is_class_name(label.name):
        return f"{name}: the label {label.name!r} is not in the vocabulary{suggest_match(label.name, vocabulary)}"
    return None


OutcomeCallback = Callable[[LabelOutcome], None]
"""Called with what became of an asset, as soon as that is known; assets come in their order."""


@dataclass(frozen=True, slots=True)
class LabelMerge:
    """The labels of an asset, by hull, before and after others are given; and what becomes of these."""

    before: Mapping[str, Label]
    after: Mapping[str, Label]
    outcome: LabelOutcome


class LabelWriter:
    """Writes labels of assets, each under the lock of the project, which others may change at the same time."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._seen: object = None
        self._vocabulary: tuple[str, ...] = ()

    @property
    def vocabulary(self) -> tuple[str, ...]:
        """The vocabulary as it is now; settings that name very many assets are not parsed for each of them."""
        now = file_state(self._store.layout.settings)
        if now != self._seen:
            self._seen, self._vocabulary = now, self._store.vocabulary
        return self._vocabulary

    def write(
        self, asset: str, hulls: Mapping[str, str], given: Mapping[str, Label | None], may: ReplacePolicy
    ) -> LabelMerge:
        """Write those of the labels that may be taken: since they were computed, the asset may have got others.

        hulls: digests by name, in order. Raises AssetError where the present labels cannot be read.
        """
        with self._store.lock():
            merged = self.merge(asset, hulls, given, may, self.vocabulary)
            if merged.after != merged.before:
                self._store.write_labels(asset, hulls, merged.after, self.vocabulary)
        return merged

    def merge(
        self,
        asset: str,
        hulls: Mapping[str, str],
        given: Mapping[str, Label | None],
        may: ReplacePolicy,
        vocabulary: Sequence[str],
    ) -> LabelMerge:
        """Return the labels that `write` would write. Raises AssetError where the present labels cannot be read."""
        current = symbolic.match_labels(self._store.labels(asset), hulls).labels
        wanted = {name: label for name, label in given.items() if may(current.get(name), label)}
        return LabelMerge(current, *merge_labels(asset, hulls, current, wanted, vocabulary))


def can_fill_gap(current: Label | None, given: Label | None) -> bool:
    """Return only hulls without a label get one, or with one that was taken from another family."""
    return current is None or current.source == "like"


def can_replace_less_certain(current: Label | None, given: Label) -> bool:
    """Return whether a label may be replaced: an earlier one of that machine, or one that another was less sure of.

    That of a part of a hull stays: the surface, or a person's cut, says more than the shape of the part.
    """
    if current is None or current.source == given.source:
        return True
    return current.source not in symbolic.GIVEN_SOURCES | {"rebuild"} and current.confidence < given.confidence


@dataclass(frozen=True, eq=False, slots=True)
class NewHullLabels:
    """The labels of an asset whose hulls change. mesh: the new hulls with theirs; gone: names of old ones."""

    store: Store
    asset: str
    mesh: symbolic.SymbolicMesh
    gone: tuple[str, ...]
    notes: tuple[str, ...]

    def format(self, *, keep_old: bool) -> str | None:
        """Return what the labels file says, None for no file; keep_old: labels of hulls that go stay beside them."""
        mesh, away = self.mesh, () if keep_old else self.gone
        return self.store.labels_text(self.asset, hull_digests(mesh), mesh.labels, self.store.vocabulary, away)


def label_new_hulls(
    store: Store,
    asset: str,
    old: Mapping[str, Shape],
    mesh: symbolic.SymbolicMesh,
    known: Mapping[str, Label | None] | None = None,
) -> NewHullLabels | None:
    """Return the labels where hulls `old`, by name, become those of a mesh; None where no label is concerned.

    known: labels of new hulls that are known otherwise than by overlap, None for no label. One of a person, by
    overlap, stays where it says the same.
    """
    known = known or {}
    file = store.labels(asset)
    here = hull_digests(mesh)
    were = {name: digest(shape) for name, shape in old.items()}
    gone = {name: old[name] for name in file.labels if name in old and here.get(name) != were[name]}
    if not gone and not known:
        return None
    labels = {name: file.labels[name] for name in gone}
    fresh = {h.name: _label_by_overlap(h, gone, labels) for h in mesh.hulls if were.get(h.name) != here[h.name]}
    fresh = {name: _choose_label(label, known[name]) if name in known else label for name, label in fresh.items()}
    rest = replace(file, labels={n: label for n, label in file.labels.items() if n not in gone})
    followed = symbolic.transfer_labels(rest, mesh).mesh
    taken = {name: label for name, label in fresh.items() if label and not followed.hull_of(name).annotation}
    notes = [f"labels of {join_names([*gone])} went to {join_names([*taken])}"] if taken and gone else []
    needed = {label.name for label in labels.values() if label.source != "rebuild"}  # those follow from the rebuild
    lost = sorted(needed - {label.name for label in taken.values()})
    notes += [f"no hull takes over the label {join_names(lost)}"] if lost else []
    away = tuple(name for name in gone if name not in taken)
    return NewHullLabels(store, asset, followed.with_labels(taken), away, tuple(notes))


def _choose_label(by_overlap: Label | None, known: Label | None) -> Label | None:
    is_same = by_overlap and known and by_overlap.name == known.name and by_overlap.source in symbolic.HUMAN_SOURCES
    return by_overlap if is_same else known


def _label_by_overlap(hull: symbolic.Hull, gone: Mapping[str, Shape], labels: Mapping[str, Label]) -> Label | None:
    common = {name: overlap_volume(hull.shape, shape) for name, shape in gone.items()}
    covered = sum(common.values())
    if not covered > 0:
        return None
    shares: dict[str, float] = {}
    for name, volume in common.items():
        shares[labels[name].name] = shares.get(labels[name].name, 0.0) + volume / covered
    best = max(shares, key=lambda label: shares[label])
    if shares[best] <= _MOST_OVERLAP:
        return None
    main_source = labels[max((n for n in gone if labels[n].name == best), key=lambda n: common[n])]
    certain = shares[best] >= _WHOLE_OVERLAP
    return (
        main_source
        if certain
        else replace(main_source, confidence=main_source.confidence * min(shares[best], 1.0), source="propagated")
    )
