"""meshforge.toml: what a project is about, as its owner writes it, with the table [vlm] of the model that is asked for
labels; the folder that is made with it, and the assets that it names.
"""

import os
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from meshforge import batch, formats, language
from meshforge.common import MeshForgeError, ProjectError, UsageError, plain_path, write_atomically
from meshforge.store.layout import ATTRIBUTES, invalid_file
from meshforge.symbolic import refuse_class_names

Price = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Seconds = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Fraction = Annotated[float, Field(gt=0, le=1)]
Up = Literal["", "Y", "Z"]
TomlValue = str | float | Sequence[str]


class VlmSettings(BaseModel):
    """The table [vlm]: which model is asked, and how. The key is never written here.

    key_env: the environment variable that holds the key, empty for none; None takes that of a host that is known.
    every_hull: whether it is asked about every hull, or about exemplars of which labels are propagated; about: a line
    on what the meshes are; descriptions: a line on some labels; names: whether it is given the names of assets and
    hulls. Prices are in dollars a million tokens, None where not known; max_cost: the most that one run may cost [$].
    room: tokens for an answer besides those it needs, of which a model that thinks first needs more; size: of pictures
    [px]. concurrency: questions under way at once; timeout [s] for one attempt; retries:
    further attempts after a fault that passes. extra: further fields of every request, for what a server wants besides.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    base_url: str = "https://api.openai.com/v1"
    model: str = ""
    key_env: str | None = None
    every_hull: bool = False
    about: str = ""
    descriptions: Mapping[str, str] = {}
    names: bool = False
    input_price: Price | None = None
    output_price: Price | None = None
    max_cost: Price | None = None
    room: Annotated[int, Field(ge=100)] = 1000
    size: Annotated[int, Field(ge=256, le=4096)] = 768
    concurrency: Annotated[int, Field(ge=1, le=256)] = 4
    timeout: Seconds = 120.0
    retries: Annotated[int, Field(ge=0, le=20)] = 5
    extra: Mapping[str, Any] = {}


class Thresholds(BaseModel):
    """epsilon and delta; None takes the language's own."""

    model_config = ConfigDict(extra="allow", frozen=True)

    contact: Fraction | None = None
    extremity: Fraction | None = None


class Settings(BaseModel):
    """The contents of meshforge.toml; tables it does not know are left alone.

    assets: files, folders and globs, relative to the project; base: the folder that ids count from.
    orient: the directive as a program has it, without the word `orient`; empty for none.
    up: the axis that points up in views and pictures of assets whose format does not say; empty for not known, then Z.
    names: the label that names mean, by patterns of names, in their order; empty for none.
    left_out, removed: ids of assets that are not of the family, as earlier versions noted them here; urdf_capsules:
    whether written URDFs get `<capsule>`; extractors: names of leaf extractors of plug-ins that rules may use; goals:
    what assets must do, by name.
    """

    model_config = ConfigDict(extra="allow", frozen=True)

    name: str
    assets: tuple[str, ...]
    base: str
    vocabulary: tuple[str, ...] = ()
    orient: str = ""
    up: Up = ""
    thresholds: Thresholds = Thresholds()
    vlm: VlmSettings = VlmSettings()
    names: dict[str, str] = {}
    left_out: tuple[str, ...] = ()
    removed: tuple[str, ...] = ()
    urdf_capsules: bool = False
    extractors: tuple[str, ...] = ()
    goals: dict[str, str] = {}

    @property
    def view_up(self) -> Literal["y", "z"] | None:
        """The axis as assets have it."""
        return "y" if self.up == "Y" else "z" if self.up else None


def read_settings(folder: Path) -> Settings:
    """Return the settings of a project. Raises ProjectError: no project here, no TOML, or a field that does not fit."""
    path = folder / batch.SETTINGS
    text = _read_text(path)
    try:
        return _parse_settings(text)
    except tomllib.TOMLDecodeError as error:
        raise ProjectError(f"this is no TOML: {error}", where=str(path), remedy="Correct the file by hand.") from error
    except ValidationError as error:
        raise invalid_file(path, error, "Correct the file by hand.") from error


