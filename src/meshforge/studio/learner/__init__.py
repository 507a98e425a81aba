"""A process that keeps the family in memory and learns from it."""

from meshforge.studio.learner.learner import Learner
from meshforge.studio.learner.line import Superseded

__all__ = ["Learner", "Superseded"]
