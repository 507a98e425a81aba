"""Labels of a project: merged so that what a person said is never overwritten by a machine, with a report."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from meshforge.errors import ProjectError, nearest
from meshforge.files import write_atomically
from meshforge.geometry import digest
from meshforge.symbolic import HUMAN_SOURCES, Label, LabelFile, Source, SymbolicMesh, label_homes, labels_text
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
        labelled, report = merged(asset, mesh.index, mesh.labels, given, vocabulary)
        gone = [f"there is no hull {name!r}{_hint(name, mesh.index)}" for name in away if name not in mesh.index]
        problems = [*report.problems, *gone]
        if problems:
            remedy = f"The vocabulary is: {', '.join(vocabulary) or 'empty'}."
            raise ProjectError(problems[0], where=asset, remedy=remedy)
        kept = {name: label for name, label in labelled.items() if name not in away}
        write_merged(project, asset, digests(mesh), kept, vocabulary)
    return report


def digests(mesh: SymbolicMesh) -> dict[str, str]:
    """The digests of all hulls of a mesh by name, in order."""
    return {hull.name: digest(hull.shape) for hull in mesh.hulls}


def write_merged(
    project: Project,
    asset: str,
    hulls: Mapping[str, str],
    labels: Mapping[str, Label],
    vocabulary: Sequence[str],
    away: Collection[str] = (),
) -> None:
    """Write labels of an asset; those of hulls that are gone stay in the file, since hulls may come back.

    hulls: the digests of all, by name, in order; away: names of hulls that are gone whose labels do not stay.
    """
    path = project.layout.labels(asset)
    present = {name: labels[name] for name in hulls if name in labels}
    text = labels_text(LabelFile(tuple(vocabulary), present, hulls))
    if gone := [name for name in label_homes(project.labels(asset), hulls).gone if name not in away]:
        old, new = json.loads(path.read_text(encoding="utf-8")), json.loads(text)
        new["hulls"] |= {name: old["hulls"][name] for name in gone}
        new["vocabulary"] = list(dict.fromkeys([*new["vocabulary"], *old.get("vocabulary", [])]))
        text = json.dumps(new, ensure_ascii=False, indent=2) + "\n"
    write_atomically(path, text)


def merged(
    asset: str,
    hulls: Collection[str],
    current: Mapping[str, Label],
    given: Mapping[str, Label],
    vocabulary: Sequence[str],
) -> tuple[dict[str, Label], Labelled]:
    """The labels of an asset with those that may be taken, and what became of each of these.

    hulls: the names of all; current: the labels that there are, by hull.
    """
    taken, same, kept, problems = dict[str, Label](), 0, 0, list[str]()
    for name, label in given.items():
        if problem := _problem(name, label, hulls, vocabulary):
            problems.append(problem)
        elif current.get(name) == label:
            same += 1
        elif is_kept(current.get(name), label):
            kept += 1
        else:
            taken[name] = label
    labels = {**current, **taken}
    unsure = sum(label.confidence < UNSURE for label in labels.values())
    return labels, Labelled(asset, len(taken), same, kept, len(hulls) - len(labels), unsure, tuple(problems))


def is_kept(current: Label | None, given: Label) -> bool:
    """Whether a label stays though another one is given: a machine's does not take the place of a person's."""
    return current is not None and current.source in HUMAN_SOURCES and given.source not in HUMAN_SOURCES


def _problem(name: str, label: Label, hulls: Collection[str], vocabulary: Sequence[str]) -> str | None:
    if name not in hulls:
        return f"there is no hull {name!r}{_hint(name, hulls)}"
    if label.name not in vocabulary:
        return f"{name}: the label {label.name!r} is not in the vocabulary{_hint(label.name, vocabulary)}"
    return None


def _hint(name: str, available: Collection[str]) -> str:
    like = nearest(name, available)
    return f"; did you mean {like!r}?" if like else ""
