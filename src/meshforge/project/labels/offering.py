"""Labels that are there to be taken, in files beside the assets and in names, told without reading any asset."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from meshforge.errors import MeshForgeError
from meshforge.files import changed_at
from meshforge.perception.names import Pattern, told
from meshforge.project.labels.from_files.finding import beside, kind_of
from meshforge.project.labels.labelling import is_kept
from meshforge.project.labels.name_patterns import name_patterns
from meshforge.project.labels.naming import as_label, names_of
from meshforge.project.survey import Facts, survey
from meshforge.symbolic import HUMAN_SOURCES, Label, label_homes, read_labels

if TYPE_CHECKING:
    from meshforge.project.project import Project


@dataclass(frozen=True, slots=True)
class Offered:
    """Labels that could be taken. files: assets beside which a file says something that is not taken yet.

    names: by asset and hull, what the names of hulls without a label say.
    """

    files: tuple[str, ...] = ()
    names: Mapping[str, Mapping[str, str]] = field(default_factory=dict)


class Offers:
    """What assets offer, remembered until a file of theirs or the vocabulary changes."""

    def __init__(self) -> None:
        self._known: dict[str, tuple[object, _Offer]] = {}

    def of(self, project: Project, only: Collection[str] | None = None) -> Offered:
        """What all assets offer, or some; those that cannot be read, or whose labels cannot, are left out.

        Raises UsageError: a pattern of the project that makes no sense.
        """
        settings, rows = project.settings, dict[str, _Offer]()
        vocabulary, meanings = settings.vocabulary, tuple(settings.names.items())
        patterns = name_patterns(project.folder, settings, vocabulary) if vocabulary else ()
        for asset, facts in survey(project.found, project.layout, only).items():
            file, labels = beside(project.path(asset)), project.layout.labels(asset)
            times = (changed_at(labels), file, changed_at(file) if file else None)
            state = (vocabulary, meanings, facts.times, facts.preparation, *times)
            before, rows[asset] = self._known.get(asset, (None, _Offer()))
            if before != state:
                rows[asset] = _offer(project, asset, facts, vocabulary, patterns)
                self._known[asset] = state, rows[asset]
        files = tuple(asset for asset, offer in rows.items() if offer.file)
        return Offered(files, {asset: offer.names for asset, offer in rows.items() if offer.names})


@dataclass(frozen=True, slots=True)
class _Offer:
    """The same of one asset."""

    file: bool = False
    names: Mapping[str, str] = field(default_factory=dict)


def _offer(
    project: Project, asset: str, facts: Facts, vocabulary: tuple[str, ...], patterns: Sequence[Pattern]
) -> _Offer:
    try:
        present = label_homes(project.labels(asset), facts.hulls).labels
    except MeshForgeError:
        return _Offer()
    bare = (names for names in names_of(facts) if names.hull not in present)
    said = ((names.hull, told(names, vocabulary, patterns)) for names in bare)
    names = {hull: label.name for hull, one in said if one and (label := as_label(one))}
    return _Offer(not facts.error and _has_news(project, asset, facts, present, vocabulary), names)


def _has_news(
    project: Project, asset: str, facts: Facts, present: Mapping[str, Label], vocabulary: Collection[str]
) -> bool:
    """Whether its labels file would change a label; one that cannot be read does, so that a person is told why.

    Of points, and of what is said of links, whether nothing was taken from a file yet.
    """
    path = beside(project.path(asset))
    if path and kind_of(path) != "labels file":
        sources = {label.source for label in present.values()}
        return "file" not in sources and (len(present) < len(facts.hulls) or not sources <= HUMAN_SOURCES)
    try:
        given = label_homes(read_labels(path), facts.hulls).labels if path else {}
    except MeshForgeError:
        return True
    news = ((present.get(name), label) for name, label in given.items() if not vocabulary or label.name in vocabulary)
    return any(now != label and not is_kept(now, label) for now, label in news)
