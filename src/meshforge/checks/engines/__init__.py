"""What physics engines allow, with the source of each number, and what of a mesh is beyond it."""

from meshforge.checks.engines.beyond import limits_of
from meshforge.checks.engines.catalogue import ENGINES
from meshforge.checks.engines.limit import Bound, Engine, Limit

__all__ = ["ENGINES", "Bound", "Engine", "Limit", "limits_of"]
