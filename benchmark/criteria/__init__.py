"""What must be true of an edited mesh, tried by physics in MuJoCo where it is physical; one file a criterion."""

from benchmark.criteria.case import Case
from benchmark.criteria.verdict import CRITERIA, judge

__all__ = ["CRITERIA", "Case", "judge"]
