"""Labelled hulls of another project, or of a family that ships with MeshForge, by which hulls here are labelled: read
from there, and kept in `labels/like/NAME.json` as descriptors and labels, without meshes."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from itertools import count
from pathlib import Path

import numpy as np

from meshforge.batch import SETTINGS, ExecutionOptions, WorkerFailure, execute, text_digest
from meshforge.common import (
    AssetError,
    ProjectError,
    UsageError,
    describe_error,
    join_names,
    quote_path,
    relative_name,
    suggest_among,
    write_atomically,
)
from meshforge.label_model import MeshDescriber, reference_label
from meshforge.label_model.describe import ROW_WIDTH
from meshforge.labels.family_comparison import DescribedAsset
from meshforge.labels.from_files.label_by_files import label_file_beside
from meshforge.labels.labeler import Stage
from meshforge.labels.names.words import match_label
from meshforge.labels.reference_family import pick_evenly
from meshforge.labels.summary import SURE
from meshforge.samples import FAMILIES, family_of
from meshforge.store import AssetFiles, JsonFile, Store, read_json
from meshforge.symbolic import Label

SAMPLE = "sample:"
"""What a family that ships with MeshForge begins with, where a project's folder could stand."""
_ASSETS, _HULLS = 96, 2000  # that are kept at most, evenly chosen; the label model looks at no more assets either
_DIGITS = 4  # of descriptors; hulls that differ by less are the same
_SYNONYM = 0.5  # how sure a word must be to stand for a label


class LikeAsset(JsonFile):
    """One labelled asset of another family: `ShapeDescriptor` of its hulls, and their labels there, None without."""

    rows: tuple[tuple[float, ...], ...]
    touching: tuple[tuple[int, int], ...]
    labels: tuple[str | None, ...]

    @property
    def is_whole(self) -> bool:
        """Whether the parts fit each other, and this version."""
        hulls = range(len(self.rows))
        is_described = len(self.labels) == len(self.rows) and all(len(row) == ROW_WIDTH for row in self.rows)
        return is_described and all(hull in hulls for pair in self.touching for hull in pair)


class LikeReference(JsonFile):
    """labels/like/NAME.json. source: where it is from, as seen from the project; words: the label here for each label
    there, empty for none; digest: of the assets."""

    source: str
    words: dict[str, str]
    digest: str
    assets: tuple[LikeAsset, ...]

    @staticmethod
    def of(source: str, words: Mapping[str, str], assets: Iterable[LikeAsset]) -> LikeReference:
        """Return what is to be kept of some assets."""
        chosen = tuple(assets)
        return LikeReference(source=source, words=dict(words), digest=_digest_assets(chosen), assets=chosen)

    def format(self) -> str:
        """Return the text of its file, one asset a line."""
        head = self.model_dump_json(exclude={"assets"}).removesuffix("}")
        return f'{head},"assets":[\n' + ",\n".join(one.model_dump_json() for one in self.assets) + "\n]}\n"

    def rename(self, old: str, new: str) -> LikeReference:
        """Return the same where a label of the project has another name."""
        words = {there: new if here == old else here for there, here in self.words.items()}
        return self.model_copy(update={"words": words})

    def describe(self, name: str, vocabulary: Sequence[str]) -> list[DescribedAsset]:
        """Return its assets with the labels that they have here; one that has none here is `LABEL of NAME`."""
        here = {word: own if own in vocabulary else f"{word} of {name}" for word, own in self.words.items()}
        return [
            DescribedAsset(
                np.array(one.rows, dtype=float).reshape(-1, ROW_WIDTH),
                np.array(one.touching, dtype=np.int64).reshape(-1, 2),
                tuple(Label(here.get(word, f"{word} of {name}"), 1.0, "file") if word else None for word in one.labels),
            )
            for one in self.assets
        ]


def _digest_assets(assets: Iterable[LikeAsset]) -> str:
    return text_digest("\n".join(one.model_dump_json() for one in assets))


def read_like_references(store: Store) -> dict[str, LikeReference]:
    """Return what a project keeps of other families, by name. Raises ProjectError for a file that is none of these."""
    found = dict[str, LikeReference]()
    for name in store.layout.like.ids:
        path = store.layout.like(name)
        remedy = f"Remove it, and take the labels again: meshforge label {quote_path(store.folder)} --like FAMILY"
        try:
            kept = read_json(path, LikeReference)
        except ProjectError as error:
            raise ProjectError(error.problem, where=str(path), remedy=remedy) from error
        if kept and not (all(one.is_whole for one in kept.assets) and kept.digest == _digest_assets(kept.assets)):
            problem = "it was changed, or made by another version: it does not fit its digest"
            raise ProjectError(problem, where=str(path), remedy=remedy)
        found |= {name: kept} if kept else {}
    return found


def write_like_reference(store: Store, name: str, reference: LikeReference) -> None:
    """Keep another family in a project."""
    with store.lock():
        write_atomically(store.layout.like(name), reference.format())


