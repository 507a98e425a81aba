"""How many hulls of a project have which labels: from where, and how sure."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from meshforge.errors import MeshForgeError
from meshforge.project.survey import survey
from meshforge.symbolic import SOURCES, label_homes
from meshforge.views import UNSURE

if TYPE_CHECKING:
    from meshforge.project.project import Project

SURE = 0.9
"""Labels as certain as this are sure; those below `UNSURE` are not."""


@dataclass(frozen=True, slots=True)
class Share:
    """The labels of one source: how many are sure, likely and unsure."""

    source: str
    sure: int = 0
    likely: int = 0
    unsure: int = 0


@dataclass(frozen=True, slots=True)
class Tally:
    """All hulls of the assets that can be read. shares: of the sources that have labels here, in their order.

    doubtful: the assets with hulls that have no label or an unsure one, and how many, most first; unreadable: those
    that cannot be read, or whose labels cannot, and why.
    """

    hulls: int
    unlabelled: int
    shares: tuple[Share, ...]
    doubtful: tuple[tuple[str, int], ...]
    unreadable: tuple[tuple[str, str], ...] = ()


def tally(project: Project, progress: Callable[[], None] | None = None) -> Tally:
    """Count, as far as assets and their labels can be read."""
    counts = {source: [0, 0, 0] for source in SOURCES}
    hulls = unlabelled = 0
    doubtful: dict[str, int] = {}
    unreadable: dict[str, str] = {}
    for asset, facts in survey(project.found, project.layout, progress=progress).items():
        if facts.error:
            unreadable[asset] = facts.error
            continue
        try:
            labels = label_homes(project.labels(asset), facts.hulls).labels.values()
        except MeshForgeError as error:
            unreadable[asset] = error.message
            continue
        levels = [(label.confidence < SURE) + (label.confidence < UNSURE) for label in labels]
        for label, level in zip(labels, levels, strict=True):
            counts[label.source][level] += 1
        hulls += len(facts.hulls)
        unlabelled += len(facts.hulls) - len(labels)
        doubtful[asset] = len(facts.hulls) - len(labels) + levels.count(2)
    shares = tuple(Share(source, *levels) for source, levels in counts.items() if any(levels))
    order = sorted((asset for asset, count in doubtful.items() if count), key=lambda asset: -doubtful[asset])
    return Tally(
        hulls, unlabelled, shares, tuple((asset, doubtful[asset]) for asset in order), tuple(unreadable.items())
    )
