"""Files that another tool made of an asset: segmented points and meshes, and what a dataset says of links."""

from meshforge.formats.segmented.classes import read_classes
from meshforge.formats.segmented.own_mesh import of_own_mesh
from meshforge.formats.segmented.partnet import SEMANTICS, Semantic, read_semantics
from meshforge.formats.segmented.places import POINTS_SUFFIXES, is_segmented, points_beside
from meshforge.formats.segmented.read import read_segmented
from meshforge.formats.segmented.segmented import Segmented

__all__ = [
    "POINTS_SUFFIXES",
    "SEMANTICS",
    "Segmented",
    "Semantic",
    "is_segmented",
    "of_own_mesh",
    "points_beside",
    "read_classes",
    "read_segmented",
    "read_semantics",
]
