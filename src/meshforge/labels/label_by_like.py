"""Labels from another family: each hull gets the label of the labelled hulls there that are most like it, and none
where it is like nothing there."""

from collections.abc import Generator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from meshforge.common import UsageError, join_and, join_names, quote_path
from meshforge.geometry import Floats, Ints
from meshforge.label_model import MOST_LIKELY, reference_label, to_confidence
from meshforge.labels.family_comparison import FamilyComparison, HullLabels, compare_assets
from meshforge.labels.labeler import AssetLabels, Labeler, LabelFamily, LabelProposal
from meshforge.labels.like_reference import LikeReference, describe_files, find_sample, read_family, read_references
from meshforge.labels.merge import can_fill_gap
from meshforge.samples import FAMILIES
from meshforge.symbolic import Label

_WITHIN, WIDER = 0.95, 1.3
"""The bound is that of so many hulls of a family to those of its other assets, and so many times as far, as assets of
one kind that others made differ more: of generated cups, chairs and tables like bundled ones 0.95, 0.80 and 0.95 of the
hulls whose part is known are right then (at 1.2: 0.92, 0.77, 0.95). Few families have enough hulls for one a label."""
_ALIKE = 5.0, 10.0  # within which hulls look alike in any case, of one asset and of others: `OWN_STEPS`, `OTHER_STEPS`
_CLEAR = 0.6  # how probable a label must be; below, nearly as much speaks for another one
_CERTAIN = 0.97
"""How probable it must be to be sure after all, where the nearest hull that a person labelled here has it, too, and is
no farther than without `WIDER`: with one asset labelled by hand 396 of 404 such labels of real families were right."""
_AT_ONCE, _MOST = 2000, 2000  # hulls that are compared at a time; that people labelled here, evenly chosen of more
_TRIED = 500  # hulls, evenly chosen, by which the nearest kinds are found
_DIGITS = 3


class LikeMismatchError(UsageError):
    """A family of another kind was named. kinds: families that ship, the nearest first, and the median distance."""

    kinds: tuple[tuple[str, float], ...] = ()


class LikeLabeler(Labeler):
    """Labels hulls by the labelled assets of another project, or of a family that ships; labels of people, files, names
    and other machines stay. None is sure before a person gave a label of that name here.

    source: a project's folder, or `sample:cups`; None for the families that the project keeps. words: the label here
    for a label there, empty for none, where synonyms do not say it. Raises UsageError: no such family, or one of
    another kind (`LikeMismatchError`); ProjectError: nothing is labelled there, or what is kept is damaged.
    """

    name = "like"
    about = "labels of another project or of a bundled family, named by --like"

    def __init__(self, source: str | Path | None = None, words: Mapping[str, str] | None = None) -> None:
        self.source, self.words = str(source) if source else None, dict(words or {})
        self.fresh: tuple[str, LikeReference] | None = None  # the other family as it was read, for the project to keep

    def propose(self, family: LabelFamily) -> LabelProposal:
        known, notes = read_references(family.store), list[str]()
        if self.source:
            name, reference, notes = read_family(self.source, family, self.words)
            for one, kept in known.items():
                if one != name:
                    notes.append(f"{one} counts, too; to leave it out, remove {family.store.layout.like(one)}")
                elif kept.source != reference.source:
                    notes.append(f"{one} was {kept.source} before")
            self.fresh, known = (name, reference), dict(sorted((known | {name: reference}).items()))
        if not known or (self.words and not self.source):
            remedy = "Name a project's folder, or a family that ships: --like sample:cups"
            raise UsageError("nothing says whose labels to take", where=str(family.store.folder), remedy=remedy)
        words = (word for one in known.values() for word in one.words.values() if word)
        family = replace(family, vocabulary=family.vocabulary or tuple(dict.fromkeys(words)))
        described = {name: one.describe_assets(name, family.vocabulary) for name, one in known.items()}
        beside = [asset for assets in described.values() for asset in assets]
        compared = compare_assets(family, lambda _, current: _choose_given(current), beside)
        found = _LikeComparison(family, compared, tuple(name for name in described for _ in described[name]))
        if self.fresh:
            found.check_kind(self.fresh[0])
        return LabelProposal(found.label_assets(), compared.next, vocabulary=family.vocabulary, notes=tuple(notes))

    def can_replace(self, current: Label | None, given: Label | None) -> bool:
        return can_fill_gap(current, given)


