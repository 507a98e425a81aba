"""Names each file of a project once, with what else depends on it; reads and writes JSON files."""

import codecs
import re
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Annotated, Literal, Self, TypeVar, overload

from pydantic import AliasChoices, BaseModel, ConfigDict, Field, ValidationError

from meshforge import batch, geometry
from meshforge.batch import SETTINGS, STATE
from meshforge.common import ProjectError, first_validation_error, to_text, write_atomically

ATTRIBUTES = "events.jsonl merge=union\n"
"""What the .gitattributes of a project says."""
Model = TypeVar("Model", bound=BaseModel)

Effect = Literal["card", "hulls", "settings", "program", "questions", "learning", "feedback", "project view"]
"""What a studio refreshes when a file changes."""


@dataclass(frozen=True)
class ProjectFile:
    """One file of a project, or a folder of files. name: its path from the project's folder; a folder ends in `/`, and
    `{asset}` stands for an id, `{name}` for a name without slash and dot.

    effects: what a studio refreshes when it changes; without any it is not watched. hulls: it is made of hulls of an
    asset or names them, so preparing the asset changes it. words: it contains labels, or digests of them. learned: it
    follows from other files, so undo overwrites it whatever is in it.
    """

    name: str
    effects: frozenset[Effect] = frozenset()
    hulls: bool = False
    words: bool = False
    learned: bool = False

    @cached_property
    def _pattern(self) -> re.Pattern[str]:
        text = re.escape(self.name).replace(re.escape("{asset}"), "(?P<asset>.+)")
        text = text.replace(re.escape("{name}"), "(?P<asset>[^/.]+)")
        return re.compile(
            text + ("(?P<rest>[^/]+)" if "{asset}" in text else ".+") if self.name.endswith("/") else text
        )

    def match(self, name: str) -> str | None:
        """Return the id of the asset whose file a path from the project's folder is, empty for a file of no asset; None
        where it is another file."""
        found = self._pattern.fullmatch(name)
        return found and found.groupdict().get("asset", "")

    def path(self, folder: Path, asset: str | None = None) -> Path:
        """Return the file in a project's folder; for no asset the folder of those of all assets."""
        return folder / (self.name.partition("{")[0] if asset is None else self.name.format(asset=asset, name=asset))


class OneFile(ProjectFile):
    """A file that a project has once: a path in a layout."""

    @overload
    def __get__(self, layout: None, owner: type) -> Self: ...
    @overload
    def __get__(self, layout: "Layout", owner: type) -> Path: ...
    def __get__(self, layout: "Layout | None", owner: type) -> Self | Path:
        return self if layout is None else self.path(layout.folder)


class AssetFile(ProjectFile):
    """A file that each asset has: a function of its id in a layout."""

    @overload
    def __get__(self, layout: None, owner: type) -> Self: ...
    @overload
    def __get__(self, layout: "Layout", owner: type) -> "AssetPaths": ...
    def __get__(self, layout: "Layout | None", owner: type) -> "Self | AssetPaths":
        return self if layout is None else AssetPaths(layout.folder, self)


@dataclass(frozen=True, slots=True)
class AssetPaths:
    """The paths of one kind of file, which mirror the ids of assets."""

    folder: Path
    file: AssetFile

    def __call__(self, asset: str) -> Path:
        return self.file.path(self.folder, asset)

    @property
    def ids(self) -> tuple[str, ...]:
        """The ids of all assets that have such a file, sorted; of a preparation, one that is complete."""
        root = self.file.path(self.folder)
        if self.file.name.endswith("/"):
            found = [path.parent.relative_to(root).as_posix() for path in root.rglob(batch.RECORD_FILE)]
        else:
            names = (path.relative_to(self.folder).as_posix() for path in root.rglob("*.json"))
            known = filter(None, map(identify_file, names))
            found = [asset for file, asset in known if file is self.file]
        return tuple(sorted(map(to_text, found)))


def _effects(*effects: Effect) -> frozenset[Effect]:
    return frozenset(effects)


