"""Whether hulls are legal, within the limits of an engine, fit, leave free what is free, and rest; and fixes."""

from meshforge.checks.fix import FixResult, fix
from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "base": "VALIDATORS Check EngineLoad CheckFindings CheckSubject Measure",
        "clearance": "OF_EDIT Clearance measure_kept_space",
        "examination": "CHECKS MEASURES CheckOptions Examination check draw_examination examine_mesh",
        "fit": "MeshFit",
        "goals.base": "Goal GoalSubject NotApplicableError",
        "physics.pairs": "PairProposals exclude_pairs",
        "physics.scene": "Failure",
        "physics.simulation": "BEFORE Physics",
        "physics.speed": "Speed",
        "meshforge.engines": "Finding Severity",
    },
)
__all__ += ["FixResult", "fix"]
