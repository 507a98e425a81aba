"""Names of the source that nothing calls but tests and benchmarks: `script/check` fails on each.

Looked at are functions and classes of modules, and methods and properties of these classes; constants and fields are
not. A name is called where code that is itself called reads it, or where somebody outside the source does
(`find_outside_callers`). A name of a module is followed through imports. A method is called where any attribute of its
name is read, so one that shares its name with a method in use is not found.
"""

from __future__ import annotations

import ast
import re
import tomllib
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from script.structure import Module

PAGES = ("README.md", "docs/python.md", "docs/plugins.md")
"""What these name in code, people call from Python and from plug-ins."""
GENERATORS = ("script.wire", "script.samples", "script.families")
"""Scripts that write files of the wheel. All others draw, measure or test: no callers, as benchmarks are none."""
PLAIN_DECORATORS = (
    *("dataclass", "property", "cached_property", "staticmethod", "classmethod", "abstractmethod", "contextmanager"),
    *("cache", "lru_cache", "wraps", "overload", "runtime_checkable"),
)
"""Decorators of libraries that hand a function to nobody; those of routes and validators do."""
PLAIN_BASES = (
    *("object", "ABC", "Generic", "NamedTuple", "TypedDict", "Enum", "StrEnum", "BaseModel", "local"),
    *("Exception", "ValueError", "KeyError"),
)
"""Classes of libraries that call no method of a subclass by its name."""
_WORD = re.compile(r"[A-Za-z_]\w*")
Function: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef


@dataclass(frozen=True)
class Uses:
    """What code reads: names of modules, as `module:name`, and attributes of anything."""

    names: set[str] = field(default_factory=set)
    attributes: set[str] = field(default_factory=set)

    def add(self, other: Uses) -> None:
        self.names.update(other.names)
        self.attributes.update(other.attributes)


@dataclass(frozen=True)
class Definition:
    """A name of a module or of a class, with what its code reads."""

    key: str
    uses: Uses
    owner: str | None = None
    """The class, as `module:name`, that it is a method of."""
    is_handed_over: bool = False
    """Python or a library calls it: what runs at import, a route, a validator, an operator, a library's method."""
    is_constant: bool = False

    def is_called(self, uses: Uses) -> bool:
        if self.owner is None:
            return self.is_handed_over or self.key in uses.names
        return self.owner in uses.names and (self.is_handed_over or self.key.split(".")[-1] in uses.attributes)


_TARGET = re.compile(r"[a-z_.]+:[A-Z]\w+")
"""A class in a module, named from the package of whoever imports it."""


class Names:
    """Where the names that modules read are defined."""

    def __init__(self, modules: dict[str, Module]) -> None:
        self._modules = modules
        self._own = {name: set(_list_names(module.tree.body)) for name, module in modules.items()}
        self._imports = {name: _read_imports(module) for name, module in modules.items()}
        self.classes = {
            f"{name}:{node.name}": (name, node)
            for name, module in modules.items()
            for node in module.tree.body
            if isinstance(node, ast.ClassDef)
        }

    def add(self, module: Module) -> Module:
        """Let a module outside the source read its names."""
        self._imports[module.name] = _read_imports(module)
        return module

    def find(self, module: str, name: str) -> Iterator[str]:
        """`module:name` of each that a name in a module may be, or `module` of a module; nothing of a library's."""
        if name in self._own.get(module, ()):
            yield f"{module}:{name}"
        elif homes := self._imports.get(module, {}).get(name, set()) - {(module, name)}:
            for home, own in homes:
                yield from self.find(home, own)
        elif f"{module}.{name}".rstrip(".") in self._modules:
            yield f"{module}.{name}".rstrip(".")

    def find_offered(self, package: str, words: set[str] | None) -> Iterator[str]:
        """`module:name` of what the `__init__` of a package imports, or of those of some words."""
        for name in self._imports[package]:
            if words is None or name in words:
                yield from self.find(package, name)

    def read(self, module: str, *nodes: ast.AST) -> Uses:
        """What the code of a module reads."""
        uses = Uses()
        for node in (item for top in nodes for item in ast.walk(top)):
            match node:
                case ast.Name(id=name):
                    uses.names.update(self.find(module, name))
                case ast.Attribute(value=ast.Name(id=name), attr=attribute) if name in self._imports[module]:
                    homes = set(self.find(module, name))
                    uses.names.update(key for home in homes for key in self.find(home, attribute))
                    uses.attributes.update([attribute] if homes - self._modules.keys() else [])
                case ast.Attribute(attr=attribute):
                    uses.attributes.add(attribute)
                case ast.MatchClass(kwd_attrs=attributes):
                    uses.attributes.update(attributes)
                case ast.Constant(value=str() as text) if _TARGET.fullmatch(text):  # of what is imported late
                    home, _, name = text.partition(":")
                    uses.names.update(self.find(f"{module.rpartition('.')[0]}.{home}", name))
                case ast.Call(func=ast.Name(id="getattr"), args=[_, ast.Constant(value=str() as word), *_]):
                    uses.attributes.add(word)
                case ast.Call(args=[ast.Constant(value=str() as package), ast.Constant(value=str() as word)]):
                    uses.names.update(self.find(f"{module.partition('.')[0]}.{package}", word))  # a late import
        return uses


