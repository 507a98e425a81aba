"""Whether hulls are legal, and within the limits of a physics engine; and what of it can be mended safely."""

from meshforge.checks.check import check, engine_named
from meshforge.checks.engines import ENGINES
from meshforge.checks.finding import Finding, Severity
from meshforge.checks.fixing import Fixed, fix

__all__ = ["ENGINES", "Finding", "Fixed", "Severity", "check", "engine_named", "fix"]
