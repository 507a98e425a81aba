"""Labels from another family: each hull gets the label of the labelled hulls there that are most like it, and none
where it is like nothing there."""

from __future__ import annotations

import os
import shlex
from collections.abc import Generator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from meshforge.common import UsageError, join_and, join_names, pluralize, quote_path
from meshforge.geometry import Floats, Ints
from meshforge.label_model import FamilyTable, reference_label
from meshforge.label_model.similar import OTHER_STEPS, OWN_STEPS
from meshforge.labels.family_comparison import FamilyComparison, compare_assets
from meshforge.labels.labeler import AssetLabels, Labeler, LabelFamily, LabelProposal
from meshforge.labels.like_reference import (
    SAMPLE,
    LikeReference,
    find_family,
    find_sample,
    map_words,
    read_like_references,
    write_like_reference,
)
from meshforge.labels.merge import can_fill_gap
from meshforge.labels.reference_family import pick_evenly
from meshforge.samples import FAMILIES
from meshforge.store import Store
from meshforge.symbolic import Label

_WITHIN, _WIDER = 0.95, 1.2
"""The bound is that of so many hulls of the reference to those of its other assets, and so many times as far, since
another maker's assets of one kind differ more: on bundled and generated families of a kind, 0.77 to 0.96 of the hulls
whose part the reference has are labelled then, on those of another kind 0.3 to 0.8 of the others left open. All labels
have one bound: few references have enough hulls of each."""
_CLEAR = 0.6  # how probable a label must be; below, nearly as much speaks for another one
_MOST_LIKELY = 0.89  # how sure a label of another family is at most before a person confirmed it here
_AT_ONCE, _MOST = 2000, 2000  # hulls compared at a time; hulls that people labelled here, evenly chosen of more
_TRIED = 500  # hulls, evenly chosen, by which the nearest kinds are found
_DIGITS = 3


class LikeMismatchError(UsageError):
    """Most hulls are like nothing in the family that was named. kinds: families that ship, the nearest first, with the
    share of the hulls that is like something in each; pictures: commands that draw both families."""

    kinds: tuple[tuple[str, float], ...] = ()
    pictures: tuple[str, ...] = ()


class LikeLabeler(Labeler):
    """Labels hulls by the labelled assets of another project, or of a family that ships; labels of people, files, names
    and other machines stay. No label is sure before a person gave one of that name here.

    source: a project's folder, or `sample:cups`; None for the families that the project keeps. words: the label here
    for a label there, empty for none, where synonyms do not say it. Raises UsageError: no such family, or one of
    another kind (`LikeMismatchError`); ProjectError: nothing is labelled there, or what is kept is damaged.
    """

    name = "like"
    about = "labels of another project or of a bundled family, named by --like"

    def __init__(self, source: str | Path | None = None, words: Mapping[str, str] | None = None) -> None:
        self.source, self.words = str(source) if source else None, dict(words or {})
        self._fresh: tuple[str, LikeReference] | None = None

    def propose(self, family: LabelFamily) -> LabelProposal:
        known, notes = read_like_references(family.store), list[str]()
        if self.source:
            name, reference, notes = self._read_source(self.source, family, known)
            self._fresh, known = (name, reference), {**known, name: reference}
        if not known:
            remedy = "Name a project's folder, or a family that ships: --like sample:cups"
            raise UsageError("nothing says whose labels to take", where=str(family.store.folder), remedy=remedy)
        words = family.vocabulary or tuple(
            dict.fromkeys(word for one in known.values() for word in one.words.values() if word)
        )
        found = _compare(replace(family, vocabulary=words), known)
        if self._fresh:
            found.check_kind(self._fresh[0], family)
        assets = found.label_assets(family.store)
        return LabelProposal(assets, found.compared.next, vocabulary=words, notes=tuple(notes))

    def can_replace(self, current: Label | None, given: Label | None) -> bool:
        return can_fill_gap(current, given)

    def keep(self, store: Store) -> None:
        """Keep in the project what was read of another family; without that this does nothing."""
        if self._fresh:
            write_like_reference(store, *self._fresh)

    def _read_source(
        self, source: str, family: LabelFamily, known: Mapping[str, LikeReference]
    ) -> tuple[str, LikeReference, list[str]]:
        other = find_family(source, family.store)
        name = other.choose_name(known)
        assets, lost = other.read(family.execution, family.stage)
        present = {label for one in assets for label in one.labels if label}
        labels = [label for label in dict.fromkeys([*other.vocabulary, *sorted(present)]) if label in present]
        words, notes = map_words(name, labels, family.vocabulary, self.words)
        return name, LikeReference.of(other.source, words, assets), [*notes, *lost]


