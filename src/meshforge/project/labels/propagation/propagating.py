"""Labels of a few assets carried to all others of the project."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import TYPE_CHECKING

from meshforge.batch import Spread
from meshforge.errors import AssetError, ProjectError
from meshforge.project.labels.labelling import Labelled
from meshforge.project.labels.propagation.comparing import Compared, compared
from meshforge.project.labels.propagation.sketches import Sketches
from meshforge.project.labels.propagation.stages import Stage
from meshforge.project.labels.proposing import Evidence, Proposals, proposals
from meshforge.project.labels.taking import Report, Taker, gives_way
from meshforge.project.survey import Facts, survey
from meshforge.symbolic import Label, LabelFile, label_homes

if TYPE_CHECKING:
    from meshforge.project.project import Project

Keeping = Callable[[str | None], AbstractContextManager[object]]
"""The block in which labels are written, when all is known; given the asset that would help most."""


@dataclass(frozen=True, slots=True)
class Carried:
    """What became of each asset, and which one would help most if it were labelled next; None: all are."""

    reports: tuple[Labelled, ...]
    next: str | None


def propagate(
    project: Project, spread: Spread, stage: Stage, report: Report, keeping: Keeping = nullcontext
) -> Carried:
    """Carry labels to all hulls that have none, or one that a machine was less sure of.

    stage: gives what is entered for each part of the work; keeping: the block in which all is written.
    Raises ProjectError: no vocabulary, or no label to begin with; StoppedError when it was told to stop.
    """
    said = _said(project, project.vocabulary, spread, stage)
    taker, reports = Taker(project), list[Labelled]()
    with keeping(said.next), stage(len(project.assets()), "labelling") as advance:
        for asset in project.assets():
            if why := said.lost.get(asset):
                reports.append(Labelled(asset, problems=(why,)))
            else:
                reports.append(taker.try_write(asset, said.hulls[asset], said.labels_of(asset), gives_way))
            report(reports[-1])
            advance()
    return Carried(tuple(reports), said.next)


def foretold(project: Project, vocabulary: Sequence[str] | None, spread: Spread, stage: Stage) -> Proposals:
    """What `propagate` would write, with nothing written; vocabulary: one to be tried. Raises as that."""
    words = project.vocabulary if vocabulary is None else tuple(vocabulary)
    said = _said(project, words, spread, stage)
    found, labelled = list[Evidence](), 0
    for asset in (asset for asset in project.assets() if asset not in said.lost):
        hulls, given = said.hulls[asset], said.labels_of(asset)
        current = label_homes(project.labels(asset), hulls).labels
        taken = {name: label for name, label in given.items() if is_taken(current.get(name), label)}
        found += [Evidence(asset, label, "likeness", name) for name, label in taken.items()]
        labelled += len(hulls) - len(taken)
    return proposals(found, words, labelled, said.lost.values())


def is_taken(current: Label | None, given: Label) -> bool:
    """Whether a label takes the place of another, or of none."""
    return current != given and gives_way(current, given)


@dataclass(frozen=True, eq=False)
class _Said:
    """What labels say of all assets. hulls: digests by name, in order, of those that could be read; lost: why others
    have no labels; next: the one that would help most if it were labelled."""

    hulls: Mapping[str, Mapping[str, str]]
    lost: Mapping[str, str]
    next: str | None
    found: Compared

    def labels_of(self, asset: str) -> dict[str, Label]:
        """The labels of an asset, by hull."""
        rows = zip(self.hulls[asset], self.found.labels(asset), strict=True)
        return {name: label for name, label in rows if label}


def _said(project: Project, vocabulary: Sequence[str], spread: Spread, stage: Stage) -> _Said:
    if not vocabulary:
        remedy = "Say first what hulls can be: --vocabulary a,b,c."
        raise ProjectError("the vocabulary is empty", where=str(project.folder), remedy=remedy)
    with stage(len(project.assets()), "reading") as advance:
        facts = survey(project.found, project.layout, spread=spread, progress=advance)
    lost = {asset: own.error for asset, own in facts.items() if own.error}
    told = dict[str, list[str | None]]()
    for asset, own in facts.items():
        try:
            told |= {asset: _told(project.labels(asset), own, vocabulary)} if asset not in lost else {}
        except AssetError as error:
            lost[asset] = error.message
    sketches = Sketches(project, {asset: facts[asset] for asset in told}, spread)
    hulls = {asset: facts[asset].hulls for asset in told}
    del facts
    found = compared(sketches, told, spread, stage)
    if not found.has_labels:
        remedy = (
            f"Label the hulls of one asset first, best {found.next}." if found.next else "Decompose the assets first."
        )
        raise ProjectError(
            "there is no label that others could be taken from", where=str(project.folder), remedy=remedy
        )
    return _Said(hulls, lost | found.lost, found.next, found)


def _told(file: LabelFile, facts: Facts, vocabulary: Sequence[str]) -> list[str | None]:
    """The labels of the hulls of an asset that others may be taken from."""
    from meshforge.perception.propagation import given_label

    labels = label_homes(file, facts.hulls).labels
    found = (given_label(labels.get(name)) for name in facts.hulls)
    return [name if name in vocabulary else None for name in found]
