"""Labels for the hulls of a project from files: which file says what the hulls of an asset are, and what it says; a
labels file or segmented points."""

from collections.abc import Generator, Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from meshforge.batch import AssetSet, ExecutionOptions, WorkerFailure, execute, read_prepared
from meshforge.common import MeshForgeError, ProjectError, UsageError, describe_error
from meshforge.formats import POINTS_SUFFIXES, AlignMode, labels_beside, points_beside
from meshforge.labels.from_files.base import FileLabels
from meshforge.labels.from_files.points import label_by_points, read_class_names
from meshforge.labels.labeler import AssetLabels, Labeler, LabelFamily, LabelProposal
from meshforge.labels.names.label_by_names import NamePattern, PatternPairs, name_patterns
from meshforge.store import AssetFacts, Store, hull_digests, iterate_asset_index
from meshforge.symbolic import Label, SymbolicMesh, match_labels, read_labels

LabelFileKind = Literal["labels file", "points"]


def find_label_files(found: AssetSet, source: Path | None) -> dict[str, Path]:
    """Return the file of each asset that has one; beside each asset: labels file, then points.

    source: a file for a single asset, or a folder that mirrors the assets; None for those beside them.
    Raises UsageError: nothing there, a kind of file that says no labels, or one file for several assets.
    """
    if source is None:
        files = {asset: label_file_beside(path) for asset, path in found.ids.items()}
    elif source.is_file():
        kind_of(source)
        if len(found) > 1:
            problem = f"one file cannot serve {len(found)} assets"
            raise UsageError(problem, where=str(source), remedy="Give a folder that mirrors theirs.")
        files = dict.fromkeys(found.ids, source)
    elif source.is_dir():
        files = {asset: find_file_in_mirror(source / asset, path) for asset, path in found.ids.items()}
    else:
        raise UsageError("there is no such labels file or folder", where=str(source))
    return {asset: file for asset, file in files.items() if file}


def kind_of(file: Path) -> LabelFileKind:
    """Return what a file is by its name. Raises UsageError for one that says no labels."""
    suffix = file.suffix.lower()
    if suffix == ".json" or suffix in POINTS_SUFFIXES:
        return "labels file" if suffix == ".json" else "points"
    remedy = "Labels files are .json, segmented points .ply or .npz."
    raise UsageError("this is no kind of file that labels are read from", where=str(file), remedy=remedy)


def label_file_beside(asset: Path) -> Path | None:
    """Return the file beside an asset, None where there is none."""
    labels = labels_beside(asset)
    return labels if labels.is_file() else points_beside(labels)


def find_file_in_mirror(place: Path, asset: Path) -> Path | None:
    """Return the file in a folder of them; place: where the asset would be there, which may be where it is."""
    labels = labels_beside(place)
    plain = (place.with_name(place.name + ".json"), labels)
    others = (place.with_suffix(suffix) for suffix in POINTS_SUFFIXES)
    return (
        next((path for path in plain if path.is_file()), None)
        or points_beside(labels)
        or next((path for path in others if path != asset and path.is_file()), None)
    )


@dataclass(frozen=True, slots=True)
class LabelFileOptions:
    """How files are read. meanings: what names of classes mean, besides the patterns of the project, which they
    precede; of segmented points, classes: the names of classes 0, 1, ..., or `vocabulary` alone where they are those of
    the vocabulary, none where files say them; align: how points come into the frame of an asset."""

    meanings: PatternPairs = ()
    classes: tuple[str, ...] = ()
    align: AlignMode = "check"


@dataclass(frozen=True, slots=True)
class _Work:
    """An asset, where it is, the folder of its preparation, and a file that only its mesh makes sense of."""

    asset: str
    path: Path
    preparation: Path
    file: Path
    options: LabelFileOptions
    vocabulary: tuple[str, ...]
    patterns: tuple[NamePattern, ...]


