"""What there is to be labelled, told before any asset is read."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.batch import AssetJob, plan
from meshforge.errors import AssetError
from meshforge.symbolic import HUMAN_SOURCES

if TYPE_CHECKING:
    from meshforge.project.project import Project


def planned(project: Project) -> str:
    """How many assets of what there are, how many have labels, and how many of these labels of a person."""
    layout, found = project.layout, project.found
    places = {asset: layout.labels(asset) for asset in found.ids}
    jobs = [
        AssetJob(asset, path, found.base, places[asset] if places[asset].exists() else None)
        for asset, path in found.ids.items()
    ]
    by_people = sum(_has_a_persons(project, job.id) for job in jobs if job.labels)
    return f"{plan(jobs, layout.edited).assets}, {by_people:,} of them by a person"


def _has_a_persons(project: Project, asset: str) -> bool:
    try:
        return any(label.source in HUMAN_SOURCES for label in project.labels(asset).labels.values())
    except AssetError:  # told when its turn comes
        return False
