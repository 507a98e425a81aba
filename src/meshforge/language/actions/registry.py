"""The actions by name, those of plug-ins among them; how these go to another process, and what stands for one there
where its package is missing."""

from __future__ import annotations

import copyreg
import pickle
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, is_dataclass
from inspect import isabstract
from typing import Any

from meshforge.common import Plugin, PluginError, Registry, blame
from meshforge.language.actions.base import Action, ArgumentType
from meshforge.language.actions.basic import Add, Delete, Each, Merge, Replace, Scale, Shrink
from meshforge.language.actions.edit import GroupEdit, HullGroup
from meshforge.language.words import OPERATORS

_WORD = re.compile(r"[^\W\d]\w*")
_owners: dict[type[Action], Plugin] = {}


def plugin_of(action: Action) -> Plugin | None:
    """The plug-in whose action this is, also inside of Each; None for a built-in one."""
    if isinstance(action, Each):
        return plugin_of(action.action)
    return action.plugin if isinstance(action, MissingAction) else _owners.get(type(action))


@dataclass(frozen=True, slots=True)
class MissingAction(Action):
    """Stands for an action of a plug-in that cannot be loaded in this process; it prints as that, and edits nothing."""

    plugin: Plugin
    text: str
    error: PluginError

    @classmethod
    def arguments(cls) -> dict[str, ArgumentType]:
        return {}

    def edit(self, group: HullGroup) -> GroupEdit:
        raise type(self.error)(self.error.problem, where=self.error.where, remedy=self.error.remedy)

    def __str__(self) -> str:
        return self.text


def _adopt(plugin: Plugin, kind: Any) -> type[Action]:
    """The class of a plug-in's action. Raises PluginError where it does not fit."""
    if problem := _find_misfit(plugin.name, kind):
        raise plugin.error(f"does not fit: {problem}")
    copyreg.pickle(kind, _reduce_action)
    _owners[kind] = plugin
    found: type[Action] = kind
    return found


def _find_misfit(name: str, kind: Any) -> str | None:
    if not (isinstance(kind, type) and issubclass(kind, Action)):
        return "it is no subclass of meshforge.language.Action"
    if isabstract(kind):
        return "it has no method edit"
    if not is_dataclass(kind) or not getattr(kind, "__dataclass_params__").frozen:  # noqa: B009 (mypy knows no such)
        return "it is no frozen dataclass"
    if kind.__name__ != name or not _WORD.fullmatch(name):
        return f"its class is called {kind.__name__}; both names must be the same word"
    lacking = [one.name for one in fields(kind) if not isinstance(one.metadata.get("argument"), ArgumentType)]
    return f'its field {lacking[0]} lacks metadata={{"argument": ...}}, the kind of argument' if lacking else None


_BUILT_IN: tuple[type[Action], ...] = (Delete, Replace, Add, Merge, Scale, Shrink, Each)
ACTIONS: Registry[type[Action]] = Registry(
    "actions", {kind.__name__: kind for kind in _BUILT_IN}, _adopt, reserved=OPERATORS
)


def make_action(kind: type[Action], values: Mapping[str, Any]) -> Action:
    """An action of its arguments by name. Raises ProgramError where they do not go together."""
    with blame(_owners.get(kind)):
        return kind(**values)


def _reduce_action(action: Action) -> tuple[Callable[..., Action], tuple[Plugin, str, bytes]]:
    """An action for another process: its values are unpickled there only once its class is found."""
    values = {name: getattr(action, name) for name in action.arguments()}
    return _rebuild_action, (_owners[type(action)], str(action), pickle.dumps(values))


def _rebuild_action(plugin: Plugin, text: str, values: bytes) -> Action:
    try:
        kind = ACTIONS.load(plugin)
        with blame(plugin):
            return make_action(kind, pickle.loads(values))
    except PluginError as error:
        return MissingAction(plugin, text, error)
