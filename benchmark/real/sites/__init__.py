"""Where the criteria of a family are tried: each family has a module of its name, whose `sites_of` reads true parts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from importlib.util import find_spec

from benchmark.assets.asset import Site
from script.samples.part import Part


def sites_of(family: str, parts: Sequence[Part]) -> tuple[Site, ...]:
    """The sites of an asset of a family, from its true parts alone; none where the family has no such module."""
    name = f"{__name__}.{family}"
    if find_spec(name) is None:
        return ()
    find: Callable[[Sequence[Part]], Sequence[Site]] = import_module(name).sites_of
    return tuple(find(parts))
