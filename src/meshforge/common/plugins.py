"""Plug-ins: what other packages add by entry points. They are found without loading them, loaded when first asked for,
and named in every error that they cause. Libraries that may be absent, too: extras, and MuJoCo."""

from collections import UserDict
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from typing import Any, Generic, Literal, TypeVar, get_args

from meshforge.common.messages import MeshForgeError, PluginError

PluginKind = Literal["formats", "extractors", "actions", "labelers", "checks", "goals"]
PLUGIN_KINDS: tuple[PluginKind, ...] = get_args(PluginKind)
_WORDS = {
    "formats": "format .",
    "extractors": "extractor ",
    "actions": "action ",
    "labelers": "labeller ",
    "checks": "check ",
    "goals": "goal ",
}
_GROUP = "meshforge."

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Plugin:
    """One entry point of an installed package; target: what it loads, `module:attribute`."""

    kind: PluginKind
    name: str
    package: str
    version: str
    target: str

    def __str__(self) -> str:
        return f"the {_WORDS[self.kind]}{self.name} of the package {self.package} {self.version}"

    def error(self, problem: str, where: str | None = None, remedy: str | None = None) -> PluginError:
        """Return the error that this plug-in `problem`, such as `makes a hull that is not convex`."""
        return PluginError(f"{self} {problem}", where=where, remedy=remedy or f"Update or uninstall {self.package}.")

    def load(self) -> Any:
        """Return what the entry point names. Raises PluginError where it cannot be imported."""
        module, _, attribute = self.target.partition(":")
        try:
            found: Any = import_module(module)
            for step in attribute.split("."):
                found = getattr(found, step)
            return found
        except ModuleNotFoundError as error:
            if error.name and f"{module}.".startswith(f"{error.name}."):
                remedy = f"Install {self.package} {self.version} here, as where the work was started."
                raise self.error(f"is not installed here (no module {error.name!r})", remedy=remedy) from error
            raise self.error(f"cannot be loaded: {error}") from error
        except (Exception, SystemExit) as error:
            raise self.error(f"cannot be loaded: {_describe(error)}") from error


def _describe(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}".removesuffix(": ")


@contextmanager
def blame(plugin: Plugin | None, where: str | None = None) -> Iterator[None]:
    """Turn whatever is raised meanwhile into a PluginError about `where`; None: it is no plug-in's work.

    Errors that say what is wrong (MeshForgeError) stay as they are.
    """
    try:
        yield
    except MeshForgeError as error:
        if plugin is None or where is None or error.where:
            raise
        raise error.at(where) from error
    except MemoryError:
        raise
    except (Exception, SystemExit) as error:
        if plugin is None:
            raise
        remedy = f"Report it to the authors of {plugin.package}."
        raise plugin.error(f"failed: {_describe(error)}", where, remedy) from error


_adopted: dict[PluginKind, tuple[Plugin, ...]] = {}


def find_plugins(kind: PluginKind) -> tuple[Plugin, ...]:
    """Return the plug-ins of a kind that are installed, by name and package; looked for once in a process."""
    return _adopted[kind] if kind in _adopted else _find(kind)


def collect_plugins() -> dict[PluginKind, tuple[Plugin, ...]]:
    """Return the plug-ins of all kinds, for another process to adopt."""
    return {kind: find_plugins(kind) for kind in PLUGIN_KINDS}


def adopt_plugins(known: Mapping[PluginKind, tuple[Plugin, ...]]) -> None:
    """Take the plug-ins that the process has which gave this one its work, so that what is missing here has a name."""
    _adopted.update(known)


@cache
def _find(kind: PluginKind) -> tuple[Plugin, ...]:
    from importlib.metadata import entry_points  # lazy: it takes 0.02 s, and only names that are not built in need it

    found = {
        Plugin(kind, point.name, point.dist.name, point.dist.version, point.value.partition("[")[0].strip())
        for point in entry_points(group=f"{_GROUP}{kind}")
        if point.dist
    }
    return tuple(sorted(found, key=lambda one: (one.name, one.package)))