def _read_label_files(
    store: Store,
    files: Mapping[str, Path],
    options: LabelFileOptions,
    vocabulary: tuple[str, ...],
    patterns: tuple[NamePattern, ...],
    execution: ExecutionOptions,
) -> Generator[AssetLabels, None, None]:
    """What the file of each asset says, in their order, as soon as it is known; read in worker processes."""
    plain, layout = {asset for asset, file in files.items() if kind_of(file) == "labels file"}, store.layout
    work = [
        _Work(asset, store.path(asset), layout.preparation(asset), file, options, vocabulary, patterns)
        for asset, file in files.items()
        if asset not in plain
    ]
    with (
        closing(iterate_asset_index(store.found, layout, plain, execution=execution)) as facts,
        closing(execute(_read_by_mesh, work, execution)) as others,
    ):
        for asset, file in files.items():
            if asset in plain:
                yield _read_by_facts(asset, next(facts)[1], file)
            else:
                found = next(others)
                if isinstance(found, WorkerFailure):
                    found = AssetLabels(asset, error=f"{store.path(asset)}: {found.why}")
                yield found


def _read_by_facts(asset: str, facts: AssetFacts, file: Path) -> AssetLabels:
    if facts.error:
        return AssetLabels(asset, error=facts.error)
    try:
        return _to_labels(asset, facts.hulls, _take_labels_file(file, facts.hulls), file)
    except MeshForgeError as error:
        return AssetLabels(asset, facts.hulls, error=error.message)


def _to_labels(asset: str, hulls: Mapping[str, str], given: FileLabels, file: Path) -> AssetLabels:
    reasons = {hull: (kind_of(file), given.names.get(hull) or file.name) for hull in given.labels}
    return AssetLabels(asset, hulls, given.labels, reasons, given.problems)


def _take_labels_file(file: Path, hulls: Mapping[str, str]) -> FileLabels:
    labels_file = read_labels(file)
    homes = match_labels(labels_file, hulls)
    present = {name: homes.labels[name] for name in hulls if name in homes.labels}
    return FileLabels({name: labels_file.labels[name] for name in homes.gone} | present)


def _read_by_mesh(work: _Work) -> AssetLabels:
    try:
        mesh = SymbolicMesh.of(read_prepared(work.path, work.preparation))
        given = read_label_file(mesh, work.file, work.options, work.vocabulary, work.patterns)
        return _to_labels(work.asset, hull_digests(mesh), given, work.file)
    except Exception as error:  # one asset never stops the others
        return AssetLabels(work.asset, error=describe_error(error, str(work.path)))


def read_label_file(
    mesh: SymbolicMesh, file: Path, how: LabelFileOptions, vocabulary: Sequence[str], patterns: Sequence[NamePattern]
) -> FileLabels:
    """Return what a file of any kind says of the hulls of an asset. Raises AssetError where it cannot be read."""
    if kind_of(file) == "labels file":
        return _take_labels_file(file, hull_digests(mesh))
    return label_by_points(mesh, file, how.classes, how.align, vocabulary, patterns)


class FileLabeler(Labeler):
    """Takes labels from files: labels files and segmented points.

    source: a file for a single asset, a folder that mirrors the assets, or None for the files beside them. A project
    without a vocabulary takes that of the files.
    Raises ProjectError: no file at all; UsageError: a wrong pattern, or one file for several assets; AssetError: a file
    that cannot be read while a vocabulary is looked for.
    """

    name = "file"
    about = "labels taken over from files"

    def __init__(self, source: Path | None = None, options: LabelFileOptions | None = None) -> None:
        self.source, self.options = source, options or LabelFileOptions()

    def propose(self, family: LabelFamily) -> LabelProposal:
        store = family.store
        files = find_label_files(store.found, self.source)
        if not files:
            remedy = "Put a labels file beside each asset, or name a folder of them that mirrors the assets."
            raise ProjectError("there is no labels file for any asset", where=str(store.folder), remedy=remedy)
        named = (word for file in files.values() for word in _read_words(file, self.options))
        words = family.vocabulary or tuple(dict.fromkeys(named))
        patterns = name_patterns(store.folder, store.settings, words, self.options.meanings)
        assets = _read_label_files(store, files, self.options, words, patterns, family.execution)
        return LabelProposal(assets, vocabulary=words)

    def can_replace(self, current: Label | None, given: Label | None) -> bool:
        return given is not None


def _read_words(file: Path, options: LabelFileOptions) -> Iterable[str]:
    if kind_of(file) == "points":
        return read_class_names(file, options.classes)
    labels_file = read_labels(file)
    return (*labels_file.vocabulary, *(label.name for label in labels_file.labels.values()))