def _compare(family: LabelFamily, known: Mapping[str, LikeReference]) -> _LikeComparison:
    described = {name: one.describe(name, family.vocabulary) for name, one in known.items()}
    beside = [asset for assets in described.values() for asset in assets]
    compared = compare_assets(family, lambda label: label if reference_label(label) else None, beside)
    sizes = [len(asset.labels) for asset in beside]
    names = [name for name, assets in described.items() for _ in assets]
    return _LikeComparison(compared, family.vocabulary, tuple(names), sum(sizes))


@dataclass(frozen=True, eq=False)
class _LikeComparison:
    """The hulls of a project beside those of other families. names: the family of each of the other assets; beside:
    how many hulls these have, which are the last."""

    compared: FamilyComparison
    vocabulary: tuple[str, ...]
    names: tuple[str, ...]
    beside: int

    @property
    def _table(self) -> FamilyTable:
        return self.compared.found.table

    @cached_property
    def _own(self) -> int:
        return len(self._table.owner) - self.beside

    def _find_hulls(self, name: str) -> Ints:
        """The labelled hulls of one of the other families."""
        assets = [place for place, one in enumerate(self.names, len(self.compared.assets)) if one == name]
        return np.flatnonzero(np.isin(self._table.owner, assets) & self.compared.found.seen.known)

    @cached_property
    def _bounds(self) -> dict[str, float]:
        """How far from the nearest hull of a family a hull may be, by its name."""
        table, found = self._table, dict[str, float]()
        for name in dict.fromkeys(self.names):
            hulls = self._find_hulls(name)
            found[name] = _measure_bound(table.rows[hulls] * table.metric, table.owner[hulls])
        return found

    @cached_property
    def _apart(self) -> dict[str, Floats]:
        """How far each hull of the project is from the nearest of a family, in bounds."""
        return {name: self._find_nearest(self._find_hulls(name))[1] / bound for name, bound in self._bounds.items()}

    def _find_nearest(self, hulls: Ints) -> tuple[Ints, Floats]:
        """The nearest of some hulls to each hull of the project, and how far it is."""
        table = self._table
        found, apart = _find_nearest(table.rows[: self._own], table.rows[hulls] * table.metric, table.metric)
        return hulls[found], apart

    def check_kind(self, name: str, family: LabelFamily) -> None:
        """Raise LikeMismatchError where most hulls are like nothing in the family of a name."""
        apart = self._apart[name]
        far = int((apart > 1).sum())
        if 2 * far <= len(apart):
            return
        kinds, store = self._rank_kinds(family), family.store
        nearest, asset = find_sample(kinds[0][0]).files[0].path, shlex.quote(self.compared.assets[0])
        project = quote_path(store.folder)
        pictures = (
            f"meshforge render {asset} --project {project} -o own.png",
            f"meshforge render {quote_path(nearest)} -o {kinds[0][0]}.png",
        )
        shares = [f"{kind} (like {share:.0%} of the hulls)" for kind, share in kinds[:3]]
        remedy = (
            f"The nearest families that ship: {join_and(shares)}. See both: {' && '.join(pictures)}\n"
            f"  If they are of one kind: meshforge label {project} --like {SAMPLE}{kinds[0][0]}"
        )
        error = LikeMismatchError(
            f"{far:,} of {pluralize(len(apart), 'hull')} are like nothing in {name}: it is of another kind",
            where=str(store.folder),
            remedy=remedy,
        )
        error.kinds, error.pictures = kinds, pictures
        raise error

    def _rank_kinds(self, family: LabelFamily) -> tuple[tuple[str, float], ...]:
        """The families that ship, the nearest first, with the share of the project's hulls that is like each."""
        table, found = self._table, dict[str, float]()
        own = table.rows[pick_evenly(range(self._own), _TRIED)]
        for one in FAMILIES:
            assets, _ = find_sample(one.name).read(family.execution, family.stage)
            rows = table.scale(np.concatenate([np.array(asset.rows) for asset in assets])) * table.metric
            owner = np.repeat(np.arange(len(assets)), [len(asset.rows) for asset in assets])
            found[one.name] = float((_find_nearest(own, rows, table.metric)[1] <= _measure_bound(rows, owner)).mean())
        return tuple(sorted(found.items(), key=lambda item: -item[1]))

    def label_assets(self, store: Store) -> Generator[AssetLabels, None, None]:
        """Yield the labels of each asset of the project."""
        labels, reasons = self._choose_labels()
        places = {asset: place for place, asset in enumerate(self.compared.assets)}
        for asset in store.assets():
            if asset in self.compared.lost:
                yield AssetLabels(asset, error=self.compared.lost[asset])
                continue
            hulls, current = self.compared.hulls[asset], self.compared.current[asset]
            span = self._table.spans.get(places[asset], slice(0, 0))
            rows = [*zip(hulls, labels[span], reasons[span], strict=True)]
            given = {name: one for name, one, _ in rows if one or _is_like(current.get(name))}
            bare = {name: why for name, one, why in rows if not one and can_fill_gap(current.get(name), None)}
            yield AssetLabels(asset, hulls, given, {name: (why, name) for name, _, why in rows}, open=bare)

    def _choose_labels(self) -> tuple[list[Label | None], list[str]]:
        """The label of each hull of the project, None for none; and why it has that, or none."""
        found, own = self.compared.found, slice(0, self._own)
        chances, words = found.chances[own], found.seen.labels
        order = np.argsort(-chances, axis=1, kind="stable")[:, :2]
        best, second = order[:, 0], order[:, -1]
        chance = chances[np.arange(len(best)), best]
        by_people = np.asarray(pick_evenly(np.flatnonzero(found.seen.fixed).tolist(), _MOST), dtype=np.int64)
        nearest, apart = np.min([*self._apart.values()], axis=0), np.full(len(best), np.inf)
        confirmed = np.zeros(len(best), dtype=np.bool_)
        if len(by_people):
            hulls, apart = self._find_nearest(by_people)
            apart /= max(self._bounds.values())
            confirmed = (apart <= 1) & (found.seen.codes[hulls] == best)
        names = join_names([*dict.fromkeys(self.names)])
        labels, reasons = list[Label | None](), list[str]()
        for hull, code in enumerate(best.tolist()):
            word, label = words[code], None
            if min(nearest[hull], apart[hull]) > 1:
                why = f"like nothing in {names}"
            elif word not in self.vocabulary:
                why = f"like {word}, which is in no label of the vocabulary"
            elif chance[hull] < _CLEAR:
                why = f"as like {word} as {words[second[hull]]}"
            else:
                sure = float(chance[hull]) if confirmed[hull] else min(float(chance[hull]), _MOST_LIKELY)
                label, why = Label(word, round(sure, _DIGITS), "like"), f"like {names}"
            labels.append(label)
            reasons.append(why)
        return labels, reasons


