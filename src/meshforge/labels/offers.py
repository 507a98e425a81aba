"""Labels that are there to be taken, in files beside the assets and in names, found without reading any asset."""

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

from meshforge.common import MeshForgeError, file_state
from meshforge.labels.from_files.label_by_files import kind_of, label_file_beside
from meshforge.labels.merge import is_protected
from meshforge.labels.names.label_by_names import NamePattern, match_names, name_patterns, names_of_facts, to_label
from meshforge.labels.names.words import synonyms
from meshforge.store import AssetFacts, Store, iterate_asset_index
from meshforge.symbolic import CLASS_SOURCES, HUMAN_SOURCES, NO_PART, Label, match_labels, read_labels


@dataclass(frozen=True, slots=True)
class LabelOffers:
    """Labels that could be taken. files: assets beside which a file says something that is not taken yet.

    names: by asset and hull, what the names of hulls without a label say.
    """

    files: tuple[str, ...] = ()
    names: Mapping[str, Mapping[str, str]] = field(default_factory=dict)

    @property
    def named(self) -> int:
        """How many hulls without a label have names that say one."""
        return sum(map(len, self.names.values()))


class OfferCache:
    """What assets offer, remembered until a file of theirs or the vocabulary changes."""

    def __init__(self) -> None:
        self._known: dict[str, tuple[object, _AssetOffer]] = {}

    def of(self, store: Store, only: Collection[str] | None = None) -> LabelOffers:
        """Return what all assets offer, or some; those that cannot be read, or whose labels cannot, are left out.

        Raises UsageError: a pattern of the project that makes no sense.
        """
        settings, rows = store.settings, dict[str, _AssetOffer]()
        vocabulary, meanings = settings.vocabulary, tuple(settings.names.items())
        patterns = name_patterns(store.folder, settings, vocabulary) if vocabulary else ()
        for asset, facts in iterate_asset_index(store.found, store.layout, only):
            file, labels = label_file_beside(store.path(asset)), store.layout.labels(asset)
            times = (file_state(labels), file, file_state(file) if file else None)
            state = (vocabulary, meanings, facts.files, facts.preparation, *times)
            before, rows[asset] = self._known.get(asset, (None, _AssetOffer()))
            if before != state:
                rows[asset] = _find_offer(store, asset, facts, vocabulary, patterns)
                self._known[asset] = state, rows[asset]
        files = tuple(asset for asset, offer in rows.items() if offer.file)
        return LabelOffers(files, {asset: offer.names for asset, offer in rows.items() if offer.names})


_AGREEING = 0.5  # of the hulls of a class whose names say a part, those that must say the same one


def propose_class_names(store: Store) -> dict[str, str | None]:
    """Return the classes of a project, each with the part that the names of most of its hulls say; None where they say
    none, or that of another class too."""
    votes, words = dict[str, Counter[str]](), tuple(synonyms())
    for asset, facts in iterate_asset_index(store.found, store.layout, store.layout.classes.ids):
        classes = store.labels_and_classes(asset).labels
        for names in () if facts.error else names_of_facts(facts):
            label = classes.get(names.hull)
            if label and label.source in CLASS_SOURCES and label.name != NO_PART:
                found = match_names(names, words)
                votes.setdefault(label.name, Counter()).update([found.label] if found and found.label else [])
    best = {name: next(iter(some.most_common(1)), ("", 0)) for name, some in sorted(votes.items())}
    agreed = {name: word for name, (word, count) in best.items() if count > _AGREEING * votes[name].total()}
    once = Counter(agreed.values())
    return {name: word if (word := agreed.get(name)) and once[word] == 1 else None for name in best}


@dataclass(frozen=True, slots=True)
class _AssetOffer:
    file: bool = False
    names: Mapping[str, str] = field(default_factory=dict)


def _find_offer(
    store: Store, asset: str, facts: AssetFacts, vocabulary: tuple[str, ...], patterns: Sequence[NamePattern]
) -> _AssetOffer:
    try:
        present = match_labels(store.labels(asset), facts.hulls).labels
    except MeshForgeError:
        return _AssetOffer()
    bare = (names for names in names_of_facts(facts) if names.hull not in present)
    observed = ((names.hull, match_names(names, vocabulary, patterns)) for names in bare)
    names = {hull: label.name for hull, one in observed if one and (label := to_label(one))}
    return _AssetOffer(not facts.error and _has_news(store, asset, facts, present, vocabulary), names)


def _has_news(
    store: Store, asset: str, facts: AssetFacts, present: Mapping[str, Label], vocabulary: Collection[str]
) -> bool:
    """Whether its labels file would change a label; one that cannot be read does, so that a person is told why.

    Of points, whether nothing was taken from a file yet.
    """
    path = label_file_beside(store.path(asset))
    if path and kind_of(path) != "labels file":
        sources = {label.source for label in present.values()}
        return "file" not in sources and (len(present) < len(facts.hulls) or not sources <= HUMAN_SOURCES)
    try:
        given = match_labels(read_labels(path), facts.hulls).labels if path else {}
    except MeshForgeError:
        return True
    news = ((present.get(name), label) for name, label in given.items() if not vocabulary or label.name in vocabulary)
    return any(now != label and not is_protected(now, label) for now, label in news)
