"""What must be true of an edited mesh, tried as `meshforge goal` tries it where it is physical."""

from benchmark.criteria.case import Case
from benchmark.criteria.verdict import CRITERIA, judge

__all__ = ["CRITERIA", "Case", "judge"]
