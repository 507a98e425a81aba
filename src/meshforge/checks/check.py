"""All checks of a mesh by itself, in a fixed order."""

from __future__ import annotations

from meshforge.checks.engines import ENGINES, Engine, limits_of
from meshforge.checks.finding import Finding
from meshforge.checks.legality import legality
from meshforge.errors import UsageError, nearest
from meshforge.symbolic import SymbolicMesh


def check(mesh: SymbolicMesh, engine: str | None = None) -> tuple[Finding, ...]:
    """What is not legal in a mesh, and with an engine, what is beyond its limits; empty where all is well.

    Raises UsageError for an engine that is not known.
    """
    known = None if engine is None else engine_named(engine)
    faulty, findings = legality(mesh)
    return findings if known is None else (*findings, *limits_of(known, mesh, faulty))


def engine_named(name: str) -> Engine:
    """The engine of a name. Raises UsageError for one that is not known."""
    if name not in ENGINES:
        like = nearest(name, ENGINES)
        hint = f"Did you mean {like!r}? " if like else ""
        raise UsageError(f"there is no engine {name!r}", remedy=f"{hint}Known are: {', '.join(ENGINES)}.")
    return ENGINES[name]
