"""Whether hulls are legal, and within the limits of a physics engine."""

from meshforge.checks.check import check
from meshforge.checks.finding import Finding, Severity
from meshforge.checks.limits import ENGINES

__all__ = ["ENGINES", "Finding", "Severity", "check"]
