"""Labels taken over from files: labels files, segmented points and meshes, and what a dataset says of links."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.batch import Spread
from meshforge.errors import AssetError, ProjectError
from meshforge.project.labels.from_files.class_names import classes_said
from meshforge.project.labels.from_files.finding import kind_of, label_files
from meshforge.project.labels.from_files.links import links_said
from meshforge.project.labels.from_files.reading import Filing, Says, sayings
from meshforge.project.labels.labelling import Labelled, is_kept, merged
from meshforge.project.labels.name_patterns import name_patterns
from meshforge.project.labels.proposing import Evidence, Proposals, proposals
from meshforge.project.labels.taking import Report, Taker, any_may
from meshforge.symbolic import Label, label_homes, read_labels

if TYPE_CHECKING:
    from meshforge.project.project import Project


def take_over(
    project: Project, source: Path | None, how: Filing, spread: Spread, report: Report
) -> tuple[Labelled, ...]:
    """Take over what the file of each asset that has one says; a problem with one asset is told in its report.

    source: a file for a single asset, a folder that mirrors the assets; None for those beside them.
    A project without a vocabulary takes that of the files, in the order of their mention.
    Raises ProjectError: no file at all; UsageError: a pattern that makes no sense, or one file for several assets;
    AssetError: a file that cannot be read, while a vocabulary is looked for.
    """
    files = _files(project, source)
    if not project.vocabulary:
        project.set_vocabulary(_vocabulary(files, how))
    patterns = name_patterns(project.folder, project.settings, project.vocabulary, how.meanings)
    taker, reports = Taker(project), list[Labelled]()
    for asset, says in sayings(project, files, how, taker.vocabulary, patterns, spread):
        reports.append(_taken_over(taker, asset, says))
        report(reports[-1])
    return tuple(reports)


def _taken_over(taker: Taker, asset: str, says: Says) -> Labelled:
    if says.error:
        return Labelled(asset, problems=(says.error,))
    report = taker.try_write(asset, says.hulls, says.given.labels, any_may)
    return replace(report, problems=(*report.problems, *says.given.problems))


def from_files(
    project: Project, source: Path | None, how: Filing, vocabulary: Sequence[str] | None, spread: Spread
) -> Proposals:
    """What `take_over` would take, with nothing written; vocabulary: that to be tried, the project's when None."""
    files = _files(project, source)
    words = (project.vocabulary if vocabulary is None else tuple(vocabulary)) or _vocabulary(files, how)
    patterns = name_patterns(project.folder, project.settings, words, how.meanings)
    found, problems, labelled = list[Evidence](), list[str](), 0
    for asset, says in sayings(project, files, how, words, patterns, spread):
        try:
            current = label_homes(project.labels(asset), says.hulls).labels
        except AssetError as error:
            problems.append(f"{asset}: {error.message}")
            continue
        _, report = merged(asset, says.hulls, current, says.given.labels, words)
        told = (says.error,) if says.error else (*report.problems, *says.given.problems)
        problems += [f"{asset}: {problem}" for problem in told]
        rows = list(_evidence(asset, says, current, files[asset], words))
        labelled += len(says.hulls) - len(rows)
        found += rows
    return proposals(found, words, labelled, problems)


def _evidence(
    asset: str, says: Says, current: Mapping[str, Label], file: Path, words: Sequence[str]
) -> Iterator[Evidence]:
    """What becomes of the hulls whose label would change, or that have none."""
    for hull in says.hulls:
        label, now = says.given.labels.get(hull), current.get(hull)
        if label and label.name in words and label != now and not is_kept(now, label):
            yield Evidence(asset, label, kind_of(file), says.given.names.get(hull) or file.name)
        elif now is None:
            yield Evidence(asset, None, "nothing said", hull)


def _files(project: Project, source: Path | None) -> dict[str, Path]:
    """The file of each asset that has one. Raises ProjectError where no asset has one."""
    files = label_files(project.found, source)
    if not files:
        raise ProjectError(
            "there is no labels file for any asset",
            where=str(project.folder),
            remedy="Put a labels file beside each asset, or name a folder of them that mirrors the assets.",
        )
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
