"""The collision mesh as the language sees it: labelled hulls, AABBs and the contact graph."""

from meshforge.symbolic.hull import Hull
from meshforge.symbolic.labels import HUMAN_SOURCES, SOURCES, Label, Source
from meshforge.symbolic.mesh import EPSILON, SymbolicMesh, bits, mask_of

__all__ = ["EPSILON", "HUMAN_SOURCES", "SOURCES", "Hull", "Label", "Source", "SymbolicMesh", "bits", "mask_of"]
