"""Labels of a project: merged so that what a person said is never overwritten by a machine, with a report."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from meshforge.errors import ProjectError, nearest
from meshforge.files import write_atomically
from meshforge.symbolic import (
    HUMAN_SOURCES,
    Label,
    Source,
    SymbolicMesh,
    follow_labels,
    write_labels,
)
from meshforge.views import UNSURE

if TYPE_CHECKING:
    from meshforge.project.project import Project


@dataclass(frozen=True, slots=True)
class Labelled:
    """What became of labels that were given to one asset; all but `asset` and `problems` are numbers of labels.

    taken: written; same: those the hulls have already; kept: not written, since a person's label stands there.
    problems: a sentence for each label that was left out; unlabelled: hulls that still have none; unsure: those whose
    label is less certain than not.
    """

    asset: str
    taken: int = 0
    same: int = 0
    kept: int = 0
    unlabelled: int = 0
    unsure: int = 0
    problems: tuple[str, ...] = ()


def give(project: Project, asset: str, labels: Mapping[str, str | None], source: Source, confidence: float) -> Labelled:
    """Write labels of one asset, or take them away by None.

    Raises ProjectError for a hull that is not there or a label out of the vocabulary; then nothing is written.
    """
    given = {name: Label(label, confidence, source) for name, label in labels.items() if label is not None}
    away = [name for name, label in labels.items() if label is None]
    with project.lock():
        mesh, vocabulary = project.mesh(asset), project.vocabulary
        labelled, report = merged(asset, mesh, given, vocabulary)
        gone = [f"there is no hull {name!r}{_hint(name, mesh.index)}" for name in away if name not in mesh.index]
        problems = [*report.problems, *gone]
        if problems:
            remedy = f"The vocabulary is: {', '.join(vocabulary) or 'empty'}."
            raise ProjectError(problems[0], where=asset, remedy=remedy)
        write_merged(project, asset, labelled.labelled(dict.fromkeys(away)))
    return report


def write_merged(project: Project, asset: str, mesh: SymbolicMesh, away: Collection[str] = ()) -> None:
    """Write the labels of a mesh; those of hulls that are gone stay in the file, since hulls may come back.

    away: names of hulls whose labels do not stay.
    """
    path = project.layout.labels(asset)
    gone = [name for name in follow_labels(project.labels(asset), mesh).gone if name not in away]
    if not gone:
        write_labels(path, mesh, project.vocabulary)
        return
    old, new = json.loads(path.read_text(encoding="utf-8")), json.loads(write_labels(None, mesh, project.vocabulary))
    new["hulls"] |= {name: old["hulls"][name] for name in gone}
    new["vocabulary"] = list(dict.fromkeys([*new["vocabulary"], *old.get("vocabulary", [])]))
    write_atomically(path, json.dumps(new, ensure_ascii=False, indent=2) + "\n")


def merged(
    asset: str, mesh: SymbolicMesh, given: Mapping[str, Label], vocabulary: Sequence[str]
) -> tuple[SymbolicMesh, Labelled]:
    """The mesh with the labels that may be taken, and what became of each of them."""
    taken, same, kept, problems = {}, 0, 0, []
    for name, label in given.items():
        problem = _problem(name, label, mesh, vocabulary)
        current = mesh.named(name).annotation if name in mesh.index else None
        if problem:
            problems.append(problem)
        elif current == label:
            same += 1
        elif is_kept(current, label):
            kept += 1
        else:
            taken[name] = label
    labelled = mesh.labelled(taken)
    bare = sum(hull.label is None for hull in labelled.hulls)
    unsure = sum(hull.confidence is not None and hull.confidence < UNSURE for hull in labelled.hulls)
    return labelled, Labelled(asset, len(taken), same, kept, bare, unsure, tuple(problems))


def is_kept(current: Label | None, given: Label) -> bool:
    """Whether a label stays though another one is given: a machine's does not take the place of a person's."""
    return current is not None and current.source in HUMAN_SOURCES and given.source not in HUMAN_SOURCES


def _problem(name: str, label: Label, mesh: SymbolicMesh, vocabulary: Sequence[str]) -> str | None:
    if name not in mesh.index:
        return f"there is no hull {name!r}{_hint(name, mesh.index)}"
    if label.name not in vocabulary:
        return f"{name}: the label {label.name!r} is not in the vocabulary{_hint(label.name, vocabulary)}"
    return None


def _hint(name: str, available: Mapping[str, int] | Sequence[str]) -> str:
    like = nearest(name, available)
    return f"; did you mean {like!r}?" if like else ""
