"""Whether hulls are legal, within the limits of an engine, fit, leave free what is free, and rest; and mending."""

from meshforge.checks.check import check, engine_named
from meshforge.checks.engines import ENGINES
from meshforge.checks.examination import Examination, Measures, examine_mesh
from meshforge.checks.finding import Finding, Severity
from meshforge.checks.fixing import Fixed, fix
from meshforge.checks.pictures import pictures

__all__ = [
    "ENGINES",
    "Examination",
    "Finding",
    "Fixed",
    "Measures",
    "Severity",
    "check",
    "engine_named",
    "examine_mesh",
    "fix",
    "pictures",
]