@dataclass(frozen=True, eq=False)
class _LikeComparison:
    """The hulls of a project beside those of others, which come last. names: the family of each of the other assets."""

    family: LabelFamily
    compared: FamilyComparison
    names: tuple[str, ...]

    @cached_property
    def _own(self) -> int:
        """How many hulls are of the project."""
        return int(np.searchsorted(self.compared.found.table.owner, len(self.compared.assets)))

    def _find_nearest(self, hulls: Ints) -> tuple[Ints, Floats, float]:
        """The nearest of some hulls to each of the project's, how far it is, and how far one of these may be."""
        table = self.compared.found.table
        rows = table.rows[hulls] * table.metric
        places, apart = find_nearest(table.rows[: self._own], rows, table.metric)
        return hulls[places], apart, measure_bound(rows, table.owner[hulls])

    @cached_property
    def _apart(self) -> dict[str, tuple[Floats, float]]:
        """How far each hull of the project is from the nearest labelled one of each other family, and may be."""
        found = self.compared.found
        names = np.array([*("" for _ in self.compared.assets), *self.names])[found.table.owner]
        return {
            name: self._find_nearest(np.flatnonzero((names == name) & found.seen.known))[1:]
            for name in dict.fromkeys(self.names)
        }

    def check_kind(self, name: str) -> None:
        """Raise LikeMismatchError where most hulls are farther from the family of a name than it spreads itself."""
        (apart, bound), store = self._apart[name], self.family.store
        if not len(apart) or np.median(apart) * WIDER <= bound:
            return
        kinds = self._rank_kinds()
        project, asset = quote_path(store.folder), quote_path(Path(self.compared.assets[0]))
        sample = quote_path(find_sample(kinds[0][0])[1][0].path)
        pictures = f"meshforge render {asset} --project {project} -o own.png && meshforge render {sample} -o sample.png"
        error = LikeMismatchError(
            f"most hulls are farther from those of {name} than these are from each other: it is of another kind",
            where=str(store.folder),
            remedy=f"Of the families that ship, the nearest are {join_and([kind for kind, _ in kinds[:3]])}, in this "
            f"order. Compare: {pictures}",
        )
        error.kinds = kinds
        raise error

    def _rank_kinds(self) -> tuple[tuple[str, float], ...]:
        table, found = self.compared.found.table, dict[str, float]()
        own = table.rows[: self._own : self._own // _TRIED + 1]
        for kind in (one.name for one in FAMILIES):
            assets, _ = describe_files(find_sample(kind)[1], self.family)
            rows = table.scale(np.array([row for asset in assets for row in asset.rows])) * table.metric
            found[kind] = round(float(np.median(find_nearest(own, rows, table.metric)[1])), 2)
        return tuple(sorted(found.items(), key=lambda item: item[1]))

    def label_assets(self) -> Generator[AssetLabels, None, None]:
        """Yield the labels of each asset of the project."""
        every, compared = self._choose_labels(), self.compared
        spans = {asset: compared.found.table.spans.get(place, slice(0)) for place, asset in enumerate(compared.assets)}
        for asset in self.family.store.assets():
            if asset in compared.lost:
                yield AssetLabels(asset, error=compared.lost[asset])
                continue
            hulls, current = compared.hulls[asset], compared.current[asset]
            rows = [(hull, *one) for hull, one in zip(hulls, every[spans[asset]], strict=True)]
            free = {hull for hull in hulls if can_fill_gap(current.get(hull), None)}
            given = {hull: label for hull, label, _ in rows if label or hull in free & current.keys()}
            bare = {hull: why for hull, label, why in rows if not label and hull in free}
            yield AssetLabels(asset, hulls, given, {hull: (why, hull) for hull, _, why in rows}, open=bare)

    def _choose_labels(self) -> list[tuple[Label | None, str]]:
        """The label of each hull of the project, None for none; and why it has that, or none."""
        seen, words, names = self.compared.found.seen, self.compared.found.seen.labels, join_names([*self._apart])
        chances = self.compared.found.chances[: self._own]
        order = np.argsort(-chances, axis=1, kind="stable")
        first, chance = order[:, 0], chances.max(axis=1)
        sure = to_confidence(chance, "like")
        near = np.any([apart <= bound for apart, bound in self._apart.values()], axis=0)
        confirmed = np.zeros_like(near)
        if len(people := np.flatnonzero(seen.fixed)):
            hulls, apart, _ = self._find_nearest(people[:: len(people) // _MOST + 1])
            apart /= max(bound for _, bound in self._apart.values())
            near |= apart <= 1
            confirmed = (apart * WIDER <= 1) & (seen.codes[hulls] == first) & (chance >= _CERTAIN)
        found = list[tuple[Label | None, str]]()
        for hull, word in enumerate(words[code] for code in first.tolist()):
            if not near[hull]:
                found.append((None, f"like nothing in {names}"))
            elif word not in self.family.vocabulary:
                found.append((None, f"like {word}"))
            elif chance[hull] < _CLEAR:
                found.append((None, f"as like {word} as {words[order[hull, 1]]}"))
            else:
                most = 1.0 if confirmed[hull] else MOST_LIKELY
                found.append((Label(word, round(min(float(sure[hull]), most), _DIGITS), "like"), f"like {names}"))
        return found


def _choose_given(current: HullLabels) -> HullLabels:
    return {hull: label for hull, label in current.items() if reference_label(label)}


def find_nearest(rows: Floats, others: Floats, metric: Floats) -> tuple[Ints, Floats]:
    """Return the place of the nearest of some weighted rows to each row, and how far it is, by all processors."""
    from scipy.spatial.distance import cdist  # lazy: 0.5 s, half of all imports

    def compare(start: int) -> tuple[Ints, Floats]:
        gaps = cdist(rows[start : start + _AT_ONCE] * metric, others, "cityblock")
        return gaps.argmin(axis=1), gaps.min(axis=1)

    with ThreadPoolExecutor() as pool:
        found = [*pool.map(compare, range(0, len(rows), _AT_ONCE)), (np.zeros(0, np.int64), np.zeros(0))]
    return np.concatenate([places for places, _ in found]), np.concatenate([gaps for _, gaps in found])


def measure_bound(rows: Floats, owner: Ints) -> float:
    """Return how far a hull may be from the nearest of a family; of one asset, as far as hulls that look alike are."""
    if len(assets := np.unique(owner)) < 2:
        return WIDER * _ALIKE[1]
    nearest = [find_nearest(rows[owner == one], rows[owner != one], np.ones(1))[1] for one in assets.tolist()]
    return WIDER * max(float(np.quantile(np.concatenate(nearest), _WITHIN)), _ALIKE[0])
