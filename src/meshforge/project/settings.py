"""meshforge.toml: what a project is about, as its owner writes it."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from meshforge.batch import SETTINGS
from meshforge.errors import MeshForgeError, ProjectError
from meshforge.files import write_atomically
from meshforge.language import Orient, Program, show
from meshforge.project.json_files import invalid
from meshforge.project.labels.vlm.settings import VlmSettings
from meshforge.project.toml_edit import Value, set_value, toml_value

if TYPE_CHECKING:
    from meshforge.project.project import Project

Share = Annotated[float, Field(gt=0, le=1)]


class Thresholds(BaseModel):
    """epsilon and delta; None takes the language's own."""

    model_config = ConfigDict(extra="allow", frozen=True)

    contact: Share | None = None
    extremity: Share | None = None


class Settings(BaseModel):
    """The contents of meshforge.toml; tables it does not know are left alone.

    assets: files, folders and globs, relative to the project; base: the folder that ids count from.
    orient: the directive as a program has it, without the word `orient`; empty for none.
    names: the label that names mean, by patterns of names, in their order; empty for none.
    """

    model_config = ConfigDict(extra="allow", frozen=True)

    name: str
    assets: tuple[str, ...]
    base: str
    vocabulary: tuple[str, ...] = ()
    orient: str = ""
    thresholds: Thresholds = Thresholds()
    vlm: VlmSettings = VlmSettings()
    names: dict[str, str] = {}


def read_settings(folder: Path) -> Settings:
    """The settings of a project. Raises ProjectError: no project here, no TOML, or a field that does not fit."""
    path = folder / SETTINGS
    text = _text(path)
    try:
        return Settings.model_validate(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise ProjectError(f"this is no TOML: {error}", where=str(path), remedy="Mend the file by hand.") from error
    except ValidationError as error:
        raise invalid(path, error) from error


def write_settings(folder: Path, settings: Settings) -> None:
    """Write the settings of a new project, with a remark on each."""
    vocabulary, assets, base = (toml_value(v) for v in (settings.vocabulary, settings.assets, settings.base))
    text = f"""\
name = {toml_value(settings.name)}

# Files, folders and globs of assets, relative to this folder.
assets = {assets}
# The folder that the ids of assets count from. Labels and demonstrations are kept by id, so leave it as it is.
base = {base}

# What hulls can be.
vocabulary = {vocabulary}
# How assets are turned before the program sees them, for example "+Z: Is(leg) -> Is(panel)".
orient = {toml_value(settings.orient)}
"""
    write_atomically(folder / SETTINGS, text)


def change_setting(folder: Path, key: str, value: Value) -> None:
    """Change one value of meshforge.toml; all else stays as its owner wrote it."""
    path = folder / SETTINGS
    edited = changed_settings(folder, {key: value})
    if edited != _text(path):
        write_atomically(path, edited)


def changed_settings(folder: Path, values: Mapping[str, Value]) -> str:
    """The text of meshforge.toml with some values changed."""
    path = folder / SETTINGS
    text = _text(path)
    try:
        for key, value in values.items():
            text = set_value(text, key, value)
    except ProjectError as error:
        raise error.at(str(path)) from None
    return text


def set_vocabulary(project: Project, labels: Sequence[str]) -> None:
    """Set the labels that hulls can have. Raises ProgramError for one that no program could write."""
    Program(labels=tuple(labels))
    with project.lock():
        change_setting(project.folder, "vocabulary", tuple(labels))


def set_orientation(project: Project, orient: Orient | str | None) -> None:
    """Set the orientation directive. Raises ProjectError for a text that is none."""
    directive = parse_orientation(orient) if isinstance(orient, str) else orient
    with project.lock():
        change_setting(project.folder, "orient", orientation_text(directive))


def orientation(settings: Settings, folder: Path) -> Orient | None:
    """The orientation directive. Raises ProjectError where its text does not parse."""
    return parse_orientation(settings.orient, str(folder / SETTINGS))


def parse_orientation(text: str, where: str = "orient") -> Orient | None:
    """The directive in a text, with or without the word `orient`; None for an empty text."""
    text = text.strip()
    if not text:
        return None
    try:
        return Program.parse(text if text.startswith("orient ") else f"orient {text}", "orient").orient
    except MeshForgeError as error:
        raise ProjectError(f"the orientation does not parse: {error.message}", where=where) from error


def orientation_text(orient: Orient | None) -> str:
    """The text of a directive, without the word `orient`."""
    return show(orient).removeprefix("orient ") if orient else ""


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError as error:
        raise ProjectError(
            "this is no project", where=str(path.parent), remedy="Make one: meshforge new PROJECT ASSETS..."
        ) from error
    except UnicodeDecodeError as error:
        raise ProjectError("cannot be read: it is not text in UTF-8", where=str(path)) from error
    except OSError as error:
        raise ProjectError(f"cannot be read: {error.strerror}", where=str(path)) from error


def seen_from(folder: Path, pattern: str) -> str:
    """A path or glob, given from here, as it is written in a file of that folder."""
    try:
        return Path(os.path.relpath(pattern, folder)).as_posix()
    except ValueError:  # another drive
        return Path(pattern).absolute().as_posix()
