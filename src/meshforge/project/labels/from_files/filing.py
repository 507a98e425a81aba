"""Labels taken over from files: labels files, segmented points and meshes, and what a dataset says of links."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.errors import MeshForgeError, ProjectError
from meshforge.project.labels.from_files.class_names import classes_said
from meshforge.project.labels.from_files.finding import kind_of, label_files
from meshforge.project.labels.from_files.given import Given
from meshforge.project.labels.from_files.links import link_labels, links_said
from meshforge.project.labels.from_files.points import Reading, point_labels
from meshforge.project.labels.labelling import Labelled, is_kept, merged, write_merged
from meshforge.project.labels.name_patterns import Meanings, name_patterns
from meshforge.project.labels.proposing import Evidence, Proposals, proposals
from meshforge.symbolic import SymbolicMesh, follow_labels, read_labels

if TYPE_CHECKING:
    from meshforge.perception.names import Pattern
    from meshforge.project.project import Project


@dataclass(frozen=True, slots=True)
class Filing:
    """How files are read. meanings: what names of classes mean, besides the patterns of the project, which they
    precede; reading: how segmented points are read."""

    meanings: Meanings = ()
    reading: Reading = field(default_factory=Reading)


def take_over(project: Project, source: Path | None, how: Filing) -> tuple[Labelled, ...]:
    """Take over what the file of each asset that has one says; a problem with one asset is told in its report.

    source: a file for a single asset, a folder that mirrors the assets; None for those beside them.
    A project without a vocabulary takes that of the files, in the order of their mention.
    Raises ProjectError: no file at all; AssetError: a labels file that is none; UsageError: a pattern that makes no
    sense, or one file for several assets.
    """
    files = _files(project, source)
    if not project.vocabulary:
        project.set_vocabulary(_vocabulary(files, how))
    vocabulary = project.vocabulary
    patterns = name_patterns(project.folder, project.settings, vocabulary, how.meanings)
    with project.lock():
        return tuple(_taken_over(project, asset, file, how, patterns) for asset, file in files.items())


def from_files(
    project: Project, source: Path | None, how: Filing, vocabulary: Sequence[str] | None = None
) -> Proposals:
    """What `take_over` would take, with nothing written; vocabulary: that to be tried, the project's when None."""
    files = _files(project, source)
    words = (project.vocabulary if vocabulary is None else tuple(vocabulary)) or _vocabulary(files, how)
    patterns = name_patterns(project.folder, project.settings, words, how.meanings)
    found, problems, labelled = list[Evidence](), list[str](), 0
    for asset, file in files.items():
        try:
            mesh = project.mesh(asset)
            given = _read(mesh, file, how, words, patterns)
        except MeshForgeError as error:
            problems.append(f"{asset}: {error.message}")
            continue
        _, report = merged(asset, mesh, given.labels, words)
        problems += [f"{asset}: {problem}" for problem in (*report.problems, *given.problems)]
        rows = list(_evidence(asset, mesh, file, given, words))
        labelled += len(mesh.hulls) - len(rows)
        found += rows
    return proposals(found, words, labelled, problems)


def _evidence(asset: str, mesh: SymbolicMesh, file: Path, given: Given, words: Sequence[str]) -> Iterator[Evidence]:
    """What becomes of the hulls whose label would change, or that have none."""
    for hull in mesh.hulls:
        label = given.labels.get(hull.name)
        if label and label.name in words and label != hull.annotation and not is_kept(hull.annotation, label):
            yield Evidence(asset, label, kind_of(file), given.names.get(hull.name) or file.name)
        elif hull.label is None:
            yield Evidence(asset, None, "nothing said", hull.name)


def _read(mesh: SymbolicMesh, file: Path, how: Filing, vocabulary: Sequence[str], patterns: Sequence[Pattern]) -> Given:
    """What a file says of an asset. Raises MeshForgeError: it cannot be read, or is of something else."""
    match kind_of(file):
        case "labels file":
            said = read_labels(file)
            followed = follow_labels(said, mesh.labelled(dict.fromkeys(mesh.index)))
            return Given({name: said.labels[name] for name in followed.gone} | followed.mesh.labels)
        case "points":
            return point_labels(mesh, file, how.reading, vocabulary, patterns)
    return link_labels(mesh, file, vocabulary, patterns)


def _files(project: Project, source: Path | None) -> dict[str, Path]:
    """The file of each asset that has one. Raises ProjectError where no asset has one, AssetError for a damaged one."""
    files = label_files(project.found, source)
    if not files:
        raise ProjectError(
            "there is no labels file for any asset",
            where=str(project.folder),
            remedy="Put a labels file beside each asset, or name a folder of them that mirrors the assets.",
        )
    for file in files.values():
        if kind_of(file) == "labels file":
            read_labels(file)  # a damaged one is told before anything is written
    return files


def _vocabulary(files: Mapping[str, Path], how: Filing) -> tuple[str, ...]:
    return tuple(dict.fromkeys(word for file in files.values() for word in _words(file, how)))


def _words(file: Path, how: Filing) -> Iterable[str]:
    """The labels that a file speaks of, in its order."""
    match kind_of(file):
        case "labels file":
            said = read_labels(file)
            return (*said.vocabulary, *(label.name for label in said.labels.values()))
        case "points":
            return classes_said(file, how.reading.classes)
    return links_said(file)


def _taken_over(project: Project, asset: str, file: Path, how: Filing, patterns: Sequence[Pattern]) -> Labelled:
    vocabulary = project.vocabulary
    try:
        mesh = project.mesh(asset)
        given = _read(mesh, file, how, vocabulary, patterns)
    except MeshForgeError as error:
        return Labelled(asset, problems=(error.message,))
    labelled, report = merged(asset, mesh, given.labels, vocabulary)
    if report.taken:
        write_merged(project, asset, labelled)
    return replace(report, problems=(*report.problems, *given.problems))
