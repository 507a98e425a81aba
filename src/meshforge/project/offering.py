"""Labels that are there to be taken, in files beside the assets and in names, told without reading any asset."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from meshforge.batch import labels_for
from meshforge.errors import MeshForgeError
from meshforge.files import changed_at
from meshforge.formats import labels_beside
from meshforge.project.labelling import is_kept
from meshforge.project.naming import named_labels
from meshforge.project.survey import Facts, survey
from meshforge.symbolic import Label, label_homes, read_labels

if TYPE_CHECKING:
    from meshforge.project.project import Project


@dataclass(frozen=True, slots=True)
class Offered:
    """Labels that could be taken. files: assets whose labels file says something that is not taken yet.

    names: by asset and hull, what the names of hulls without a label say.
    """

    files: tuple[str, ...] = ()
    names: Mapping[str, Mapping[str, str]] = field(default_factory=dict)


class Offers:
    """What assets offer, remembered until a file of theirs or the vocabulary changes."""

    def __init__(self) -> None:
        self._known: dict[str, tuple[object, _Offer]] = {}

    def of(self, project: Project, only: Collection[str] | None = None) -> Offered:
        """What all assets offer, or some; those that cannot be read, or whose labels cannot, are left out."""
        vocabulary, rows = project.vocabulary, {}
        for asset, facts in survey(project.found, project.layout, only).items():
            places = (project.layout.labels(asset), labels_beside(project.path(asset)))
            state = (vocabulary, facts.times, facts.preparation, *map(changed_at, places))
            before, rows[asset] = self._known.get(asset, (None, _Offer()))
            if before != state:
                rows[asset] = _offer(project, asset, facts, vocabulary)
                self._known[asset] = state, rows[asset]
        files = tuple(asset for asset, offer in rows.items() if offer.file)
        return Offered(files, {asset: offer.names for asset, offer in rows.items() if offer.names})


@dataclass(frozen=True, slots=True)
class _Offer:
    """The same of one asset."""

    file: bool = False
    names: Mapping[str, str] = field(default_factory=dict)


def _offer(project: Project, asset: str, facts: Facts, vocabulary: tuple[str, ...]) -> _Offer:
    try:
        present = label_homes(project.labels(asset), facts.hulls).labels
    except MeshForgeError:
        return _Offer()
    bodies = zip(facts.hulls, facts.bodies, strict=True)
    names = named_labels({name: body for name, body in bodies if name not in present}, vocabulary)
    return _Offer(not facts.error and _has_news(project, asset, facts, present, vocabulary), names)


def _has_news(
    project: Project, asset: str, facts: Facts, present: Mapping[str, Label], vocabulary: Collection[str]
) -> bool:
    """Whether its labels file would change a label; one that cannot be read does, so that a person is told why."""
    path = labels_for(project.path(asset), None, project.found.base)
    try:
        given = label_homes(read_labels(path), facts.hulls).labels if path else {}
    except MeshForgeError:
        return True
    news = ((present.get(name), label) for name, label in given.items() if not vocabulary or label.name in vocabulary)
    return any(now != label and not is_kept(now, label) for now, label in news)
