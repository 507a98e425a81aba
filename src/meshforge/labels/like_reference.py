"""Labelled hulls of another project, or of a family that ships with MeshForge, by which hulls here are labelled: read
from there, and kept in `labels/like/NAME.json` as descriptors and labels, without meshes."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge import batch, common, label_model, samples
from meshforge.common import UsageError, suggest_among
from meshforge.label_model.describe import ROW_WIDTH
from meshforge.labels.family_comparison import DescribedAsset
from meshforge.labels.from_files.label_by_files import label_file_beside
from meshforge.labels.labeler import LabelFamily
from meshforge.labels.names.words import match_label
from meshforge.labels.reference_family import pick_evenly
from meshforge.labels.summary import SURE
from meshforge.store import AssetFiles, JsonFile, Store
from meshforge.symbolic import CLASS_SOURCES, Label

SAMPLE = "sample:"
"""What a family that ships with MeshForge begins with, where a project's folder could stand."""
_ASSETS, _HULLS = 96, 2000  # that are kept at most, evenly chosen; the label model looks at no more assets either
_DIGITS = 4  # of descriptors; hulls that differ by less are the same
_SYNONYM = 0.5  # how sure a word must be to stand for a label


class LikeAsset(JsonFile):
    """One asset of another family: `ShapeDescriptor` of its hulls, and their labels there, None without."""

    rows: tuple[tuple[float, ...], ...]
    touching: tuple[tuple[int, int], ...]
    labels: tuple[str | None, ...]


class LikeReference(JsonFile):
    """labels/like/NAME.json. source: where it is from, as seen from the project; words: the label here for each label
    there, empty for none; digest: of the assets."""

    source: str
    words: dict[str, str]
    digest: str
    assets: tuple[LikeAsset, ...]

    def format(self) -> str:
        """Return the text of its file, one asset a line."""
        head = self.model_dump_json(exclude={"assets"}).removesuffix("}")
        return f'{head},"assets":[\n' + ",\n".join(one.model_dump_json() for one in self.assets) + "\n]}\n"

    def describe_assets(self, name: str, vocabulary: Sequence[str]) -> list[DescribedAsset]:
        """Return its assets with the labels that they have here; one that has none here is `LABEL of NAME`."""
        here = {word: own if own in vocabulary else f"{word} of {name}" for word, own in self.words.items()}
        known = {word: Label(label, 1.0, "file") for word, label in here.items()}
        touching = (np.array(one.touching, dtype=np.int64).reshape(-1, 2) for one in self.assets)
        rows = zip(self.assets, touching, strict=True)
        return [(np.array(one.rows), pairs, [known.get(word or "") for word in one.labels]) for one, pairs in rows]


def _digest_assets(assets: Iterable[LikeAsset]) -> str:
    return batch.text_digest("\n".join(one.model_dump_json() for one in assets))


def read_references(store: Store) -> dict[str, LikeReference]:
    """Return what a project keeps of other families, by name. Raises ProjectError for a file that is none of these."""
    found = dict[str, LikeReference]()
    for name in store.layout.like.ids:
        path = store.layout.like(name)
        try:
            kept = found[name] = LikeReference.model_validate_json(path.read_bytes())
            is_whole = kept.digest == _digest_assets(kept.assets) and {*map(len, kept.assets[0].rows)} == {ROW_WIDTH}
        except (OSError, ValueError, IndexError):
            is_whole = False
        if not is_whole:
            problem = "it is no family as this version keeps it, or was changed by hand"
            raise common.ProjectError(
                problem, where=str(path), remedy="Remove it, and take the labels with --like once more."
            )
    return found


def read_family(source: str, family: LabelFamily, given: Mapping[str, str]) -> tuple[str, LikeReference, list[str]]:
    """Return what a project is to keep of a labelled family, by what name, and what the user is to know of it.

    The arguments are those of `LikeLabeler`, and the family that is to be labelled. Raises as it does.
    """
    is_sample, folder = source.startswith(SAMPLE), Path(source).absolute()
    vocabulary, files = find_sample(source.removeprefix(SAMPLE)) if is_sample else _find_project(source, family.store)
    name = re.sub(r"\W+", "_", source.removeprefix(SAMPLE) if is_sample else folder.name).strip("_") or "family"
    assets, notes = describe_files(files, family)
    present = {label: None for one in assets for label in one.labels if label}
    labels = [label for label in dict.fromkeys((*vocabulary, *present)) if label in present]
    words = _map_words(name, labels, family.vocabulary, given)
    notes += [f"{word} of {name} is taken as {here}" for word, here in words.items() if here not in ("", word)]
    if none := [word for word, here in words.items() if not here]:
        notes.append(
            f"hulls like {common.join_names(none)} of {name} stay open; --map {none[0]}=LABEL says what they are"
        )
    source = source if is_sample else common.relative_name(folder, family.store.folder)
    return name, LikeReference(source=source, words=words, digest=_digest_assets(assets), assets=tuple(assets)), notes


