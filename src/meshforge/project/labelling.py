"""Labels of a project: merged so that what a person said is never overwritten by a machine, with a report."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.batch import labels_for
from meshforge.errors import MeshForgeError, ProjectError, nearest
from meshforge.files import write_atomically
from meshforge.symbolic import (
    HUMAN_SOURCES,
    Label,
    LabelFile,
    Source,
    SymbolicMesh,
    follow_labels,
    read_labels,
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


def take_over(project: Project, source: Path | None) -> tuple[Labelled, ...]:
    """Take over the labels file of each asset that has one; a problem with one asset is told in its report.

    source: a file for a single asset, a folder that mirrors the assets; None for those beside them.

    A project without a vocabulary takes that of the files, in the order of their mention.
    """
    given = {asset: labels_for(path, source, project.found.base) for asset, path in project.found.ids.items()}
    files = {asset: read_labels(path) for asset, path in given.items() if path}
    if not files:
        raise ProjectError(
            "there is no labels file for any asset",
            where=str(project.folder),
            remedy="Put a labels file beside each asset, or name a folder of them that mirrors the assets.",
        )
    if not project.vocabulary:
        project.set_vocabulary(_vocabulary(files.values()))
    with project.lock():
        return tuple(_taken_over(project, asset, file) for asset, file in files.items())


def _taken_over(project: Project, asset: str, file: LabelFile) -> Labelled:
    try:
        mesh = project.mesh(asset)
    except MeshForgeError as error:
        return Labelled(asset, problems=(error.message,))
    followed = follow_labels(file, mesh.labelled(dict.fromkeys(mesh.index)))
    missing = {name: file.labels[name] for name in followed.gone}
    labelled, report = merged(asset, mesh, missing | followed.mesh.labels, project.vocabulary)
    if report.taken:
        write_merged(project, asset, labelled)
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


def _vocabulary(files: Iterable[LabelFile]) -> tuple[str, ...]:
    names = [name for file in files for name in (*file.vocabulary, *(label.name for label in file.labels.values()))]
    return tuple(dict.fromkeys(names))


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