@lru_cache(maxsize=8)
def _parse_settings(text: str) -> Settings:
    """The settings in a text; they are asked for several times for every asset. Raises as its two steps do."""
    return Settings.model_validate(tomllib.loads(text))


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
    if settings.up:
        text += f"# What points up in pictures: OBJ, STL and PLY files do not say.\nup = {toml_value(settings.up)}\n"
    write_atomically(folder / batch.SETTINGS, text)


def change_setting(folder: Path, key: str, value: TomlValue | None) -> None:
    """Change one value of meshforge.toml, or remove it by None; all else stays as its owner wrote it."""
    path = folder / batch.SETTINGS
    edited = edit_settings(folder, {key: value})
    if edited != _read_text(path):
        write_atomically(path, edited)


def change_goal(folder: Path, name: str, text: str | None) -> None:
    """Keep what assets must do in the table [goals], or remove it by None; the caller holds the lock."""
    write_atomically(folder / batch.SETTINGS, edit_settings(folder, {name: text}, "goals"))


def edit_settings(folder: Path, values: Mapping[str, TomlValue | None], table: str | None = None) -> str:
    """Return the text of meshforge.toml with some values changed, of the top level or of a table; None removes one."""
    read_settings(folder)  # which says what is wrong with it
    path = folder / batch.SETTINGS
    text = _read_text(path)
    try:
        for key, value in values.items():
            text = set_value(text, key, value, table)
    except ProjectError as error:
        raise error.at(str(path)) from None
    return text


def toml_value(value: TomlValue) -> str:
    """Return a value as TOML writes it: a string, a number, or an array of strings."""
    import tomlkit  # lazy: reading settings needs the standard library only

    if isinstance(value, str | int | float):
        return tomlkit.item(value).as_string()
    return f"[{', '.join(map(toml_value, value))}]"


def set_value(text: str, key: str, value: TomlValue | None, table: str | None = None) -> str:
    """Return a TOML text with one key of the top level, or of a table (`a` or `a.b`), set, or removed by None.

    Comments and layout stay as their author wrote them. Raises ProjectError for a key inside an inline table.
    """
    import tomlkit  # lazy: as above
    from tomlkit.items import InlineTable  # lazy: as above

    document = tomlkit.parse(text)
    part: Any = document
    # parsed from its text, as tomlkit takes seconds to make an array of thousands of paths from a list
    item = None if value is None else tomlkit.value(toml_value(value))
    for name in table.split(".") if table else ():
        part = part.get(name)
        if part is None:
            return text if item is None else f"{text}\n[{table}]\n{tomlkit.dumps({key: item})}"
        if isinstance(part, InlineTable):
            raise ProjectError(f"the key {key!r} cannot be changed where it stands", remedy="Change it by hand.")
    if item is not None:
        part[key] = item
    elif key in part:
        del part[key]
    return tomlkit.dumps(document)


def orientation(settings: Settings, folder: Path) -> language.Orient | None:
    """Return the orientation directive. Raises ProjectError where its text does not parse."""
    return parse_orientation(settings.orient, str(folder / batch.SETTINGS))


def parse_orientation(text: str, where: str = "orient") -> language.Orient | None:
    """Return the directive in a text, with or without the word `orient`; None for an empty text."""
    text = text.strip()
    if not text:
        return None
    try:
        return language.Program.parse(text if text.startswith("orient ") else f"orient {text}", "orient").orient
    except MeshForgeError as error:
        raise ProjectError(f"the orientation does not parse: {error.message}", where=where) from error


def orientation_text(orient: language.Orient | None) -> str:
    """Return the text of a directive, without the word `orient`."""
    return language.show(orient).removeprefix("orient ") if orient else ""


def _read_text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except (FileNotFoundError, NotADirectoryError) as error:
        raise ProjectError(
            "this is no project", where=str(path.parent), remedy="Make one: meshforge new PROJECT ASSETS..."
        ) from error
    except UnicodeDecodeError as error:
        remedy = "Save it as UTF-8."
        raise ProjectError("cannot be read: it is not text in UTF-8", where=str(path), remedy=remedy) from error
    except OSError as error:
        raise ProjectError(f"cannot be read: {error.strerror}", where=str(path)) from error


