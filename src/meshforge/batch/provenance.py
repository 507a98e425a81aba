"""What an output was made from and what was written: digests of contents, never times of files, and the stamp beside
the outputs by which runs are resumed."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from dataclasses import fields as dataclass_fields
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, Literal

from pydantic import AliasChoices, BaseModel, ConfigDict, Field, ValidationError

from meshforge import formats, language
from meshforge.batch.discovery import STATE
from meshforge.batch.outcome import Edited, Failed, RuleEffect, Skipped, Unchanged
from meshforge.common import Plugin, file_digest, relative_name, write_atomically
from meshforge.geometry import digest as shape_digest
from meshforge.signoff import EditMeasures

_LOOKS = (".mtl", ".png", ".jpg", ".jpeg", ".bmp", ".tga", ".tif", ".tiff", ".webp", ".dds", ".ktx2", ".hdr", ".exr")
"""The suffixes of pictures and materials."""


class OutputInputs(BaseModel):
    """Digests of all that decides what an output is; asset: of each file, by its path relative to the common folder."""

    model_config = ConfigDict(frozen=True, populate_by_name=True)

    asset: dict[str, str]
    preparation: str | None = None
    labels: str | None
    program: str
    templates: dict[str, str]
    manual_edits: str | None = Field(validation_alias=AliasChoices("manual_edits", "corrections"))  # as it was called
    selections: str | None = None
    settings: str
    software: str

    def changes(self, other: OutputInputs) -> tuple[str, ...]:
        """Return what differs between the two, in words: `asset`, `labels`, `program`, `manual edits`, ..."""
        names = type(self).model_fields
        return tuple(name.replace("_", " ") for name in names if getattr(self, name) != getattr(other, name))


class Stamp(BaseModel):
    """One output.

    outputs: the digest of every file, by its path in the output folder; out: the main one of them.
    labels: of its hulls, in the order that the main file has them; empty where they are not known.
    measures: of the edit; labels_before: all that its hulls had before it; both None in stamps of earlier versions.
    """

    model_config = ConfigDict(frozen=True)

    asset: str
    status: Literal["edited", "unchanged", "failed"]
    inputs: OutputInputs | None = None
    outputs: dict[str, str] = {}
    out: str = ""
    labels: tuple[str | None, ...] = ()
    rules: tuple[RuleEffect, ...] = ()
    before: int = 0
    after: int = 0
    notes: tuple[str, ...] = ()
    flags: tuple[str, ...] = ()
    error: str | None = None
    measures: EditMeasures | None = None
    labels_before: tuple[str, ...] | None = None

    @staticmethod
    def of(outcome: Edited | Unchanged, inputs: OutputInputs, draft: OutputDraft) -> Stamp:
        """Return the stamp of a run that came to its end."""
        return Stamp(
            asset=outcome.asset,
            status="edited" if isinstance(outcome, Edited) else "unchanged",
            inputs=inputs,
            outputs=dict(draft.files),
            out=draft.main,
            labels=draft.labels,
            rules=outcome.rules,
            before=outcome.before,
            after=outcome.after,
            notes=outcome.notes,
            flags=outcome.flags,
            measures=outcome.measures,
            labels_before=outcome.labels,
        )

    def to_skipped(self, folder: Path) -> Skipped:
        """Return the outcome of finding this output up to date."""
        out, counts, measures = str(folder / self.out), (self.before, self.after), self.measures
        return Skipped(self.asset, out, self.rules, *counts, 0.0, self.notes, self.flags, measures, self.labels_before)

    def to_outcome(self, folder: Path) -> Edited | Unchanged | Failed:
        """Return what the run that wrote this output made of the asset."""
        if self.status == "failed":
            return Failed(self.asset, self.error or "", 0.0)
        kept = self.to_skipped(folder)
        fields = {field.name: getattr(kept, field.name) for field in dataclass_fields(kept)}
        return Edited(**fields) if self.status == "edited" else Unchanged(**fields)

    @property
    def essential(self) -> dict[str, str]:
        """The digests of the files that geometry, masses or labels are read from: of all but pictures and materials."""
        return {name: known for name, known in self.outputs.items() if not name.lower().endswith(_LOOKS)}

    def is_whole(self, folder: Path) -> bool:
        """Return whether all files of this output are there, as they were written."""
        return self.status != "failed" and are_unchanged(folder, self.outputs)

    def write(self, path: Path) -> None:
        """Write this stamp to disk."""
        write_atomically(path, self.model_dump_json(indent=1))


def stamp_path(folder: Path, asset: str) -> Path:
    """Return where the stamp of an asset is kept."""
    return folder / STATE / "stamps" / f"{asset}.json"


def read_stamp(folder: Path, asset: str) -> Stamp | None:
    """Return the stamp of an asset's output; None where none can be read, so that it is made again."""
    return read_stamp_file(stamp_path(folder, asset))


