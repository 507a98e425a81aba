"""Physics engines: what each takes of hulls, and what it makes of the rest."""

from meshforge.engines.limits import Engine, Finding, Limit, Severity, check_limits, make_limit
from meshforge.engines.table import ENGINES, find_engine, note_limits

__all__ = [
    "ENGINES",
    "Engine",
    "Finding",
    "Limit",
    "Severity",
    "check_limits",
    "find_engine",
    "make_limit",
    "note_limits",
]