def _read_imports(module: Module) -> dict[str, set[tuple[str, str]]]:
    """The module and the name there of all that each name of a module may be."""
    found = defaultdict(set)
    for node in module.imports:
        for alias in node.names:
            home = (node.module or "", alias.name) if isinstance(node, ast.ImportFrom) else (alias.name, "")
            found[alias.asname or alias.name].add(home)
    return dict(found)


def _list_names(body: Iterable[ast.stmt]) -> Iterator[str]:
    """The names that statements of a module define."""
    for node in body:
        match node:
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
                yield node.name
            case ast.Assign(targets=targets):
                yield from (item.id for top in targets for item in ast.walk(top) if isinstance(item, ast.Name))
            case ast.AnnAssign(target=ast.Name(id=name)):
                yield name


def define(module: Module, names: Names) -> Iterator[Definition]:
    """Every definition of a module."""
    for node in module.tree.body:
        own = list(_list_names([node]))
        key = f"{module.name}:{own[0] if own else node.lineno}"
        if isinstance(node, ast.ClassDef):
            yield from _define_class(node, module, names)
        elif isinstance(node, Function):
            is_handed_over = node.name.startswith("__") or _is_registered(node, module, names)
            yield Definition(key, names.read(module.name, node), is_handed_over=is_handed_over)
        else:
            yield Definition(key, names.read(module.name, node), is_handed_over=len(own) != 1, is_constant=True)


def _define_class(node: ast.ClassDef, module: Module, names: Names) -> Iterator[Definition]:
    """A class, and its methods; `draw = pictures.draw` is one, too."""
    key = f"{module.name}:{node.name}"
    methods = {item.name: item for item in node.body if isinstance(item, Function)}
    lines = {own: item for item in node.body for own in _list_names([item]) if _is_method(item, module, names)}
    rest = [item for item in node.body if item not in (*methods.values(), *lines.values())]
    uses = names.read(module.name, *node.bases, *node.keywords, *node.decorator_list, *rest)
    uses.attributes.update(item.id for top in rest for item in ast.walk(top) if isinstance(item, ast.Name))
    yield Definition(key, uses)
    is_open = _extends_library(node, module.name, names)
    for own, item in methods.items():
        is_handed_over = is_open or own.startswith("__") or _is_registered(item, module, names)
        yield Definition(f"{key}.{own}", names.read(module.name, item), key, is_handed_over)
    for own, line in lines.items():
        yield Definition(f"{key}.{own}", names.read(module.name, line), key)


