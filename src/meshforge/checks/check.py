"""All checks of a mesh, in a fixed order."""

from __future__ import annotations

from meshforge.checks.finding import Finding
from meshforge.checks.legality import legality
from meshforge.checks.limits import ENGINES, limits_of
from meshforge.errors import UsageError, nearest
from meshforge.symbolic import SymbolicMesh


def check(mesh: SymbolicMesh, engine: str | None = None) -> tuple[Finding, ...]:
    """What is not legal in a mesh, and with an engine, what is beyond its limits; empty where all is well.

    Raises UsageError for an engine that is not known.
    """
    if engine is not None and engine not in ENGINES:
        like = nearest(engine, ENGINES)
        hint = f"Did you mean {like!r}? " if like else ""
        raise UsageError(f"there is no engine {engine!r}", remedy=f"{hint}Known are: {', '.join(ENGINES)}.")
    faulty, findings = legality(mesh)
    return findings if engine is None else (*findings, *limits_of(engine, mesh, faulty))
