"""Labels as JSON beside an asset, by hull name, with digests by which they follow hulls that were renamed."""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any, Self

from meshforge.common import AssetError, suggest_name, write_atomically
from meshforge.geometry import digest
from meshforge.symbolic.hull import INFERRED_SOURCES, LABEL_SOURCES, NO_PART, Label, is_class_name
from meshforge.symbolic.mesh import SymbolicMesh

_MOST_FILES = 256  # contents of labels files that stay in memory
_REMEDY = 'Expected {"vocabulary": [label, …], "hulls": {name: {"label", "confidence", "source", "given", "digest"}}}.'


@dataclass(frozen=True, eq=False, slots=True)
class LabelFile:
    """What a labels file says, in the order it says it.

    labels, digests: by hull name; a hull of the short form, which gives the label only, has no digest.
    """

    vocabulary: tuple[str, ...] = ()
    labels: Mapping[str, Label] = field(default_factory=lambda: MappingProxyType({}))
    digests: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))

    def __reduce__(self) -> tuple[Any, ...]:
        return LabelFile, (self.vocabulary, dict(self.labels), dict(self.digests))

    def rename(self, old: str, new: str) -> Self:
        """Return the same where a label has another name."""
        labels = {hull: label.rename(old, new) for hull, label in self.labels.items()}
        return type(self)(tuple(new if word == old else word for word in self.vocabulary), labels, self.digests)

    def fill(self, classes: Self) -> Self:
        """Return the same with the classes of hulls that it says nothing of, or whose labels are inferred where a step
        says otherwise."""
        if not classes.labels:
            return self
        shown = {hull for hull, label in classes.labels.items() if label.source == "step"}
        own = {
            hull: one for hull, one in self.labels.items() if one.source not in INFERRED_SOURCES or hull not in shown
        }
        digests = {hull: one for hull, one in self.digests.items() if hull in own}
        return type(self)(
            tuple(dict.fromkeys([*self.vocabulary, *classes.vocabulary])),
            MappingProxyType({**classes.labels, **own}),
            MappingProxyType({**classes.digests, **digests}),
        )


def write_labels(path: Path | None, mesh: SymbolicMesh, vocabulary: Sequence[str]) -> str:
    """Return the text of the labels of a mesh, in its order, written to `path` unless that is None."""
    digests = {hull.name: digest(hull.shape) for hull in mesh.hulls if hull.annotation}
    text = format_labels(LabelFile(tuple(vocabulary), mesh.labels, digests))
    if path is not None:
        write_atomically(path, text)
    return text


def format_labels(file: LabelFile) -> str:
    """Return the text of a labels file, one hull a line; labels that its vocabulary lacks end that."""
    labels = [name for label in file.labels.values() for name in label.names if name != NO_PART]
    words = json.dumps(list(dict.fromkeys([*file.vocabulary, *labels])), ensure_ascii=False)
    digests = {name: {"digest": known} for name, known in file.digests.items() if known}
    values = {name: _to_json(label) | digests.get(name, {}) for name, label in file.labels.items()}
    rows = [f"    {json.dumps(n, ensure_ascii=False)}: {json.dumps(v, ensure_ascii=False)}" for n, v in values.items()]
    hulls = "{\n" + ",\n".join(rows) + "\n  }" if rows else "{}"
    return f'{{\n  "vocabulary": {words},\n  "hulls": {hulls}\n}}\n'


def _to_json(label: Label) -> dict[str, Any]:
    value: dict[str, Any] = {"label": label.name, "confidence": label.confidence, "source": label.source}
    return value | ({"given": _to_json(label.given)} if label.given else {})


