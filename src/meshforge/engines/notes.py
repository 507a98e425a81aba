"""Notes on hulls that are written for engines which would refuse them, or have no such shape: by the tables alone."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import replace

from meshforge import symbolic
from meshforge.engines.limits import Finding, check_limit, check_primitives
from meshforge.engines.table import ENGINES


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
