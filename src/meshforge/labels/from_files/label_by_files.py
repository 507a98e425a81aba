"""Labels for the hulls of a project from files, taken or only proposed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from meshforge.batch import ExecutionOptions
from meshforge.common import AssetError, ProjectError
from meshforge.labels import merge
from meshforge.labels.from_files import read
from meshforge.labels.from_files.links import read_semantics
from meshforge.labels.from_files.points import read_class_names
from meshforge.labels.names.label_by_names import name_patterns
from meshforge.labels.summary import LabelEvidence, Proposals, group_evidence
from meshforge.store import Store
from meshforge.symbolic import Label, match_labels, read_labels


def label_from_files(
    store: Store,
    source: Path | None,
    options: read.LabelFileOptions,
    execution: ExecutionOptions,
    report: merge.OutcomeCallback,
) -> tuple[merge.LabelOutcome, ...]:
    """Take the labels that files give; see `LabelStore.label_from_files`."""
    files = _require_files(store, source)
    if not store.vocabulary:
        store.set_vocabulary(_read_vocabulary(files, options))
    patterns = name_patterns(store.folder, store.settings, store.vocabulary, options.meanings)
    writer, reports = merge.LabelWriter(store), list[merge.LabelOutcome]()
    for asset, content in read.read_label_files(store, files, options, writer.vocabulary, patterns, execution):
        reports.append(_write_asset(writer, asset, content))
        report(reports[-1])
    return tuple(reports)


def _write_asset(writer: merge.LabelWriter, asset: str, content: read.LabelFileContent) -> merge.LabelOutcome:
    if content.error:
        return merge.LabelOutcome(asset, problems=(content.error,))
    report = writer.try_write(asset, content.hulls, content.given.labels, merge.can_replace_any)
    return replace(report, problems=(*report.problems, *content.given.problems))


def propose_from_files(
    store: Store,
    source: Path | None,
    options: read.LabelFileOptions,
    vocabulary: Sequence[str] | None,
    execution: ExecutionOptions,
) -> Proposals:
    """What `label_from_files` would take, with nothing written."""
    files = _require_files(store, source)
    words = (store.vocabulary if vocabulary is None else tuple(vocabulary)) or _read_vocabulary(files, options)
    patterns = name_patterns(store.folder, store.settings, words, options.meanings)
    found, problems, labelled = list[LabelEvidence](), list[str](), 0
    for asset, content in read.read_label_files(store, files, options, words, patterns, execution):
        try:
            current = match_labels(store.labels(asset), content.hulls).labels
        except AssetError as error:
            problems.append(f"{asset}: {error.message}")
            continue
        _, report = merge.merge_labels(asset, content.hulls, current, content.given.labels, words)
        left_out = (content.error,) if content.error else (*report.problems, *content.given.problems)
        problems += [f"{asset}: {problem}" for problem in left_out]
        rows = list(_evidence_of_asset(asset, content, current, files[asset], words))
        labelled += len(content.hulls) - len(rows)
        found += rows
    return group_evidence(found, words, labelled, problems)


def _evidence_of_asset(
    asset: str, content: read.LabelFileContent, current: Mapping[str, Label], file: Path, words: Sequence[str]
) -> Iterator[LabelEvidence]:
    """What becomes of the hulls whose label would change, or that have none."""
    for hull in content.hulls:
        label, now = content.given.labels.get(hull), current.get(hull)
        if label and label.name in words and label != now and not merge.is_protected(now, label):
            yield LabelEvidence(asset, label, read.kind_of(file), content.given.names.get(hull) or file.name)
        elif now is None:
            yield LabelEvidence(asset, None, "nothing said", hull)


def _require_files(store: Store, source: Path | None) -> dict[str, Path]:
    """The file of each asset that has one. Raises ProjectError where no asset has one."""
    files = read.find_label_files(store.found, source)
    if not files:
        remedy = "Put a labels file beside each asset, or name a folder of them that mirrors the assets."
        raise ProjectError("there is no labels file for any asset", where=str(store.folder), remedy=remedy)
    return files


def _read_vocabulary(files: Mapping[str, Path], options: read.LabelFileOptions) -> tuple[str, ...]:
    return tuple(dict.fromkeys(word for file in files.values() for word in _read_words(file, options)))


def _read_words(file: Path, options: read.LabelFileOptions) -> Iterable[str]:
    match read.kind_of(file):
        case "labels file":
            labels_file = read_labels(file)
            return (*labels_file.vocabulary, *(label.name for label in labels_file.labels.values()))
        case "points":
            return read_class_names(file, options.classes)
    return read_semantics(file).values()
