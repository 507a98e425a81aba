"""Labels for the hulls of a project from files, taken or only proposed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from meshforge.batch import ExecutionOptions
from meshforge.common import AssetError, ProjectError
from meshforge.labels.from_files.classes import class_names_in_file
from meshforge.labels.from_files.read import (
    LabelFileContent,
    LabelFileOptions,
    find_label_files,
    kind_of,
    read_label_files,
    read_link_names,
)
from meshforge.labels.merge import (
    LabelOutcome,
    LabelWriter,
    OutcomeCallback,
    can_replace_any,
    is_protected,
    merge_labels,
)
from meshforge.labels.names.label_by_names import name_patterns
from meshforge.labels.propose import LabelEvidence, Proposals, group_evidence
from meshforge.store import Store
from meshforge.symbolic import Label, match_labels, read_labels


def label_from_files(
    store: Store, source: Path | None, how: LabelFileOptions, spread: ExecutionOptions, report: OutcomeCallback
) -> tuple[LabelOutcome, ...]:
    """Take over what the file of each asset that has one says; a problem with one asset is told in its report.

    source: a file for a single asset, a folder that mirrors the assets; None for those beside them.
    A project without a vocabulary takes that of the files, in the order of their mention.
    Raises ProjectError: no file at all; UsageError: a pattern that makes no sense, or one file for several assets;
    AssetError: a file that cannot be read, while a vocabulary is looked for.
    """
    files = _require_files(store, source)
    if not store.vocabulary:
        store.set_vocabulary(_read_vocabulary(files, how))
    patterns = name_patterns(store.folder, store.settings, store.vocabulary, how.meanings)
    taker, reports = LabelWriter(store), list[LabelOutcome]()
    for asset, says in read_label_files(store, files, how, taker.vocabulary, patterns, spread):
        reports.append(_write_asset(taker, asset, says))
        report(reports[-1])
    return tuple(reports)


def _write_asset(taker: LabelWriter, asset: str, says: LabelFileContent) -> LabelOutcome:
    if says.error:
        return LabelOutcome(asset, problems=(says.error,))
    report = taker.try_write(asset, says.hulls, says.given.labels, can_replace_any)
    return replace(report, problems=(*report.problems, *says.given.problems))


def propose_from_files(
    store: Store,
    source: Path | None,
    how: LabelFileOptions,
    vocabulary: Sequence[str] | None,
    spread: ExecutionOptions,
) -> Proposals:
    """What `label_from_files` would take, with nothing written; vocabulary: that to be tried, the project's when
    None.
    """
    files = _require_files(store, source)
    words = (store.vocabulary if vocabulary is None else tuple(vocabulary)) or _read_vocabulary(files, how)
    patterns = name_patterns(store.folder, store.settings, words, how.meanings)
    found, problems, labelled = list[LabelEvidence](), list[str](), 0
    for asset, says in read_label_files(store, files, how, words, patterns, spread):
        try:
            current = match_labels(store.labels(asset), says.hulls).labels
        except AssetError as error:
            problems.append(f"{asset}: {error.message}")
            continue
        _, report = merge_labels(asset, says.hulls, current, says.given.labels, words)
        told = (says.error,) if says.error else (*report.problems, *says.given.problems)
        problems += [f"{asset}: {problem}" for problem in told]
        rows = list(_evidence_of_asset(asset, says, current, files[asset], words))
        labelled += len(says.hulls) - len(rows)
        found += rows
    return group_evidence(found, words, labelled, problems)


def _evidence_of_asset(
    asset: str, says: LabelFileContent, current: Mapping[str, Label], file: Path, words: Sequence[str]
) -> Iterator[LabelEvidence]:
    """What becomes of the hulls whose label would change, or that have none."""
    for hull in says.hulls:
        label, now = says.given.labels.get(hull), current.get(hull)
        if label and label.name in words and label != now and not is_protected(now, label):
            yield LabelEvidence(asset, label, kind_of(file), says.given.names.get(hull) or file.name)
        elif now is None:
            yield LabelEvidence(asset, None, "nothing said", hull)


def _require_files(store: Store, source: Path | None) -> dict[str, Path]:
    """The file of each asset that has one. Raises ProjectError where no asset has one."""
    files = find_label_files(store.found, source)
    if not files:
        raise ProjectError(
            "there is no labels file for any asset",
            where=str(store.folder),
            remedy="Put a labels file beside each asset, or name a folder of them that mirrors the assets.",
        )
    return files


def _read_vocabulary(files: Mapping[str, Path], how: LabelFileOptions) -> tuple[str, ...]:
    return tuple(dict.fromkeys(word for file in files.values() for word in _read_words(file, how)))


def _read_words(file: Path, how: LabelFileOptions) -> Iterable[str]:
    """The labels that a file speaks of, in its order."""
    match kind_of(file):
        case "labels file":
            said = read_labels(file)
            return (*said.vocabulary, *(label.name for label in said.labels.values()))
        case "points":
            return class_names_in_file(file, how.reading.classes)
    return read_link_names(file)