def path_seen_from(folder: Path, pattern: str) -> str:
    """Return a path or glob, given from here, as it is written in a file of that folder."""
    try:
        return Path(os.path.relpath(pattern, folder)).as_posix()
    except ValueError:  # another drive
        return Path(pattern).absolute().as_posix()


def create_folder(
    folder: str | Path,
    assets: Sequence[str | Path],
    name: str | None,
    vocabulary: Sequence[str],
    orient: language.Orient | str | None,
    up: Up,
) -> Path:
    """Make a project folder, and give its absolute path. Raises as `Project.create` does."""
    if not str(folder):
        raise UsageError("the folder to make has no name", remedy="Name it; . is the one you are in.")
    refuse_class_names(vocabulary)
    folder = Path(folder).absolute()
    if (folder / batch.SETTINGS).exists():
        raise ProjectError("there is a project here already", where=str(folder), remedy="Choose another folder.")
    found = batch.expand(assets)
    text = orient if isinstance(orient, str) else orientation_text(orient)
    parse_orientation(text)
    settings = Settings(
        name=name or folder.name,
        assets=tuple(path_seen_from(folder, str(pattern)) for pattern in assets),
        base=path_seen_from(folder, str(found.base)),
        vocabulary=tuple(vocabulary),
        orient=text,
        up=up,
    )
    write_settings(folder, settings)
    _merge_events_by_lines(folder / ".gitattributes")
    return folder


def _merge_events_by_lines(path: Path) -> None:
    text = path.read_text("utf-8") if path.exists() else ""
    if ATTRIBUTES not in text:
        write_atomically(path, text + "\n" * (bool(text) and not text.endswith("\n")) + ATTRIBUTES)


def find_assets(folder: Path) -> batch.AssetSet:
    """Return the assets that the settings of a project name. Raises ProjectError where one is gone or elsewhere."""
    settings = read_settings(folder)
    base = Path(os.path.normpath(folder / settings.base))
    try:
        paths = batch.expand(settings.assets, folder).paths
    except UsageError as error:
        raise ProjectError(f"assets: {error.message}", where=str(folder / batch.SETTINGS)) from None
    found = batch.AssetSet(base, paths, None if base.is_relative_to(folder) else folder)
    for key in found.ids:
        if key.startswith("../"):
            raise ProjectError(
                f"the asset {key} lies outside of {base}, the folder that ids count from",
                where=str(folder / batch.SETTINGS),
                remedy="Make another project for it, or move it there.",
            )
    return found


def add_assets(folder: Path, found: batch.AssetSet, paths: Iterable[str | Path]) -> tuple[str, ...]:
    """Name files among the assets of the settings, as far as these do not mean them already, and return their ids; the
    caller holds the lock.

    Assets that a pattern would pass over because of the new files, such as mesh files in a folder that gets a URDF,
    are named as well. Raises ProjectError for a file that is no asset, or lies outside of the folder of the ids.
    """
    wanted = [_check_path(found, plain_path(Path(path))) for path in paths]
    present = set(find_assets(folder).paths)
    had = (path for path in found if path.exists())
    more = [path for path in dict.fromkeys([*had, *wanted]) if path not in present]
    if more:
        names = (path_seen_from(folder, str(path)) for path in more)
        change_setting(folder, "assets", (*read_settings(folder).assets, *names))
    return tuple(batch.asset_id(path, found.base_of(path)) for path in wanted)


def _check_path(found: batch.AssetSet, path: Path) -> Path:
    if not path.is_relative_to(found.base_of(path)):
        remedy = "Put it there, or make another project for it."
        raise ProjectError(
            f"it lies outside of {found.base}, the folder that ids count from", where=str(path), remedy=remedy
        )
    if not formats.is_asset(path):
        remedy = f"Known suffixes: {', '.join(formats.all_suffixes())}."
        raise ProjectError("this is no asset that can be read", where=str(path), remedy=remedy)
    return path
