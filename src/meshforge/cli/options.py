"""Options that several commands share, so that they read alike everywhere, and what is made of them: the execution
options, the settings of a decomposition engine, the mesh of an asset."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import MISSING, Field, dataclass, fields, is_dataclass
from enum import StrEnum
from functools import wraps
from inspect import Parameter, Signature
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeVar, get_args, get_type_hints

import typer

from meshforge.cli.console import progress
from meshforge.common import UsageError, join_names, plain_path
from meshforge.formats import Collision, MarkName

if TYPE_CHECKING:
    from meshforge.batch import ExecutionOptions
    from meshforge.geometry import DecomposeSettings
    from meshforge.project import Project
    from meshforge.symbolic import SymbolicMesh

Arguments = TypeVar("Arguments")

Json = Annotated[bool, typer.Option("--json", help="Print JSON for scripts.")]
LabelsPath = Annotated[
    Path | None,
    typer.Option("--labels", help="Labels file; for several assets a folder that mirrors theirs.", show_default=False),
]
Workers = Annotated[int | None, typer.Option("--workers", min=1, help="Processes; default one a core.")]
EngineName = Literal["mujoco", "physx-cpu", "physx-gpu", "unreal", "unity", "bullet", "godot"]


DryRun = Annotated[bool, typer.Option("--dry-run", help="Say what would be done, write nothing.")]
ReportPath = Annotated[
    Path | None, typer.Option("--report", help="An HTML page with pictures of each asset, failures first.")
]
SarifPath = Annotated[Path | None, typer.Option("--sarif", help="A file of findings for code scanning (SARIF).")]
JunitPath = Annotated[Path | None, typer.Option("--junit", help="A file of results as test cases (JUnit XML).")]
Backend = Annotated[
    Literal["local", "ray"], typer.Option("--backend", help="Where the work is done: here, or on a Ray cluster.")
]
Timeout = Annotated[
    float | None,
    typer.Option("--timeout", min=0, help="Seconds for one asset, 0 for no bound; default 600.", show_default=False),
]

InProject = Annotated[
    Path | None,
    typer.Option("--project", help="Show ASSET as this project prepares and labels it; ASSET may be its id there."),
]
AssetFile = Annotated[Path, typer.Argument(help="A file with collision hulls, or a folder of mesh files.")]
AssetFiles = Annotated[list[str], typer.Argument(help="Files, folders or globs of assets.")]

EngineOptions = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help="An option of the engine, such as threshold=0.1; repeatable."),
]
Hollow = Annotated[
    bool, typer.Option("--hollow", help="Leave planar holes open, so that shells of one sheet are not filled.")
]
Seconds = Annotated[float | None, typer.Option("--timeout", min=0.1, help="Seconds to try.")]

MarkNames = Annotated[
    MarkName | None,
    typer.Option(
        "--names",
        help="How to mark what collides: names for unreal (glTF, OBJ), godot or unity (glTF), khr (glTF's "
        "KHR_physics_rigid_bodies) or usd (UsdPhysics).",
        show_default=False,
    ),
]
UrdfCapsules = Annotated[
    bool, typer.Option("--urdf-capsules", help="Write capsules as <capsule> in URDFs, which not all readers know.")
]
CollisionPlace = Annotated[
    Collision | None,
    typer.Option(
        "--collision",
        help="Of glTF and USD with nothing marked as collision: hulls beside what is seen, all of which stays, or in "
        "its place; default beside.",
        show_default=False,
    ),
]

AssetTimeout = Annotated[float, typer.Option("--timeout", min=0.1, help="Seconds for one asset.")]

Browser = Annotated[bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")]
Port = Annotated[
    int | None,
    typer.Option(
        "--port", min=0, max=65535, help="Port on this machine; 0 takes a free one. [default: the last one, if free]"
    ),
]


def _parse_gibibytes(text: str) -> int:
    try:
        number = float(text)
    except ValueError:
        number = 0
    if not 0 < number < 1e6:
        raise typer.BadParameter(f"{text!r} is no number of GiB above 0")
    return int(number * (1 << 30))


Memory = Annotated[
    int | None,
    typer.Option(
        "--memory",
        metavar="GIB",
        parser=_parse_gibibytes,
        help="Memory for one asset; default an even share of the machine's.",
        show_default=False,
    ),
]


@dataclass(frozen=True, slots=True)
class ExecutionArguments:
    """How the work on many assets is done, for commands that say it alike; timeout: None is the default, 0 none."""

    workers: Workers = None
    backend: Backend = "local"
    timeout: Timeout = None
    memory: Memory = None

    def to_options(self) -> ExecutionOptions:
        """Return the options of the workers."""
        from meshforge import batch  # lazy: 200 modules that info, select and convert do not need

        timeout = batch.TIMEOUT if self.timeout is None else self.timeout or None
        return batch.ExecutionOptions(self.workers, timeout, self.memory, backend=self.backend)


EXECUTION = ExecutionArguments()


def takes(kind: type[Arguments]) -> Callable[[Callable[[Arguments], None]], Callable[..., None]]:
    """Return a command of Typer's out of a function of one dataclass, whose fields are the command's parameters.

    A field that is a dataclass itself stands for its own fields, in its place.
    """
    hints = get_type_hints(kind, include_extras=True)
    groups = {name: hint for name, hint in hints.items() if isinstance(hint, type) and is_dataclass(hint)}
    parameters: list[Parameter] = []
    for field in fields(kind):  # type: ignore[arg-type]  # a dataclass
        if group := groups.get(field.name):
            own = get_type_hints(group, include_extras=True)
            parameters += [_to_parameter(inner, own[inner.name]) for inner in fields(group)]
        else:
            parameters.append(_to_parameter(field, hints[field.name]))

    def decorate(function: Callable[[Arguments], None]) -> Callable[..., None]:
        @wraps(function)
        def command(**values: Any) -> None:
            for name, group in groups.items():
                values[name] = group(**{inner.name: values.pop(inner.name) for inner in fields(group)})
            function(kind(**values))

        command.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
        command.__signature__ = Signature(parameters)  # type: ignore[attr-defined]  # Typer reads it
        return command

    return decorate


def _to_parameter(field: Field[Any], hint: Any) -> Parameter:
    default = Parameter.empty if field.default is MISSING else field.default
    return Parameter(field.name, Parameter.KEYWORD_ONLY, default=default, annotation=hint)


By = Annotated[
    Literal["whole", "parts"],
    typer.Option(
        "--by",
        help="Decompose a mesh at once, or each of its parts by itself, so that no hull crosses from one to another: "
        "its groups and nodes.",
    ),
]


Align = Annotated[
    Literal["check", "box", "off"] | None,
    typer.Option(
        "--align",
        help="Segmented points lie where the asset does (check, the default), or are turned upright, scaled and moved "
        "so that the boxes fit (box), or are taken as they are (off).",
        show_default=False,
    ),
]


MaxVertices = Annotated[
    int | None,
    typer.Option("--max-vertices", min=8, help="The most vertices that a hull may have.", show_default=False),
]
ExcludedPairs = Annotated[
    list[str] | None,
    typer.Option(
        "--exclude",
        metavar="PAIR",
        help="Two bodies that do not touch in what is written, BODY:BODY, or all that check --pairs proposes without a "
        "doubt. May be repeated.",
    ),
]


class EngineMethod(StrEnum):
    """The decomposition engines; `hull` makes one convex hull of each mesh."""

    COACD = "coacd"
    VHACD = "vhacd"
    HULL = "hull"


def parse_engine_settings(
    method: EngineMethod, given: list[str] | None, max_vertices: int | None = None
) -> DecomposeSettings:
    """Return the settings of an engine with some given as `NAME=VALUE`, and with the most vertices that a hull may
    have.

    Raises UsageError, listing what there is to set.
    """
    from meshforge.geometry import DecomposeSettings  # lazy: most commands decompose nothing

    kind = next(one for one in get_args(DecomposeSettings) if one.engine == method)
    known = {f.name: f for f in fields(kind)}
    values: dict[str, Any] = {}
    for text in given or []:
        name, _, value = text.partition("=")
        if name not in known:
            listed = "".join(f"\n    {f.name}={f.default}  {f.metadata['help']}" for f in known.values())
            raise UsageError(f"--set {text}: {method.value} has no option {name!r}", remedy=f"Its options:{listed}")
        values[name] = _parse_value(text, value, type(known[name].default))
    if max_vertices is not None:
        limit = kind.limit_vertices(max_vertices)
        if twice := limit.keys() & values.keys():
            raise UsageError(f"--max-vertices and --set {min(twice)} say the same", remedy="Give one of them.")
        values |= limit
    settings: DecomposeSettings = kind(**values)
    return settings


def split_words(text: str) -> list[str]:
    """Return the words of a list with commas between."""
    return [word.strip() for word in text.split(",") if word.strip()]


def refuse_options(context: typer.Context, names: Collection[str], without: str) -> None:
    """Raise UsageError for a parameter among some that was typed, though it says nothing `without` another option."""
    for name, option in list_typed(context):
        if name in names:
            raise UsageError(f"{option} says nothing without {without}", remedy=f"Give {without} too, or leave it out.")


def refuse_with(context: typer.Context, names: Collection[str], other: str, remedy: str = "Leave it out.") -> None:
    """Raise UsageError for a parameter among some that was typed, though it does not go with another option."""
    for name, option in list_typed(context):
        if name in names:
            raise UsageError(f"{option} does not go with {other}", remedy=remedy)


def list_typed(context: typer.Context) -> Iterator[tuple[str, str]]:
    """Yield the names of the parameters that were typed, each with its option."""
    for parameter in context.command.params:
        source = context.get_parameter_source(parameter.name or "")
        if parameter.name and source is not None and source.name == "COMMANDLINE":
            yield parameter.name, parameter.opts[-1]


def _parse_value(text: str, value: str, kind: type) -> Any:
    words = {"true": True, "yes": True, "on": True, "false": False, "no": False, "off": False}
    try:
        return words[value.lower()] if kind is bool else kind(value)
    except (KeyError, ValueError):
        raise UsageError(f"--set {text}: {value!r} is not {'yes or no' if kind is bool else 'a number'}") from None


def open_asset(asset: Path, labels: Path | None, project: Path | None) -> SymbolicMesh:
    """Return the mesh of a file with its labels; with a project, that of an asset given by its file or by its id there.

    Raises UsageError for labels beside a project, which has its own.
    """
    if project is None:
        from meshforge.formats import load  # lazy: most commands take several assets

        with progress(None, f"reading {asset.name}"):
            return load(asset, labels=labels)
    if labels:
        raise UsageError("a project has its own labels", remedy="Leave --labels out, or --project.")
    from meshforge.project import Project as Opened  # lazy: 500 modules that only --project needs

    home = Opened.open(project)
    with progress(None, f"reading {asset.name}"):
        return home.mesh(asset_id(asset, home))


def asset_id(asset: str | Path, project: Project) -> str:
    """Return the id of an asset of a project, given by its file, by that id, or by a part of it that no other asset
    has.

    A path that is no file is taken by its last name, where one asset has it. Raises UsageError, naming them, where
    several are meant; ProjectError, naming the nearest, where none is.
    """
    ids, path = project.every.ids, Path(asset)
    by_path = {plain_path(file): key for key, file in ids.items()}
    text, place = path.as_posix(), plain_path(path)
    if place in by_path or text in ids:
        return by_path.get(place, text)
    if path.exists():  # another file is no asset of the project, whatever its name
        alike = [key for file, key in by_path.items() if file.is_relative_to(place)]
    else:
        named = (key for key in ids if path.name in (PurePath(key).name, PurePath(key).stem))
        alike = [key for key in ids if _is_part(text, key)] or list(named)
    if len(alike) > 1:
        nearest = sorted(alike, key=lambda key: len(set(path.parts) ^ set(PurePath(key).parts)))
        remedy = f"Say which: {join_names(nearest)}."
        raise UsageError(f"{text!r} may be any of {len(alike)} assets", where=str(project.folder), remedy=remedy)
    project.path(alike[0] if alike else text)
    return alike[0]


def _is_part(typed: str, asset: str) -> bool:
    """Whether what was typed is whole parts of an id, with its suffix or without, or a longer path that ends in it."""
    forms = (f"/{asset}", f"/{PurePath(asset).with_suffix('').as_posix()}")
    return any(f"/{typed}/" in f"{form}/" or f"/{typed}".endswith(form) for form in forms)
