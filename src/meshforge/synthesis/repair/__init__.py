"""Wrong labels, found out by what was shown: programs with corrections, weighed by how believable both are."""

from meshforge.synthesis.repair.explain import explain
from meshforge.synthesis.repair.explanation import Explanation
from meshforge.synthesis.repair.standing import Labels

__all__ = ["Explanation", "Labels", "explain"]