@dataclass(frozen=True, eq=False, slots=True)
class LabelledFamily:
    """A labelled family that is not of the project. source: what names it, as seen from the project; vocabulary: of
    its labels; files: of its labelled assets, evenly chosen of many."""

    source: str
    vocabulary: tuple[str, ...]
    files: tuple[AssetFiles, ...]

    def choose_name(self, known: Mapping[str, LikeReference]) -> str:
        """Return the name that it gets in a project, the one that it has there, where it has; known: by name."""
        base = re.sub(r"\W+", "_", Path(self.source.removeprefix(SAMPLE)).name).strip("_") or "family"
        names = (base if k == 1 else f"{base}_{k}" for k in count(1))
        return next(name for name in names if name not in known or known[name].source == self.source)

    def read(self, execution: ExecutionOptions, stage: Stage) -> tuple[list[LikeAsset], list[str]]:
        """Return its assets, of too many hulls evenly chosen ones; and why some cannot be read. Raises AssetError
        where none can."""
        assets, lost = list[LikeAsset](), list[str]()
        with (
            stage(len(self.files), "reading the other family") as advance,
            closing(execute(_describe_asset, self.files, execution)) as results,
        ):
            for files, found in zip(self.files, results, strict=True):
                if isinstance(found, LikeAsset):
                    assets += [found] if any(found.labels) else []
                else:
                    lost.append(f"{files.path}: {found.why}" if isinstance(found, WorkerFailure) else found)
                advance()
        if not assets:
            problem = lost[0] if lost else "no hull has a label that others could be taken from"
            raise AssetError(problem, where=self.source, remedy="Label it first, or name another family.")
        hulls = sum(len(one.rows) for one in assets)
        return list(pick_evenly(assets, max(1, len(assets) * _HULLS // max(hulls, _HULLS)))), lost


def _describe_asset(files: AssetFiles) -> LikeAsset | str:
    try:
        mesh = files.read_mesh()
        found = MeshDescriber(mesh).describe()
        labels = tuple(hull.label if can_teach(hull.annotation) else None for hull in mesh.hulls)
        rows = np.round(found.rows, _DIGITS).tolist()
        return LikeAsset(rows=rows, touching=found.touching.tolist(), labels=labels)
    except Exception as error:  # one asset never stops the others
        return describe_error(error, str(files.path))


def can_teach(label: Label | None) -> bool:
    """Return whether hulls of other families can be labelled by a label: one that a person or a file gave, or a sure
    one that is not itself from another family."""
    if label is None or label.source == "like":
        return False
    return reference_label(label) is not None or label.confidence >= SURE


def find_family(source: str, store: Store) -> LabelledFamily:
    """Return the family that `--like` names: a project's folder, or `sample:` and the name of one that ships.

    Raises UsageError: no such family, or the project itself; AssetError: a labels file is damaged; ProjectError: it has
    no labels, or what is wrong with that project.
    """
    if source.startswith(SAMPLE):
        return find_sample(source.removeprefix(SAMPLE))
    folder = Path(source).absolute()
    if not (folder / SETTINGS).is_file():
        names = [f"{SAMPLE}{one.name}" for one in FAMILIES]
        remedy = suggest_among(source, names, "Name the folder of a MeshForge project, or a family that ships:")
        raise UsageError("this is no project whose labels could be taken", where=str(folder), remedy=remedy)
    if folder.resolve() == store.folder.resolve():
        remedy = f"Within a project: meshforge label {quote_path(store.folder)} --with propagate"
        raise UsageError("this is the project itself", where=str(folder), remedy=remedy)
    other = Store.open(folder)
    chosen = [asset for asset in other.assets() if any(map(can_teach, other.labels(asset).labels.values()))]
    if not chosen:
        remedy = "Label it first, or name another one. Labels that are not sure, or from another family, do not count."
        raise ProjectError("no hull has a label that others could be taken from", where=str(folder), remedy=remedy)
    files = other.asset_files(pick_evenly(chosen, _ASSETS))
    return LabelledFamily(relative_name(folder, store.folder), other.vocabulary, files)


def find_sample(name: str) -> LabelledFamily:
    """Return a family that ships with MeshForge. Raises UsageError, naming the nearest."""
    family = family_of(name)
    paths = [path for path in sorted(family.folder.glob(family.pattern)) if label_file_beside(path)]
    files = tuple(AssetFiles(path, path / "none", label_file_beside(path) or path, None) for path in paths)
    return LabelledFamily(f"{SAMPLE}{name}", family.vocabulary, files)


def map_words(
    name: str, labels: Sequence[str], vocabulary: Sequence[str], given: Mapping[str, str]
) -> tuple[dict[str, str], list[str]]:
    """Return the label of a vocabulary for each label of another family, empty for none; and sentences on those that
    are not called alike.

    given: what the user says, empty for none. An empty vocabulary takes all. Raises UsageError: a label that neither
    has, or none that the vocabulary knows.
    """
    for there, here in given.items():
        if there not in labels:
            raise UsageError(f"{name} has no label {there!r}", remedy=suggest_among(there, labels, f"{name} has"))
        if here and vocabulary and here not in vocabulary:
            raise UsageError(f"{here!r} is not in the vocabulary", remedy=suggest_among(here, vocabulary))
    words = {word: given.get(word, _find_word(word, vocabulary) if vocabulary else word) for word in labels}
    none = [word for word, here in words.items() if not here]
    if len(none) == len(words):
        remedy = f"Say which is which: --map {none[0]}=LABEL. The vocabulary is: {', '.join(vocabulary)}."
        raise UsageError(f"no label of {name} is in the vocabulary: {join_names(none)}", remedy=remedy)
    notes = [f"{word} of {name} is taken as {here}" for word, here in words.items() if here not in ("", word)]
    if none:
        left = f"{join_names(none)} of {name} {'is' if len(none) == 1 else 'are'} in no label of the vocabulary"
        notes.append(f"{left}: such hulls stay open; --map {none[0]}=LABEL says what they are")
    return words, notes


def _find_word(word: str, vocabulary: Sequence[str]) -> str:
    """The label that is a word, or a synonym of it, in either direction; empty where there is none, or several."""
    if word in vocabulary:
        return word
    if (found := match_label(word, vocabulary)) and found.confidence >= _SYNONYM:
        return found.label
    others = [one for one in vocabulary if (found := match_label(one, [word])) and found.confidence >= _SYNONYM]
    return others[0] if len(others) == 1 else ""