class Registry(Mapping[str, T], Generic[T]):
    """Things of one kind by name: those that are built in, then those of plug-ins, each loaded when first asked for.

    adopt: makes of what a plug-in has loaded what this registry holds; raises PluginError where it does not fit.
    reserved: names that no plug-in may take, besides those built in. A name that is built in always stays that.
    """

    def __init__(
        self,
        kind: PluginKind,
        built_in: Mapping[str, T],
        adopt: Callable[[Plugin, Any], T],
        reserved: Collection[str] = (),
    ) -> None:
        self.kind, self.built_in, self._adopt, self._reserved = kind, built_in, adopt, reserved
        self._loaded: dict[Plugin, T | PluginError] = {}

    def __getitem__(self, name: str) -> T:
        """The thing of a name. Raises KeyError where there is none, PluginError where a plug-in fails."""
        if name in self.built_in:
            return self.built_in[name]
        plugin = self.plugin(name)
        if plugin is None:
            raise KeyError(name)
        return self.load(plugin)

    def __contains__(self, name: object) -> bool:
        return name in self.built_in or (isinstance(name, str) and bool(self._claims(name)))

    def __iter__(self) -> Iterator[str]:
        return iter(dict.fromkeys([*self.built_in, *self.plugin_names]))

    def __len__(self) -> int:
        return len(list(iter(self)))

    @property
    def plugin_names(self) -> tuple[str, ...]:
        """The names that plug-ins have, without loading these."""
        names = dict.fromkeys(plugin.name for plugin in find_plugins(self.kind))
        return tuple(name for name in names if not self._is_taken(name))

    def plugin(self, name: str) -> Plugin | None:
        """Return the plug-in of a name, None where there is none. Raises PluginError where two packages have it."""
        claims = self._claims(name)
        if len(claims) > 1:
            packages = " and ".join(f"{plugin.package} {plugin.version}" for plugin in claims)
            what = f"the {_WORDS[self.kind]}{name} is in several packages: {packages}"
            raise PluginError(what, remedy="Uninstall all but one of them.")
        return claims[0] if claims else None

    def load(self, plugin: Plugin) -> T:
        """Return what a plug-in adds. Raises PluginError where it cannot be loaded, or does not fit."""
        if plugin not in self._loaded:
            try:
                self._loaded[plugin] = self._adopt(plugin, plugin.load())
            except PluginError as error:
                self._loaded[plugin] = error
        found = self._loaded[plugin]
        if isinstance(found, PluginError):
            raise type(found)(found.problem, where=found.where, remedy=found.remedy)
        return found

    def find_problem(self, plugin: Plugin) -> str | None:
        """Return why a plug-in cannot be used, None where it can."""
        if self._is_taken(plugin.name):
            return f"{plugin}: MeshForge itself has this name. Rename it in {plugin.package}."
        try:
            self.plugin(plugin.name)
            self.load(plugin)
        except PluginError as error:
            return error.sentence
        return None

    def loadable(self) -> dict[str, T]:
        """Return all that is built in, and all plug-ins that can be used."""
        found = dict(self.built_in)
        for name in self.plugin_names:
            with suppress(PluginError):
                found[name] = self[name]
        return found

    def _is_taken(self, name: str) -> bool:
        return name in self.built_in or name in self._reserved

    def _claims(self, name: str) -> list[Plugin]:
        if not name or self._is_taken(name):
            return []
        return [plugin for plugin in find_plugins(self.kind) if plugin.name == name]


class Targets(UserDict[str, Any]):
    """What is built in, by name: made by what `module:attribute` names when first asked for, once for all names."""

    def __getitem__(self, name: str) -> Any:
        return make_target(self.data[name])


@cache
def make_target(target: str) -> Any:
    """Return what the class or function `module:attribute` makes without arguments, always the same."""
    module, _, attribute = target.partition(":")
    return getattr(import_module(module), attribute)()


def import_extra(library: str, extra: str, purpose: str) -> Any:
    """Return an optional library. Raises MeshForgeError that names the extra to install; purpose: what needs it."""
    try:
        return import_module(library)
    except ImportError as error:
        problem = f"{purpose} needs the package {library}, which cannot be imported ({error})"
        raise MeshForgeError(problem, remedy=f"Install it: pip install 'meshforge[{extra}]'.") from error


def require_mujoco(what: str, where: str | None = None) -> None:
    """Raise MeshForgeError where MuJoCo, which `what` needs, is not installed; it is not loaded for that."""
    if find_spec("mujoco") is None:
        remedy = "Install it: pip install 'mujoco>=4.0'. It has no wheel for macOS on Intel: work on another machine."
        raise MeshForgeError(f"{what} needs MuJoCo, which is not installed", where=where, remedy=remedy)
