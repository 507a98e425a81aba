"""The names that a package offers, each imported when it is first used: a command imports only what it needs."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from importlib import import_module
from typing import Any

_IMPORT = re.compile(r"^    from ([\w.]+) import (\([^)]*\)|.+)", re.MULTILINE)


def export_lazily(package: str) -> Callable[[str], Any]:
    """The `__getattr__` of a package: its block `if TYPE_CHECKING:` says which names come from which modules.

    A name must not be that of a module of the package, too, which importing the module would put in its place.
    """
    homes: dict[str, str] = {}

    def get_attribute(name: str) -> Any:
        if not homes:
            homes.update(find_homes(package))
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(import_module(homes[name]), name)
        setattr(sys.modules[package], name, value)
        return value

    return get_attribute


def find_homes(package: str) -> dict[str, str]:
    """The module of each name that the `__init__.py` of an imported package imports for type checkers only."""
    module: Any = sys.modules[package]
    source = module.__loader__.get_data(module.__file__).decode("utf-8")  # from a folder as from a zip file
    block = source.replace("\r\n", "\n").partition("\nif TYPE_CHECKING:\n")[2].partition("\nelse:\n")[0]
    return {name: home for home, names in _IMPORT.findall(block) for name in re.findall(r"\w+", names)}
