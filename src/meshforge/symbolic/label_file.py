"""Labels as a file beside an asset: readable JSON, keyed by hull name, with a digest of each hull's geometry."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any

from meshforge.errors import AssetError, nearest
from meshforge.files import write_atomically
from meshforge.geometry import digest
from meshforge.symbolic.labels import SOURCES, Label
from meshforge.symbolic.mesh import SymbolicMesh

_REMEDY = 'Expected {"vocabulary": [label, …], "hulls": {name: {"label", "confidence", "source", "digest"}}}.'


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


def write_labels(path: Path | None, mesh: SymbolicMesh, vocabulary: Sequence[str]) -> str:
    """The text of the labels of a mesh, in its order, written to `path` unless that is None."""
    digests = {hull.name: digest(hull.shape) for hull in mesh.hulls if hull.annotation}
    text = labels_text(LabelFile(tuple(vocabulary), mesh.labels, digests))
    if path is not None:
        write_atomically(path, text)
    return text


def labels_text(file: LabelFile) -> str:
    """The text of a labels file: one hull a line; labels that its vocabulary lacks are added at the end of that."""
    labels = [label.name for label in file.labels.values()]
    words = json.dumps(list(dict.fromkeys([*file.vocabulary, *labels])), ensure_ascii=False)
    rows = [_row(name, label, file.digests.get(name)) for name, label in file.labels.items()]
    hulls = "{\n" + ",\n".join(rows) + "\n  }" if rows else "{}"
    return f'{{\n  "vocabulary": {words},\n  "hulls": {hulls}\n}}\n'


def _row(name: str, label: Label, geometry: str | None) -> str:
    value: dict[str, Any] = {"label": label.name, "confidence": label.confidence, "source": label.source}
    value |= {"digest": geometry} if geometry else {}
    return f"    {json.dumps(name, ensure_ascii=False)}: {json.dumps(value, ensure_ascii=False)}"


def read_labels(path: Path) -> LabelFile:
    """The labels of a file; the short form `{"hulls": {name: label}}` is read too, as of source `file`.

    Raises AssetError naming file and hull: unreadable, no JSON, or not of that form.
    """
    data = _json(path)
    known = {"vocabulary", "hulls"}
    if not isinstance(data, dict) or not isinstance(data.get("hulls"), dict):
        raise AssetError("this is no labels file", where=str(path), remedy=_REMEDY)
    if not data.keys() <= known:
        odd = next(key for key in data if key not in known)
        raise AssetError(f"the field {odd!r} is not one of a labels file", where=str(path), remedy=_REMEDY)
    vocabulary = data.get("vocabulary", [])
    if not isinstance(vocabulary, list) or not all(isinstance(word, str) and word for word in vocabulary):
        raise AssetError("its vocabulary is not a list of labels", where=str(path), remedy=_REMEDY)
    entries = {name: _Entry.of(name, value, path) for name, value in data["hulls"].items() if value is not None}
    for name, entry in entries.items():
        _check_word(name, entry.label.name, vocabulary, path)
    return LabelFile(
        tuple(dict.fromkeys(vocabulary)),
        MappingProxyType({name: entry.label for name, entry in entries.items()}),
        MappingProxyType({name: entry.digest for name, entry in entries.items() if entry.digest}),
    )


def _json(path: Path) -> Any:
    try:
        return json.loads(path.read_text(encoding="utf-8-sig"), object_pairs_hook=_without_doubles)
    except OSError as error:
        raise AssetError(f"the labels cannot be read ({error.strerror})", where=str(path)) from error
    except UnicodeDecodeError as error:
        raise AssetError("the labels are not UTF-8 text", where=str(path)) from error
    except json.JSONDecodeError as error:
        place = f"{path}:{error.lineno}:{error.colno}"
        raise AssetError(f"the labels are no JSON ({error.msg})", where=place, remedy=_REMEDY) from error
    except (RecursionError, ValueError) as error:
        raise AssetError("the labels are no JSON that can be read", where=str(path), remedy=_REMEDY) from error
    except _TwiceError as error:
        raise AssetError(f"{error.args[0]!r} is given twice", where=str(path), remedy="Keep one of them.") from error


class _TwiceError(Exception):
    """A name that occurs twice in an object."""


def _without_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, value in pairs:
        if name in found:
            raise _TwiceError(name)
        found[name] = value
    return found


@dataclass(frozen=True, slots=True)
class _Entry:
    label: Label
    digest: str | None = None

    @staticmethod
    def of(name: str, value: Any, path: Path) -> _Entry:
        """What the file says of one hull, in the long form or the short."""
        match value:
            case str() if value:
                return _Entry(Label(value, 1.0, "file"))
            case {"label": str(label), **rest} if label:
                return _Entry(Label(label, _confidence(name, rest, path), _source(name, rest, path)), _digest(rest))
        raise AssetError(f"hull {name!r} has no label, which is a text", where=str(path), remedy=_REMEDY)


def _confidence(name: str, rest: Mapping[Any, Any], path: Path) -> float:
    value = rest.get("confidence", 1.0)
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0.0 <= value <= 1.0:
        raise AssetError(f"the confidence of hull {name!r} is {value!r}, not a number from 0 to 1", where=str(path))
    return float(value)


def _source(name: str, rest: Mapping[Any, Any], path: Path) -> Any:
    value = rest.get("source", "file")
    if value not in SOURCES:
        remedy = f"It is one of: {', '.join(SOURCES)}."
        raise AssetError(f"the source of hull {name!r} is {value!r}", where=str(path), remedy=remedy)
    return value


def _digest(rest: Mapping[Any, Any]) -> str | None:
    value = rest.get("digest")
    return value if isinstance(value, str) and value else None


def _check_word(name: str, label: str, vocabulary: Sequence[str], path: Path) -> None:
    if not label.isprintable():
        raise AssetError(f"the label {label!r} of hull {name!r} is no plain text", where=str(path))
    if vocabulary and label not in vocabulary:
        like = nearest(label, vocabulary)
        hint = f"Did you mean {like!r}?" if like else f"The vocabulary is: {', '.join(vocabulary)}."
        raise AssetError(f"the label {label!r} of hull {name!r} is not in its vocabulary", where=str(path), remedy=hint)
