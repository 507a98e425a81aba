"""Where each file of a project lies, and how its JSON files are read and written."""

from __future__ import annotations

import codecs
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError

from meshforge import batch
from meshforge.common import ProjectError, first_validation_error, to_text, write_atomically

_JOURNAL = "selections.json"
ATTRIBUTES = "events.jsonl merge=union\n"
"""What the .gitattributes of a project says."""
Model = TypeVar("Model", bound=BaseModel)


@dataclass(frozen=True, slots=True)
class Layout:
    """The paths of a project; those of one asset mirror its id."""

    folder: Path

    def labels(self, asset: str) -> Path:
        return self.folder / "labels" / f"{asset}.json"

    def demonstration(self, asset: str) -> Path:
        return self.folder / "demonstrations" / f"{asset}.json"

    def corrections(self, asset: str) -> Path:
        return self.folder / "corrections" / f"{asset}.json"

    def preparation(self, asset: str) -> Path:
        """The folder of what is done to an asset before the program."""
        return self.folder / "prepared" / asset

    def preparation_journal(self, asset: str) -> Path:
        """What preparation steps changed of selections and labels."""
        return self.preparation(asset) / _JOURNAL

    @property
    def preparation_plan(self) -> Path:
        """How new assets are prepared, and which are new."""
        return self.folder / "preparation.json"

    @property
    def label_sources(self) -> Path:
        """By what hulls were labelled."""
        return self.folder / "label_sources.json"

    @property
    def settings(self) -> Path:
        """What the project is about, as its owner writes it."""
        return self.folder / batch.SETTINGS

    @property
    def templates(self) -> tuple[Path, Path]:
        """Where templates are looked for: beside the program, then in their folder."""
        return self.folder, self.folder / "templates"

    @property
    def program(self) -> Path:
        return self.folder / "program.mf"

    @property
    def events(self) -> Path:
        """What people said."""
        return self.folder / "events.jsonl"

    @property
    def sign_offs(self) -> Path:
        """Which assets are signed off."""
        return self.folder / "signoffs.jsonl"

    @property
    def files_before_events(self) -> tuple[Path, ...]:
        """Where that was kept before: answers, verdicts, sign-offs and snoozed questions."""
        names = ("answers.json", "review.json", "signoff.json", "later.json")
        return tuple(self.folder / name for name in names)

    @property
    def learned(self) -> Path:
        """What the program was learned from; it belongs beside the program, in git too."""
        return self.folder / "learned.json"

    @property
    def learned_before(self) -> Path:
        """Where that was kept before: read while there is no other, removed when it is written."""
        return self.folder / batch.STATE / "learned.json"

    @property
    def assessment(self) -> Path:
        """How probable each edit was when the family was looked at last."""
        return self.folder / batch.STATE / "assessment.json"

    @property
    def review_pictures(self) -> Path:
        """Pictures of the question of a review."""
        return self.folder / batch.STATE / "review"

    @property
    def edited(self) -> Path:
        return self.folder / "edited"

    @property
    def lock(self) -> Path:
        return self.folder / batch.STATE / "lock"

    @property
    def survey(self) -> Path:
        """What is known of the asset files, so that they are not read again for a status."""
        return self.folder / batch.STATE / "survey.json"

    @property
    def outputs(self) -> Path:
        """What is known of the files of outputs, so that they are not hashed again for a status."""
        return self.folder / batch.STATE / "outputs.json"

    @property
    def spans(self) -> Path:
        """Which hulls were found to span parts."""
        return self.folder / batch.STATE / "spans.json"

    @property
    def single_parts(self) -> Path:
        """Which hulls a person said to be one part."""
        return self.folder / "single_parts.json"

    def span_parts(self, asset: str) -> Path:
        """The parts into which a split would divide the hulls of an asset that span parts."""
        return self.folder / batch.STATE / "spans" / f"{asset}.npz"

    @property
    def sketches(self) -> Path:
        """How the hulls of assets are described, so that labels are propagated quickly the next time."""
        return self.folder / batch.STATE / "sketches"

    @property
    def vlm(self) -> Path:
        """What was sent to models, and what came back."""
        return self.folder / batch.STATE / "vlm"

    def ids_with(self, kind: str) -> tuple[str, ...]:
        """The ids of all assets that have a file in `labels`, `demonstrations` or `corrections`, sorted."""
        root = self.folder / kind
        return tuple(
            sorted(to_text(path.relative_to(root).as_posix()).removesuffix(".json") for path in root.rglob("*.json"))
        )

    def ids_with_preparation(self) -> tuple[str, ...]:
        """The ids of all assets that have a preparation, or one whose removal was cut short, sorted."""
        root = self.folder / "prepared"
        found = {path.parent for name in (batch.RECORD_FILE, _JOURNAL) for path in root.rglob(name)}
        return tuple(sorted(to_text(path.relative_to(root).as_posix()) for path in found))


class JsonFile(BaseModel):
    """Base of what a project keeps as JSON. Fields that this version does not know are kept and written back."""

    model_config = ConfigDict(extra="allow", frozen=True)


def read_json(path: Path, model: type[Model]) -> Model | None:
    """What a JSON file holds, None where there is no such file. Raises ProjectError naming the file and the field."""
    try:
        return model.model_validate_json(path.read_bytes().removeprefix(codecs.BOM_UTF8))
    except FileNotFoundError:
        return None
    except OSError as error:
        raise ProjectError(f"cannot be read: {error.strerror}", where=str(path)) from error
    except ValidationError as error:
        raise invalid_file(path, error) from error


def read_derived(path: Path, model: type[Model]) -> Model | None:
    """What a JSON file holds that can be made again; None where there is no such file, or it is damaged."""
    try:
        return read_json(path, model)
    except ProjectError:
        return None


def write_json(path: Path, content: BaseModel) -> None:
    """Write a JSON file, readable and fit for git."""
    write_atomically(path, json_text(content))


def json_text(content: BaseModel) -> str:
    """The text of a JSON file."""
    return content.model_dump_json(indent=2, by_alias=True) + "\n"


def invalid_file(
    path: Path, error: ValidationError, remedy: str = "Correct the file by hand, or remove it."
) -> ProjectError:
    """The error that names the first field that does not fit."""
    return ProjectError(first_validation_error(error), where=str(path), remedy=remedy)
