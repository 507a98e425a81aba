"""Whether hulls are legal, within the limits of an engine, fit, leave free what is free, and rest; and fixes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.checks.fix import FixResult, fix
from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.checks.clearance import measure_kept_space
    from meshforge.checks.engine_trial import EngineTrial
    from meshforge.checks.examination import CheckOptions, Examination, check, draw_examination, examine_mesh
    from meshforge.checks.registry import CHECKS, Check
    from meshforge.engines import Finding, Severity
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "CHECKS",
    "Check",
    "CheckOptions",
    "EngineTrial",
    "Examination",
    "Finding",
    "FixResult",
    "Severity",
    "check",
    "draw_examination",
    "examine_mesh",
    "fix",
    "measure_kept_space",
]
