"""Notes on hulls that are written for engines which would refuse them, or have no such shape: by the tables alone."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

from meshforge.checks.engines import ENGINES
from meshforge.checks.legality import Finding
from meshforge.checks.limits import Engine, check_limit, check_primitives
from meshforge.geometry import Polytope
from meshforge.symbolic import PRIMITIVE_FEATURES, FeatureKind, Hull

ENGINES_OF_FORMATS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "mjcf": ("mujoco",),
        "urdf": ("mujoco", "bullet"),
        "sdf": ("bullet",),
        "usd": ("physx-cpu", "physx-gpu"),
    }
)
"""The engines that read a format themselves; a file whose names are those of an engine is for that one."""
_SAID_ON_SAVING = ("unity",)  # by the names themselves, so in Python too


def note_limits(
    hulls: Sequence[Hull], form: str, holds: Collection[FeatureKind], names: str | None = None
) -> tuple[str, ...]:
    """A note on each rule that hulls break of the engines a file is for, with the hulls, the engines and the remedy.

    form: the name of the format; holds: what it holds: a native shape that it does not counts as the mesh that stands
    for it; names: how it marks collision, which may be for one
    engine.
    """
    known = (names,) if names and names in ENGINES else ENGINES_OF_FORMATS.get(form, ())
    engines = [ENGINES[name] for name in known if name not in _SAID_ON_SAVING]
    native = {kind for kind, what in PRIMITIVE_FEATURES.items() if what in holds}
    written = [_as_written(hull, native) for hull in hulls] if engines else []
    found: dict[str, tuple[Finding, list[str]]] = {}
    for engine in engines:
        for finding in _find_broken_rules(engine, written):
            found.setdefault(finding.message, (finding, []))[1].append(engine.title)
    return tuple(f"{' and '.join(titles)}: {one.message}. {one.remedy}" for one, titles in found.values())


def _as_written(hull: Hull, native: Collection[str]) -> Hull:
    shape = hull.shape
    return hull if isinstance(shape, Polytope) or shape.kind in native else replace(hull, shape=shape.tessellate())


def _find_broken_rules(engine: Engine, hulls: list[Hull]) -> list[Finding]:
    """What the engine refuses or changes, and native shapes that it lacks."""
    limits = (limit for limit in engine.limits if limit.severity == "error")
    broken = [finding for limit in limits if (finding := check_limit(engine, limit, hulls))]
    return [*broken, *check_primitives(engine, hulls)]