def read_labels(path: Path) -> LabelFile:
    """Return the labels of a file; the short form `{"hulls": {name: label}}` is read too, its labels have the source
    `file`.

    Raises AssetError naming file and hull: unreadable, no JSON, or not of that form.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise AssetError(f"the labels cannot be read ({error.strerror})", where=str(path)) from error
    return _parse(content, path)


def read_classes(path: Path | None) -> LabelFile:
    """Return the classes in a file; none where it is not there, or damaged: learning makes them again."""
    try:
        return read_labels(path) if path and path.exists() else LabelFile()
    except AssetError:
        return LabelFile()


def parse_labels_text(text: str | None) -> LabelFile:
    """Return the labels in the text of a labels file, none for None. Raises AssetError as `read_labels` does."""
    return _parse(text.encode(), Path("labels")) if text else LabelFile()


@lru_cache(_MOST_FILES)  # each edit of labels asks several times for what the same file says
def _parse(content: bytes, path: Path) -> LabelFile:
    data = _load_json(content, path)
    if not isinstance(data, dict) or not isinstance(data.get("hulls"), dict):
        raise AssetError("this is no labels file", where=str(path), remedy=_REMEDY)
    if unknown := next((key for key in data if key not in ("vocabulary", "hulls")), None):
        raise AssetError(f"the field {unknown!r} is not one of a labels file", where=str(path), remedy=_REMEDY)
    vocabulary = data.get("vocabulary", [])
    if not isinstance(vocabulary, list) or not all(isinstance(word, str) and word for word in vocabulary):
        raise AssetError("its vocabulary is not a list of labels", where=str(path), remedy=_REMEDY)
    entries = {name: _parse_entry(name, value, path) for name, value in data["hulls"].items() if value is not None}
    for name, (label, _) in entries.items():
        for word in label.names:
            _check_label(name, word, vocabulary, path)
    labels = {name: label for name, (label, _) in entries.items()}
    digests = {name: known for name, (_, known) in entries.items() if known}
    return LabelFile(tuple(dict.fromkeys(vocabulary)), MappingProxyType(labels), MappingProxyType(digests))


def _load_json(content: bytes, path: Path) -> Any:
    try:
        return json.loads(content.decode("utf-8-sig"), object_pairs_hook=_reject_duplicates)
    except UnicodeDecodeError as error:
        raise AssetError("the labels are not UTF-8 text", where=str(path), remedy=_REMEDY) from error
    except json.JSONDecodeError as error:
        place = f"{path}:{error.lineno}:{error.colno}"
        raise AssetError(f"the labels are no JSON ({error.msg})", where=place, remedy=_REMEDY) from error
    except (RecursionError, ValueError) as error:
        raise AssetError("the labels are no JSON that can be read", where=str(path), remedy=_REMEDY) from error
    except _DuplicateNameError as error:
        raise AssetError(f"{error.args[0]!r} is given twice", where=str(path), remedy="Keep one of them.") from error


class _DuplicateNameError(Exception):
    """A name that occurs twice in an object."""


def _reject_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, value in pairs:
        if name in found:
            raise _DuplicateNameError(name)
        found[name] = value
    return found


def _parse_entry(name: str, value: Any, path: Path) -> tuple[Label, str | None]:
    """The label of one hull, in the long form or the short, and the digest of its geometry."""
    if isinstance(value, str) and value:
        return Label(value, 1.0, "file"), None
    label, known = _parse_label(name, value, path), value.get("digest")
    match value.get("given"):
        case None:
            return label, known if isinstance(known, str) and known else None
        case {"label": str(), **rest} as given if rest.get("given") is None:
            before = _parse_label(name, given, path)
            if before.source not in INFERRED_SOURCES:
                return replace(label, given=before), known if isinstance(known, str) and known else None
    problem = f"what hull {name!r} was given before is no label that a person, a file or a machine gave"
    raise AssetError(problem, where=str(path), remedy=_REMEDY)


def _parse_label(name: str, value: Any, path: Path) -> Label:
    if not (isinstance(value, dict) and isinstance(value.get("label"), str) and value["label"]):
        raise AssetError(f"hull {name!r} has no label, which is a text", where=str(path), remedy=_REMEDY)
    confidence, source = value.get("confidence", 1.0), value.get("source", "file")
    if isinstance(confidence, bool) or not isinstance(confidence, int | float) or not 0.0 <= confidence <= 1.0:
        problem = f"the confidence of hull {name!r} is {confidence!r}, not a number from 0 to 1"
        raise AssetError(problem, where=str(path))
    if source == "consensus":  # in projects of before
        source = "propagated"
    if source not in LABEL_SOURCES:
        remedy = f"It is one of: {', '.join(LABEL_SOURCES)}."
        raise AssetError(f"the source of hull {name!r} is {source!r}", where=str(path), remedy=remedy)
    return Label(value["label"], float(confidence), source)


def _check_label(name: str, label: str, vocabulary: Sequence[str], path: Path) -> None:
    if not label.isprintable():
        raise AssetError(f"the label {label!r} of hull {name!r} is no plain text", where=str(path))
    if vocabulary and label not in vocabulary and not is_class_name(label):
        hint = suggest_name(label, vocabulary, f"The vocabulary is: {', '.join(vocabulary)}.")
        raise AssetError(f"the label {label!r} of hull {name!r} is not in its vocabulary", where=str(path), remedy=hint)


@dataclass(frozen=True, eq=False, slots=True)
class LabelMatch:
    """Where the labels of a file belong. labels: by the name that the hull has now.

    changed: hulls that keep name and label, with other geometry than was labelled; renamed: old and new names of
    hulls that the label followed; gone: names in the file that no hull answers to. All in the file's order.
    """

    labels: Mapping[str, Label]
    changed: tuple[str, ...]
    renamed: tuple[tuple[str, str], ...]
    gone: tuple[str, ...]


@dataclass(frozen=True, eq=False, slots=True)
class LabelTransfer(LabelMatch):
    """A mesh with the labels of a file."""

    mesh: SymbolicMesh


def transfer_labels(file: LabelFile, mesh: SymbolicMesh) -> LabelTransfer:
    """Return the mesh with the labels of the file, in the places that `match_labels` gives them."""
    homes = match_labels(file, {hull.name: digest(hull.shape) if file.digests else "" for hull in mesh.hulls})
    return LabelTransfer(homes.labels, homes.changed, homes.renamed, homes.gone, mesh.with_labels(homes.labels))


def match_labels(file: LabelFile, hulls: Mapping[str, str]) -> LabelMatch:
    """Return where labels belong among hulls, given as digests by name; hulls are known again by name and by digest.

    A label stays with its name. Where the name is gone, or has other geometry, it goes to the one hull that has the
    digest, provided that the file gives that digest once; so the labels of a renumbered file move with their hulls.
    """
    moved = _match_renamed(file, hulls)
    claimed = set(moved.values())
    labels: dict[str, Label] = {}
    changed, gone = [], []
    for name, label in file.labels.items():
        home = moved.get(name, name if name in hulls and name not in claimed else None)
        if home is None:
            gone.append(name)
            continue
        labels[home] = label
        if home == name and file.digests.get(name, hulls[name]) != hulls[name]:
            changed.append(name)
    return LabelMatch(labels, tuple(changed), tuple(moved.items()), tuple(gone))


def _match_renamed(file: LabelFile, here: Mapping[str, str]) -> dict[str, str]:
    authored = Counter(file.digests.values())
    present = Counter(here.values())
    names = {geometry: name for name, geometry in here.items()}
    return {
        name: names[geometry]
        for name, geometry in file.digests.items()
        if here.get(name) != geometry and authored[geometry] == present[geometry] == 1
    }