def read_stamps(folder: Path) -> Iterator[Stamp]:
    """Yield the stamps of all outputs in a folder, in the order of their paths."""
    for path in sorted((folder / STATE / "stamps").rglob("*.json")):
        stamp = read_stamp_file(path)
        if stamp:
            yield stamp


def read_stamp_file(path: Path) -> Stamp | None:
    """Return the stamp in a file; None where there is none, or none that can be read."""
    try:
        return Stamp.model_validate_json(path.read_bytes())
    except (OSError, ValidationError):
        return None


def text_digest(text: str) -> str:
    """Return thirty-two hexadecimal digits of a text."""
    return hashlib.blake2b(text.encode(), digest_size=16).hexdigest()


def value_digest(value: Any) -> str:
    """Return the digest of what JSON can hold, whatever the order of its keys."""
    return text_digest(json.dumps(value, sort_keys=True))


def content_digest(path: Path) -> str:
    """Return the digest of what a JSON file says, however it is laid out; of a file that is no JSON that of its bytes.

    Raises OSError where it cannot be read.
    """
    try:
        return value_digest(json.loads(path.read_text(encoding="utf-8-sig"), parse_int=float))
    except (ValueError, RecursionError):
        return file_digest(path)


def program_digest(program: language.Program) -> str:
    """Return the digest of what a program does: its canonical form without comments and unused labels."""
    rules = tuple(replace(rule, comments=language.Comments()) for rule in program.rules)
    return text_digest(str(replace(program, labels=(), rules=rules, comments=language.HeaderComments())))


def template_digests(templates: Mapping[str, language.Template]) -> dict[str, str]:
    """Return the digest of the shapes of each template."""
    return {name: text_digest(" ".join(map(shape_digest, templates[name].shapes))) for name in sorted(templates)}


def asset_digests(path: Path, referenced: Iterable[Path], base: Path) -> dict[str, str]:
    """Return the digest of every file of an asset, by its path relative to `base`; of a folder, its mesh files."""
    return {relative_name(file, base): file_digest(file) for file in sorted({*source_files(path), *referenced})}


def has_same_files(recorded: Mapping[str, str], path: Path, base: Path) -> bool:
    """Return whether the files of an asset are those that were recorded, without reading it as an asset."""
    if any(relative_name(file, base) not in recorded for file in source_files(path)):
        return False
    return are_unchanged(base, recorded)


def are_unchanged(folder: Path, recorded: Mapping[str, str]) -> bool:
    """Return whether all files are there, by their paths from a folder, and have the digests that were recorded."""
    return all((folder / name).is_file() and file_digest(folder / name) == known for name, known in recorded.items())


def source_files(path: Path) -> list[Path]:
    """Return the main file of an asset, or the mesh files of a folder of pieces."""
    if not path.is_dir():
        return [path]
    files = (file for file in path.iterdir() if not file.name.startswith("."))
    return sorted(file for file in files if file.suffix.lower() in formats.MESH_SUFFIXES)


def software_version(plugins: Iterable[Plugin | None] = ()) -> str:
    """Return the version of this program and of the plug-ins that are used, since others may write other files."""
    own = sorted({f"{plugin.package} {plugin.version}" for plugin in plugins if plugin})
    return ", ".join([find_version("meshforge"), *own])


@cache
def find_version(package: str) -> str:
    """Return the version of a package, empty where it is not installed."""
    try:
        return version(package)  # reading it takes half a millisecond, and each asset asks
    except PackageNotFoundError:
        return ""


@dataclass(frozen=True, slots=True)
class OutputDraft:
    """An output that lies aside: its files, and beside their folder the stamp that is to vouch for them.

    files: the digest of each file by its path in `folder`; main: the path of the main one; notes: what the format
    could not hold, or holds in another form; labels: of its hulls, in the order that the main file reads back in;
    reading: what is to be known about how the asset is read, of its own format as it is now.
    """

    folder: Path
    main: str
    files: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    labels: tuple[str | None, ...] = ()
    read_notes: tuple[str, ...] = ()

    @property
    def root(self) -> Path:
        """The folder of the files' folder and the stamp: what is put in place."""
        return self.folder.parent
