"""Actions and leaf extractors by name; and how those of plug-ins go to another process."""

import copyreg
import pickle
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields, is_dataclass
from inspect import isabstract
from typing import Any, TypeVar

from meshforge.common import Plugin, PluginError, PluginKind, Registry, UsageError, blame, suggest_among
from meshforge.language.actions.base import Action, MissingAction
from meshforge.language.actions.basic import Add, Delete, Each, Merge, Scale, Shrink
from meshforge.language.actions.replace import Replace
from meshforge.language.arguments import ArgumentType, MissingOperation, Operation
from meshforge.language.extractors.attach import Attach
from meshforge.language.extractors.base import Leaf, MissingExtractor
from meshforge.language.extractors.bases import All, Is
from meshforge.language.extractors.geo import Geo
from meshforge.language.words import RESERVED

_WORD = re.compile(r"[^\W\d]\w*")
T = TypeVar("T", bound=Operation)


class OperationRegistry(Registry[type[T]]):
    """The operations of one kind by name.

    base: what their classes are derived from; missing: the class that stands for one whose package is missing.
    """

    def __init__(self, kind: PluginKind, base: type[T], built_in: Iterable[type[T]], missing: type[T]) -> None:
        super().__init__(kind, {one.word(): one for one in built_in}, self._adopt_kind, RESERVED)
        self._base, self.missing = base, missing

    def require(self, name: str) -> type[T]:
        """Return the class of a name. Raises UsageError where there is none, PluginError where it cannot be loaded."""
        if name not in self:
            remedy = suggest_among(name, self, f"Known {self.kind}:")
            raise UsageError(f"there is no {self.kind.removesuffix('s')} {name!r}", remedy=remedy)
        return self[name]

    def _adopt_kind(self, plugin: Plugin, kind: Any) -> type[T]:
        """The class of a plug-in's operation. Raises PluginError where it does not fit."""
        if problem := self._find_misfit(plugin.name, kind):
            raise plugin.error(f"does not fit: {problem}")
        copyreg.pickle(kind, self._reduce)
        kind.owner = plugin
        found: type[T] = kind
        return found

    def _find_misfit(self, name: str, kind: Any) -> str | None:
        if not (isinstance(kind, type) and issubclass(kind, self._base)):
            return f"it is no subclass of meshforge.language.{self._base.__name__}"
        if isabstract(kind):
            lacking = sorted(getattr(kind, "__abstractmethods__"))  # noqa: B009 (mypy knows no such)
            return f"it has no method {lacking[0]}"
        if not is_dataclass(kind) or not getattr(kind, "__dataclass_params__").frozen:  # noqa: B009 (as above)
            return "it is no frozen dataclass"
        if kind.word() != name or not _WORD.fullmatch(name):
            return f"its class is called {kind.word()}; both names must be the same word"
        bare = [one.name for one in fields(kind) if not isinstance(one.metadata.get("argument"), ArgumentType)]
        return f'its field {bare[0]} lacks metadata={{"argument": ...}}, the kind of argument' if bare else None

    def _reduce(self, made: T) -> tuple[Callable[..., Operation], tuple[str, Plugin, str, bytes]]:
        """An operation for another process: its values are unpickled there only once its class is found."""
        assert made.plugin
        values = {name: getattr(made, name) for name in made.arguments()}
        return _rebuild, (self.kind, made.plugin, str(made), pickle.dumps(values))


def make_operation(kind: type[T], values: Mapping[str, Any]) -> T:
    """Return an operation of its arguments by name. Raises ProgramError where they do not go together."""
    with blame(kind.owner):
        return kind(**values)


def _rebuild(kind: str, plugin: Plugin, text: str, values: bytes) -> Operation:
    """An operation that another process sent."""
    registry: OperationRegistry[Any] = ACTIONS if kind == ACTIONS.kind else EXTRACTORS
    try:
        found = registry.load(plugin)
        with blame(plugin):
            made: Operation = make_operation(found, pickle.loads(values))
            return made
    except PluginError as error:
        assert issubclass(registry.missing, MissingOperation)
        return registry.missing(plugin, text, error)


ACTIONS: OperationRegistry[Action] = OperationRegistry(
    "actions",
    Action,  # type: ignore[type-abstract]  # it is the base, and never made
    (Delete, Replace, Add, Merge, Scale, Shrink, Each),
    MissingAction,
)
EXTRACTORS: OperationRegistry[Leaf] = OperationRegistry(
    "extractors",
    Leaf,  # type: ignore[type-abstract]  # as above
    (All, Is, Attach, Geo),
    MissingExtractor,
)
