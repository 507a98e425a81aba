"""The engines, as `engines.toml` has them, row by row, and notes on hulls that are written for them; `docs/engines.md`
shows that table, and a test holds the two together."""

from __future__ import annotations

import tomllib
from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace
from importlib.resources import files
from types import MappingProxyType

from meshforge import symbolic
from meshforge.common import UsageError, suggest_among
from meshforge.engines.limits import Engine, Finding, check_limit, check_primitives, make_limit


def _read_engines() -> Iterator[Engine]:
    text = files("meshforge.engines").joinpath("engines.toml").read_text("utf-8")
    for name, row in tomllib.loads(text).items():
        limits = tuple(make_limit(**limit) for limit in row.pop("limits"))
        yield Engine(name, limits=limits, primitives=frozenset(row.pop("primitives")), **row)


ENGINES = MappingProxyType({engine.name: engine for engine in _read_engines()})
"""The engines whose limits are known, by the name that the command line takes."""


def find_engine(name: str) -> Engine:
    """Return the engine of a name. Raises UsageError for one that is not known."""
    if name not in ENGINES:
        raise UsageError(f"there is no engine {name!r}", remedy=suggest_among(name, ENGINES, "Known are:"))
    return ENGINES[name]


def note_limits(
    geoms: Iterable[symbolic.Geom], engines: Iterable[str], holds: Collection[symbolic.FeatureKind]
) -> tuple[str, ...]:
    """Return a note on each rule that hulls break of the engines a file is for, with the hulls, the engines and the
    remedy.

    engines: by name; holds: what the format holds: a native shape that it does not counts as the mesh that stands for
    it.
    """
    native = {kind for kind, what in symbolic.PRIMITIVE_FEATURES.items() if what in holds}
    written = [
        geom if geom.shape.kind in {"polytope", *native} else replace(geom, shape=geom.shape.tessellate())
        for geom in geoms
    ]
    found: dict[str, tuple[Finding, list[str]]] = {}
    for engine in map(ENGINES.__getitem__, engines):
        limits = (limit for limit in engine.limits if limit.severity == "error")
        broken = (finding for limit in limits if (finding := check_limit(engine, limit, written)))
        for finding in (*broken, *check_primitives(engine, written)):
            found.setdefault(finding.message, (finding, []))[1].append(engine.title)
    return tuple(f"{' and '.join(titles)}: {one.message}. {one.remedy}" for one, titles in found.values())
