"""Labels that names and files would give, put together to be looked at before they are taken."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from meshforge.batch import Spread
from meshforge.errors import MeshForgeError
from meshforge.perception.names import Names, Told, told
from meshforge.project.labels.name_patterns import Meanings
from meshforge.project.labels.naming import as_label, checked_patterns, names_of
from meshforge.project.survey import surveyed
from meshforge.symbolic import Label, label_homes
from meshforge.views import UNSURE

if TYPE_CHECKING:
    from meshforge.project.project import Project


@dataclass(frozen=True, slots=True)
class Evidence:
    """The label of one hull, None for one that is left without, and what says so: of what kind, and its name.

    kind: `hull`, `body` or another one of names, with ` by pattern` or ` nearly` behind it, or the kind of a file.
    """

    asset: str
    label: Label | None
    kind: str
    name: str


@dataclass(frozen=True, slots=True)
class Proposal:
    """Hulls that would get the same label, None for none, for the like reason.

    names: those that say so, the most frequent first; hulls, assets: how many there are, and in how many assets;
    low, high: how sure the label is.
    """

    label: str | None
    kind: str
    names: tuple[str, ...]
    hulls: int
    assets: int
    low: float
    high: float

    @property
    def is_unsure(self) -> bool:
        return self.label is not None and self.low < UNSURE


@dataclass(frozen=True, slots=True)
class Proposals:
    """What would be taken, and what would be left without a label; problems: a sentence on each thing left out.

    labelled: hulls whose label stays.
    """

    rows: tuple[Proposal, ...]
    left: tuple[Proposal, ...]
    labelled: int = 0
    problems: tuple[str, ...] = ()


def from_names(project: Project, meanings: Meanings, vocabulary: Sequence[str] | None, spread: Spread) -> Proposals:
    """What names would give, told from the survey; vocabulary: that to be tried, the project's when None.

    Raises as `label_from_names`.
    """
    words = project.vocabulary if vocabulary is None else tuple(vocabulary)
    patterns = checked_patterns(project, words, meanings)
    found, problems, labelled = list[Evidence](), list[str](), 0
    for asset, facts in surveyed(project.found, project.layout, spread=spread):
        try:
            present = label_homes(project.labels(asset), facts.hulls).labels
        except MeshForgeError as error:
            problems.append(f"{asset}: {error.message}")
            continue
        problems += [f"{asset}: {facts.error}"] if facts.error else []
        labelled += len(present)
        found += [
            _evidence(asset, names, told(names, words, patterns))
            for names in names_of(facts)
            if names.hull not in present
        ]
    return proposals(found, words, labelled, problems)


def _evidence(asset: str, names: Names, one: Told | None) -> Evidence:
    if one is None:
        return Evidence(asset, None, "nothing said", names.own)
    suffix = {"pattern": " by pattern", "likeness": " nearly", "word": ""}[one.how]
    return Evidence(asset, as_label(one), one.kind + suffix, one.name)


def proposals(
    found: Iterable[Evidence], vocabulary: Sequence[str], labelled: int, problems: Iterable[str]
) -> Proposals:
    """All evidence, put together by label, kind and whether it is sure; in the order of the vocabulary."""
    groups: dict[tuple[str | None, str, bool], list[Evidence]] = {}
    for one in found:
        unsure = one.label is not None and one.label.confidence < UNSURE
        name = one.label.name if one.label else None
        groups.setdefault((name, one.kind, unsure), []).append(one)
    rows = [_proposal(key[0], key[1], group) for key, group in groups.items()]
    order = {label: k for k, label in enumerate(vocabulary)}
    rows.sort(key=lambda row: (order.get(row.label or "", len(order)), row.is_unsure, -row.hulls, row.kind))
    return Proposals(
        tuple(row for row in rows if row.label is not None),
        tuple(row for row in rows if row.label is None),
        labelled,
        tuple(problems),
    )


def _proposal(label: str | None, kind: str, group: Sequence[Evidence]) -> Proposal:
    names = Counter(one.name for one in group)
    sure = list(_confidences(group)) or [0.0]
    ordered = sorted(names, key=lambda name: (-names[name], name))
    assets = len({one.asset for one in group})
    return Proposal(label, kind, tuple(ordered), len(group), assets, min(sure), max(sure))


def _confidences(group: Iterable[Evidence]) -> Iterator[float]:
    return (one.label.confidence for one in group if one.label)
