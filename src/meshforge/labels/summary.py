"""How far a project is labelled, counted by source and confidence, and planned in words; and the command that labels by
hand, for messages that propose it."""

import shlex
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from meshforge import rendering
from meshforge.common import MeshForgeError, UsageError, join_names, quote_path
from meshforge.labels.names.label_by_names import NamePattern, match_names, name_patterns, names_of_facts
from meshforge.store import AssetFacts, Store, iterate_asset_index
from meshforge.symbolic import HUMAN_SOURCES, LABEL_SOURCES, Label, match_labels

SURE = 0.9
"""Labels as certain as this are sure; those below `UNSURE` are not."""


@dataclass(frozen=True, slots=True)
class SourceTally:
    """The labels of one source: how many are sure, likely and unsure."""

    source: str
    sure: int = 0
    likely: int = 0
    unsure: int = 0


@dataclass(frozen=True, slots=True)
class Tally:
    """All hulls of the assets that can be read. shares: of the sources that have labels here, in their order.

    doubtful: the assets with hulls that have no label or an unsure one, and how many, most first; unreadable: those
    that cannot be read, or whose labels cannot, and why; contradictions: labels that a name speaks against.
    """

    hulls: int
    unlabelled: int
    shares: tuple[SourceTally, ...]
    doubtful: tuple[tuple[str, int], ...]
    unreadable: tuple[tuple[str, str], ...] = ()
    contradictions: "tuple[NameContradiction, ...]" = ()

    def describe_contradictions(self) -> str:
        """Return how many labels contradict a name, with the first three; nothing where none does."""
        if not (found := self.contradictions):
            return ""
        named = [f"{one.hull} of {one.asset} is {one.label}, {one.name!r} says {one.means}" for one in found]
        what = "1 label contradicts a name" if len(found) == 1 else f"{len(found):,} labels contradict names"
        return f"{what}: {join_names(named, most=3)}"


@dataclass(frozen=True, slots=True)
class NameContradiction:
    """A label that no person and no file gave, and another one whose word or pattern is in a name of the hull."""

    asset: str
    hull: str
    label: str
    name: str
    means: str


def tally_labels(store: Store, progress: Callable[[], None] | None = None) -> Tally:
    """Count hulls by the source and confidence of their labels, as far as assets and their labels can be read."""
    counts = {source: [0, 0, 0] for source in LABEL_SOURCES}
    hulls = unlabelled = 0
    doubtful: dict[str, int] = {}
    unreadable: dict[str, str] = {}
    contradictions: list[NameContradiction] = []
    words, patterns = store.vocabulary, tuple[NamePattern, ...]()
    with suppress(UsageError):  # of a pattern that is wrong, which `label --with names` names
        patterns = name_patterns(store.folder, store.settings, words)
    for asset, facts in iterate_asset_index(store.found, store.layout, progress=progress):
        if facts.error:
            unreadable[asset] = facts.error
            continue
        try:
            by_hull = match_labels(store.labels_and_classes(asset), facts.hulls).labels
        except MeshForgeError as error:
            unreadable[asset] = error.message
            continue
        labels = by_hull.values()
        contradictions += _find_contradictions(asset, facts, by_hull, words, patterns)
        levels = [(label.confidence < SURE) + (label.confidence < rendering.UNSURE) for label in labels]
        for label, level in zip(labels, levels, strict=True):
            counts[label.source][level] += 1
        hulls += len(facts.hulls)
        unlabelled += len(facts.hulls) - len(labels)
        doubtful[asset] = len(facts.hulls) - len(labels) + levels.count(2)
    shares = tuple(SourceTally(source, *levels) for source, levels in counts.items() if any(levels))
    order = sorted((asset for asset, count in doubtful.items() if count), key=lambda asset: -doubtful[asset])
    return Tally(
        hulls,
        unlabelled,
        shares,
        tuple((asset, doubtful[asset]) for asset in order),
        tuple(unreadable.items()),
        tuple(contradictions),
    )


def _find_contradictions(
    asset: str,
    facts: AssetFacts,
    labels: Mapping[str, Label],
    vocabulary: Sequence[str],
    patterns: Sequence[NamePattern],
) -> Iterator[NameContradiction]:
    inferred = {hull: label for hull, label in labels.items() if label.source not in (*HUMAN_SOURCES, "file")}
    for names in names_of_facts(facts):
        label = inferred.get(names.hull)
        one = match_names(names, vocabulary, patterns) if label else None
        is_certain = one is not None and one.how in ("word", "pattern") and not one.is_unsure
        if label and one and is_certain and one.label not in (None, label.name):
            yield NameContradiction(asset, names.hull, label.name, one.name, one.label or "")


def label_command(folder: Path, asset: str, hull: str, vocabulary: Collection[str]) -> str:
    """Return the command that labels a hull of an asset of the project in a folder, as one types it here; LABEL stands
    for its label, and without a vocabulary `a,b,c` for that."""
    quoted = shlex.quote(f"{hull}=LABEL")
    words = "" if vocabulary else " --vocabulary a,b,c"
    what = quoted if quoted.startswith("'") else f"'{quoted}'"
    return f"meshforge label {quote_path(folder)} {shlex.quote(asset)} {what}{words}"