def _is_method(node: ast.stmt, module: Module, names: Names) -> bool:
    """Whether a statement of a class gives it a function of the source by name."""
    if not isinstance(node, ast.Assign) or not isinstance(node.value, ast.Name | ast.Attribute):
        return False
    found = names.read(module.name, node.value).names
    return any(key.split(":")[-1].islower() for key in found)


def _extends_library(node: ast.ClassDef, module: str, names: Names) -> bool:
    """Whether a base of a class, or a base's base, is a library's that may call methods by name, as a protocol does."""
    for base in node.bases:
        own = ast.unparse(base).partition("[")[0].split(".")[-1]
        keys = names.read(module, base).names
        parents = [names.classes[key] for key in keys if key in names.classes and key.endswith(f":{own}")]
        if not parents and own not in PLAIN_BASES:
            return True
        if any(_extends_library(parent, home, names) for home, parent in parents):
            return True
    return False


def _is_registered(node: Function, module: Module, names: Names) -> bool:
    """Whether a decorator of a library hands a function to that library, which calls it."""
    for decorator in node.decorator_list:
        first, *more = ast.unparse(decorator).partition("(")[0].split(".")
        is_own = any((":" in key) is not bool(more) for key in names.find(module.name, first))
        if not is_own and [first, *more][-1] not in PLAIN_DECORATORS:
            return True
    return node.name.startswith("_repr_")  # notebooks show what it returns


def find_outside_callers(modules: dict[str, Module], names: Names, tools: dict[str, Module], repository: Path) -> Uses:
    """What is called from outside the source: commands, entry points, the Python interface and plug-ins, as `PAGES` and
    `__all__` say them, templates of pages, and `GENERATORS`."""
    uses = Uses()
    for name in modules:
        if name.count(".") == 2 and ".cli." in name:
            uses.names.update(names.find(name, name.split(".")[-1]))  # a command
    project = tomllib.loads((repository / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    for home, _, function in (entry.partition(":") for entry in project.get("scripts", {}).values()):
        uses.names.update(names.find(home, function))
    uses.add(_read_interface(modules, names, repository))
    for path in repository.glob("src/**/*.j2"):
        uses.attributes.update(re.findall(r"\.(\w+)", path.read_text(encoding="utf-8")))
    for name, tool in tools.items():
        if name.startswith(GENERATORS):
            uses.add(names.read(names.add(tool).name, tool.tree))
    return uses


def _read_interface(modules: dict[str, Module], names: Names, repository: Path) -> Uses:
    """The names of `meshforge.__all__`, and all that is in code on `PAGES`."""
    texts = [(repository / page).read_text(encoding="utf-8") for page in PAGES if (repository / page).is_file()]
    code = [_WORD.findall(own) for text in texts for own in re.findall(r"```python.*?\n(.*?)```", text, re.DOTALL)]
    words = {word for text in texts for own in re.findall(r"`([^`\n]+)`", text) for word in _WORD.findall(own)}
    uses = Uses(attributes={word for own in code for word in own})
    for name, module in modules.items():
        if module.path.name == "__init__.py":
            offered = None if "." not in name else words | uses.attributes
            uses.names.update(names.find_offered(name, offered))
    return uses


def find_uncalled(modules: dict[str, Module], tools: dict[str, Module], repository: Path) -> list[str]:
    """Functions, classes and methods that only tests and benchmarks call."""
    names = Names(modules)
    every = [item for module in modules.values() for item in define(module, names)]
    uses = find_outside_callers(modules, names, tools, repository)
    left = [item for item in _follow(every, uses) if not item.is_constant]
    found = [item.key for item in left if item.owner is None or item.owner in uses.names]
    return [f"{key}: only tests and benchmarks call it" for key in found]


def _follow(rest: list[Definition], uses: Uses) -> list[Definition]:
    """The definitions that nothing calls; what those that are called read is added to the uses."""
    while called := [item for item in rest if item.is_called(uses)]:
        rest = [item for item in rest if not item.is_called(uses)]
        for item in called:
            uses.add(item.uses)
    return rest
