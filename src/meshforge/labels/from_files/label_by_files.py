"""Labels for the hulls of a project from files."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from meshforge.common import ProjectError
from meshforge.labels.from_files import read
from meshforge.labels.from_files.links import read_semantics
from meshforge.labels.from_files.points import read_class_names
from meshforge.labels.labeler import AssetLabels, Labeler, LabelFamily, LabelProposal
from meshforge.labels.names.label_by_names import name_patterns
from meshforge.symbolic import Label, read_labels


class FileLabeler(Labeler):
    """Takes labels from files: labels files, segmented points, and PartNet's semantics of links.

    source: a file for a single asset, a folder that mirrors the assets, or None for the files beside them. A project
    without a vocabulary takes that of the files.
    Raises ProjectError: no file at all; UsageError: a wrong pattern, or one file for several assets; AssetError: a file
    that cannot be read while a vocabulary is looked for.
    """

    name = "file"
    about = "labels taken over from files"

    def __init__(self, source: Path | None = None, options: read.LabelFileOptions | None = None) -> None:
        self.source, self.options = source, options or read.LabelFileOptions()

    def propose(self, family: LabelFamily) -> LabelProposal:
        store = family.store
        files = read.find_label_files(store.found, self.source)
        if not files:
            remedy = "Put a labels file beside each asset, or name a folder of them that mirrors the assets."
            raise ProjectError("there is no labels file for any asset", where=str(store.folder), remedy=remedy)
        words = family.vocabulary or _read_vocabulary(files, self.options)
        patterns = name_patterns(store.folder, store.settings, words, self.options.meanings)
        contents = read.read_label_files(store, files, self.options, words, patterns, family.execution)
        return LabelProposal((_to_labels(*one, files) for one in contents), vocabulary=words)

    def can_replace(self, current: Label | None, given: Label | None) -> bool:
        return given is not None


def _to_labels(asset: str, content: read.LabelFileContent, files: Mapping[str, Path]) -> AssetLabels:
    file, names = files[asset], content.given.names
    reasons = {hull: (read.kind_of(file), names.get(hull) or file.name) for hull in content.given.labels}
    return AssetLabels(asset, content.hulls, content.given.labels, reasons, content.given.problems, content.error)


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