@dataclass(frozen=True, slots=True)
class Layout:
    """The files of a project: of the class what is known of each, of an object its path."""

    folder: Path

    # What people and learning make, for git

    settings = OneFile(SETTINGS, _effects("settings", "learning"), words=True)
    labels = AssetFile("labels/{asset}.json", _effects("card", "learning"), hulls=True, words=True)
    classes = AssetFile("classes/{asset}.json", _effects("card"), hulls=True, words=True, learned=True)
    label_sources = OneFile("label_sources.json", words=True)
    like = AssetFile("labels/like/{name}.json", words=True)
    demonstration = AssetFile("demonstrations/{asset}.json", _effects("card", "learning"), hulls=True, words=True)
    manual_edits = AssetFile("corrections/{asset}.json", _effects("card"), hulls=True, words=True)
    preparation = AssetFile("prepared/{asset}/", _effects("card", "hulls", "learning"), hulls=True)
    preparation_plan = OneFile("preparation.json", _effects("project view"))
    own_templates = OneFile("templates/", _effects("learning"))
    program = OneFile("program.mf", _effects("program", "learning"), words=True, learned=True)
    previous_program = OneFile("program.previous.mf", words=True, learned=True)
    learned = OneFile("learned.json", _effects("program"), words=True, learned=True)
    events = OneFile("events.jsonl", _effects("feedback"), hulls=True, words=True)
    sign_offs = OneFile("signoffs.jsonl", words=True, learned=True)
    edited = OneFile("edited/", learned=True)

    # What can be made again

    stamps = AssetFile(f"edited/{STATE}/stamps/{{asset}}.json", _effects("card"), words=True, learned=True)
    goals = AssetFile(f"edited/{STATE}/goals/{{asset}}.json", _effects("card"))
    assessment = OneFile(f"{STATE}/assessment.json")
    review_pictures = OneFile(f"{STATE}/review/")
    asset_index = OneFile(f"{STATE}/survey.json")
    outputs = OneFile(f"{STATE}/outputs.json")
    sketches = OneFile(f"{STATE}/sketches/")
    vlm = OneFile(f"{STATE}/vlm/")
    lock = OneFile(f"{STATE}/lock")
    studio = OneFile(f"{STATE}/studio/")
    history = OneFile(f"{STATE}/studio/history/")

    @property
    def templates(self) -> tuple[Path, Path]:
        """Where templates are looked for: beside the program, then in their folder."""
        return self.folder, self.own_templates


@cache
def list_files() -> tuple[ProjectFile, ...]:
    """Return all files of a project."""
    return tuple(value for value in vars(Layout).values() if isinstance(value, ProjectFile))


def identify_file(name: str) -> tuple[ProjectFile, str] | None:
    """Return the file that a path from a project's folder is, and the id of its asset; None for another file."""
    found = [(file, asset) for file in list_files() if (asset := file.match(name)) is not None]
    return max(found, key=lambda pair: len(pair[0].name), default=None)


class JsonFile(BaseModel):
    """Base of what a project keeps as JSON. Fields that this version does not know are kept and written back."""

    model_config = ConfigDict(extra="allow", frozen=True)


ReplacedHulls = Annotated[dict[str, tuple[str, ...]], Field(exclude_if=lambda replaced: not replaced)]
"""Hulls that a line named and that a preparation replaced, each with those that the line names in its place; empty once
a person has confirmed them."""


def read_json(path: Path, model: type[Model]) -> Model | None:
    """Return what a JSON file holds, None for no file. Raises ProjectError naming the file and the field."""
    try:
        return model.model_validate_json(path.read_bytes().removeprefix(codecs.BOM_UTF8))
    except FileNotFoundError:
        return None
    except OSError as error:
        raise ProjectError(f"cannot be read: {error.strerror}", where=str(path)) from error
    except ValidationError as error:
        raise invalid_file(path, error) from error


def read_derived(path: Path, model: type[Model]) -> Model | None:
    """Return what a JSON file holds that can be made again; None where there is no such file, or it is damaged."""
    try:
        return read_json(path, model)
    except ProjectError:
        return None


def write_json(path: Path, content: BaseModel) -> None:
    """Write a JSON file, readable and fit for git."""
    write_atomically(path, json_text(content))


def json_text(content: BaseModel) -> str:
    """Return the text of a JSON file."""
    return content.model_dump_json(indent=2, by_alias=True) + "\n"


def invalid_file(
    path: Path, error: ValidationError, remedy: str = "Correct the file by hand, or remove it."
) -> ProjectError:
    """Return the error that names the first field that does not fit."""
    return ProjectError(first_validation_error(error), where=str(path), remedy=remedy)


class PreparationPlanFile(JsonFile):
    """preparation.json: when all assets of a project were prepared last; those that come later are new.

    decomposed, rebuilt: the ids of the assets that were there when pieces of all were decomposed
    last, and when bodies of all of which hulls span parts were rebuilt last (which earlier versions called split); None
    where that was never done. min_confidence: the probability from which they were; pieces: the engine of their fine
    pieces; only: which hulls and bodies, all where there are none; dismissed: hulls that a person said span no parts,
    by asset.
    """

    decomposed: tuple[str, ...] | None = None
    rebuilt: tuple[str, ...] | None = Field(default=None, validation_alias=AliasChoices("rebuilt", "split"))
    min_confidence: float | None = Field(default=None, validation_alias=AliasChoices("min_confidence", "sure"))
    pieces: geometry.PieceEngine = "coacd"
    only: tuple[str, ...] = ()
    dismissed: dict[str, tuple[str, ...]] = {}