def _find_project(source: str, store: Store) -> tuple[tuple[str, ...], Sequence[AssetFiles]]:
    folder = Path(source).absolute()
    if not (folder / batch.SETTINGS).is_file():
        names = [f"{SAMPLE}{one.name}" for one in samples.FAMILIES]
        remedy = suggest_among(source, names, "Name a project's folder, or one of")
        raise UsageError("this is no project whose labels could be taken", where=str(folder), remedy=remedy)
    if folder.resolve() == store.folder.resolve():
        remedy = "--with propagate takes labels from the project's own assets."
        raise UsageError("this is the project itself", where=str(folder), remedy=remedy)
    other = Store.open(folder)
    chosen = [asset for asset in other.assets() if any(map(_can_teach, other.labels(asset).labels.values()))]
    if not chosen:
        remedy = "Label some there first; labels that are not sure, or like another family, do not count."
        raise common.ProjectError(
            "no hull has a label that others could be taken from", where=str(folder), remedy=remedy
        )
    return other.vocabulary, other.asset_files(pick_evenly(chosen, _ASSETS))


def find_sample(name: str) -> tuple[tuple[str, ...], Sequence[AssetFiles]]:
    """Return the vocabulary and the files of a family that ships. Raises UsageError, naming the nearest."""
    family = samples.family_of(name)
    labels = {path: label_file_beside(path) for path in sorted(family.folder.glob(family.pattern))}
    none = family.folder / "none"
    return family.vocabulary, [AssetFiles(path, none, file, none, None) for path, file in labels.items() if file]


def describe_files(files: Sequence[AssetFiles], family: LabelFamily) -> tuple[list[LikeAsset], list[str]]:
    """Return the labelled assets of another family, of too many hulls evenly chosen ones; and why some cannot be read.
    Raises AssetError where none can."""
    with family.stage(len(files), "reading the other family") as advance:
        results = [*batch.execute(_describe_asset, files, replace(family.execution, progress=advance))]
    assets = [one for one in results if isinstance(one, LikeAsset)]
    lost = [one for one in results if isinstance(one, str)]
    lost += [
        f"{own.path}: {one.why}"
        for own, one in zip(files, results, strict=True)
        if isinstance(one, batch.WorkerFailure)
    ]
    if not assets:
        raise common.AssetError(lost[0])
    hulls = sum(len(one.rows) for one in assets)
    return [*pick_evenly(assets, max(1, len(assets) * _HULLS // max(hulls, _HULLS)))], lost


def _describe_asset(files: AssetFiles) -> LikeAsset | str:
    try:
        mesh = files.read_mesh()
        found = label_model.MeshDescriber(mesh).describe()
        labels = tuple(hull.label if _can_teach(hull.annotation) else None for hull in mesh.hulls)
        if not any(labels):
            return f"{files.path}: no hull has a label that others could be taken from"
        return LikeAsset(rows=np.round(found.rows, _DIGITS).tolist(), touching=found.touching.tolist(), labels=labels)
    except Exception as error:  # one asset never stops the others
        return common.describe_error(error, str(files.path))


def _can_teach(label: Label | None) -> bool:
    """Whether hulls of other families can be labelled by a label: one that a person or a file gave, or a sure one that
    is no class and not itself from another family."""
    if label is None or label.source in CLASS_SOURCES | {"like"}:
        return False
    return label_model.reference_label(label) is not None or label.confidence >= SURE


def _map_words(name: str, labels: Sequence[str], vocabulary: Sequence[str], given: Mapping[str, str]) -> dict[str, str]:
    """The label of a vocabulary for each label of another family, empty for none; an empty vocabulary takes all."""
    for there, here in given.items():
        if there not in labels:
            raise UsageError(f"{name} has no label {there!r}", remedy=suggest_among(there, labels, f"{name} has"))
        if here and vocabulary and here not in vocabulary:
            raise UsageError(f"{here!r} is not in the vocabulary", remedy=suggest_among(here, vocabulary))
    taken = {word: word if word in vocabulary or not vocabulary else _find_word(word, vocabulary) for word in labels}
    taken |= given
    if not any(taken.values()):
        remedy = f"Say which is which: --map {labels[0]}=LABEL. The vocabulary is: {', '.join(vocabulary)}."
        raise UsageError(f"no label of {name} ({common.join_names(labels)}) means one of the vocabulary", remedy=remedy)
    return taken


def _find_word(word: str, vocabulary: Sequence[str]) -> str:
    """The label that is a synonym of a word, or it of the label; empty where there is none, or several."""
    if (found := match_label(word, vocabulary)) and found.confidence >= _SYNONYM:
        return found.label
    others = [one for one in vocabulary if (found := match_label(one, [word])) and found.confidence >= _SYNONYM]
    return others[0] if len(others) == 1 else ""