def _is_like(label: Label | None) -> bool:
    return label is not None and label.source == "like"


def _find_nearest(rows: Floats, others: Floats, metric: Floats) -> tuple[Ints, Floats]:
    """The place of the nearest of some weighted rows to each row, and how far it is, by all processors."""
    from scipy.spatial.distance import cdist  # lazy: 0.5 s, half of all imports

    def compare(start: int) -> tuple[Ints, Floats]:
        gaps = cdist(rows[start : start + _AT_ONCE] * metric, others, "cityblock")
        places: Ints = gaps.argmin(axis=1)
        return places, gaps[np.arange(len(gaps)), places]

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(compare, range(0, len(rows), _AT_ONCE)))
    nothing = np.zeros(0, np.int64), np.zeros(0)
    places, gaps = zip(nothing, *found, strict=True)
    return np.concatenate(places), np.concatenate(gaps)


def _measure_bound(rows: Floats, owner: Ints) -> float:
    """How far a hull may be from the nearest of a family: as its own are from those of its other assets; of one asset,
    as hulls that look alike are."""
    from scipy.spatial.distance import cdist  # lazy: as above

    gaps = cdist(rows, rows, "cityblock")
    gaps[owner[:, None] == owner[None]] = np.inf
    nearest = gaps.min(axis=1, initial=np.inf)
    nearest = nearest[np.isfinite(nearest)]
    if not len(nearest):
        return OTHER_STEPS[1] * _WIDER
    return max(float(np.quantile(nearest, _WITHIN)), OWN_STEPS[0]) * _WIDER
