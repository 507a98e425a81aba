"""The JSON files of a project: read strictly, with the file and the field in every complaint, written atomically."""

from __future__ import annotations

import codecs
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError

from meshforge.errors import ProjectError, complaint
from meshforge.files import write_atomically


class JsonFile(BaseModel):
    """Base of what a project keeps as JSON. Fields that this version does not know are kept and written back."""

    model_config = ConfigDict(extra="allow", frozen=True)


Model = TypeVar("Model", bound=BaseModel)


def read_json(path: Path, model: type[Model]) -> Model | None:
    """What a JSON file holds, None where there is no such file. Raises ProjectError naming the file and the field."""
    try:
        return model.model_validate_json(path.read_bytes().removeprefix(codecs.BOM_UTF8))
    except FileNotFoundError:
        return None
    except OSError as error:
        raise ProjectError(f"cannot be read: {error.strerror}", where=str(path)) from error
    except ValidationError as error:
        raise invalid(path, error) from error


def write_json(path: Path, content: BaseModel) -> None:
    """Write a JSON file, readable and fit for git."""
    write_atomically(path, json_text(content))


def json_text(content: BaseModel) -> str:
    """The text of a JSON file."""
    return content.model_dump_json(indent=2, by_alias=True) + "\n"


def invalid(path: Path, error: ValidationError) -> ProjectError:
    """The complaint about the first field that does not fit."""
    return ProjectError(complaint(error), where=str(path), remedy="Mend the file by hand, or remove it.")
