"""Pictures for naming the parts of a mesh: views in which each hull is seen and numbered."""

from meshforge.views.labelling.shot import Shot
from meshforge.views.labelling.shots import numbers, shots

__all__ = ["Shot", "numbers", "shots"]
