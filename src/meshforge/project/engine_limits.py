"""Limits of engines that the hulls of an asset would exceed after a rebuild, said before anything is written."""

from __future__ import annotations

from collections.abc import Iterator

from meshforge import batch
from meshforge.engines import Finding, check_limits, find_engine
from meshforge.formats import format_of
from meshforge.symbolic import Asset, SymbolicMesh

_OF_BODIES = "-hulls"
_OF_FILES = "-one-hull-a-file"
"""How the rules end that are not about single hulls."""


def describe_limits(
    source: Asset, before: batch.Preparation, after: batch.Preparation, engine: str | None = None
) -> list[str]:
    """A sentence on each limit that the hulls exceed which a preparation makes more than another.

    source: the asset as it was read; engine: its name, None for those that the asset's format is for. Raises UsageError
    for an unknown engine.
    """
    names = format_of(source.path).engines_of(source) if engine is None else (engine,)
    old, new = (SymbolicMesh.of(batch.apply_preparation(source, one)) for one in (before, after))
    titles = dict[str, list[str]]()
    for one in map(find_engine, names):
        for finding in _find_new(one.name, old, new):
            titles.setdefault(f"{finding.message}. {finding.remedy}", []).append(one.title)
    return [f"then, {' and '.join(engines)}: {text}" for text, engines in titles.items()]


def _find_new(engine: str, old: SymbolicMesh, new: SymbolicMesh) -> Iterator[Finding]:
    """What new hulls exceed of an engine, alone, and what their bodies and their file do with them."""
    shapes = {hull.name: hull.shape for hull in old.hulls}
    made = [hull for hull in new.hulls if shapes.get(hull.name) != hull.shape]
    alone = new.with_hulls(made)
    yield from (one for one in check_limits(find_engine(engine), alone, frozenset()) if not _is_whole(one))
    was = {one.rule for one in check_limits(find_engine(engine), old, frozenset())}
    names = {hull.name for hull in made}
    for one in check_limits(find_engine(engine), new, frozenset()):
        if _is_whole(one) and names.intersection(one.hulls) and not (one.rule.endswith(_OF_FILES) and one.rule in was):
            yield one


def _is_whole(finding: Finding) -> bool:
    return finding.rule.endswith((_OF_BODIES, _OF_FILES))
