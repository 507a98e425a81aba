"""The names that a package offers, each imported when it is first used: a command imports only what it needs."""

import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def export_lazily(package: str, offers: Mapping[str, str]) -> tuple[Callable[[str], Any], list[str]]:
    """Return the `__getattr__` and `__all__` of a package. offers: the names that each of its modules has for others,
    in one string; a module of another package goes by its whole name.

    A name must not be that of a module of the package, too, which importing the module would put in its place. Type
    checkers read the `__init__.pyi` beside, which `python -m script.stubs` makes of this.
    """
    homes = {name: home for home, names in offers.items() for name in names.split()}

    def get_attribute(name: str) -> Any:
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        home = homes[name]
        value = getattr(import_module(home if home.startswith("meshforge.") else f"{package}.{home}"), name)
        setattr(sys.modules[package], name, value)
        return value

    return get_attribute, sorted(homes)
