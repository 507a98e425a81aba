"""Labels of one to five assets carried to all others of a family, offline, each with its chance."""

from meshforge.perception.propagation.family import Family, family_of
from meshforge.perception.propagation.metric import weights
from meshforge.perception.propagation.propagate import Propagated, Relatives, compared_hulls, given_label, propagate
from meshforge.perception.propagation.righting import doubtful_sides, righted
from meshforge.perception.propagation.sketch import Sketch, Sketcher
from meshforge.perception.propagation.sketch_file import read_arrays, write_arrays

__all__ = [
    "Family",
    "Propagated",
    "Relatives",
    "Sketch",
    "Sketcher",
    "compared_hulls",
    "doubtful_sides",
    "family_of",
    "given_label",
    "propagate",
    "read_arrays",
    "righted",
    "weights",
    "write_arrays",
]
