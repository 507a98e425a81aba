"""The collision mesh as the language sees it: labelled hulls, AABBs and the contact graph."""

from meshforge.symbolic.components import bodies, components
from meshforge.symbolic.descriptor import DESCRIBED, descriptors
from meshforge.symbolic.follow import Followed, Homes, follow_labels, label_homes
from meshforge.symbolic.hull import Hull
from meshforge.symbolic.label_file import LabelFile, labels_text, read_labels, write_labels
from meshforge.symbolic.labels import GIVEN_SOURCES, HUMAN_SOURCES, SOURCES, Label, Source
from meshforge.symbolic.mesh import EPSILON, SymbolicMesh, bits, mask_of

__all__ = [
    "DESCRIBED",
    "EPSILON",
    "GIVEN_SOURCES",
    "HUMAN_SOURCES",
    "SOURCES",
    "Followed",
    "Homes",
    "Hull",
    "Label",
    "LabelFile",
    "Source",
    "SymbolicMesh",
    "bits",
    "bodies",
    "components",
    "descriptors",
    "follow_labels",
    "label_homes",
    "labels_text",
    "mask_of",
    "read_labels",
    "write_labels",
]
