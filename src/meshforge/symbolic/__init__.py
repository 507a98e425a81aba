"""The collision mesh as the language sees it: labelled hulls, AABBs and the contact graph."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.symbolic.asset import (
        Asset,
        Body,
        Coupling,
        Document,
        FileNote,
        Geom,
        Inertial,
        Joint,
        JointKind,
        Mechanism,
        Mentions,
        NameProblem,
        Opaque,
        Rgba,
        Surface,
        Texture,
        unique_names,
        unit_vector,
    )
    from meshforge.symbolic.descriptor import DESCRIPTOR_NAMES, descriptors
    from meshforge.symbolic.features import PRIMITIVE_FEATURES, Feature, FeatureKind, features_of
    from meshforge.symbolic.hull import (
        GIVEN_SOURCES,
        HUMAN_SOURCES,
        INFERRED_SOURCES,
        LABEL_SOURCES,
        Hull,
        Label,
        LabelSource,
    )
    from meshforge.symbolic.label_file import (
        LabelFile,
        LabelTransfer,
        format_labels,
        match_labels,
        parse_labels_text,
        read_labels,
        transfer_labels,
        write_labels,
    )
    from meshforge.symbolic.mesh import (
        EPSILON,
        NEAR_MISS,
        SymbolicMesh,
        bits_of,
        mask_of,
        split_by_body,
        split_by_contact,
    )
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "DESCRIPTOR_NAMES",
    "EPSILON",
    "GIVEN_SOURCES",
    "HUMAN_SOURCES",
    "INFERRED_SOURCES",
    "LABEL_SOURCES",
    "NEAR_MISS",
    "PRIMITIVE_FEATURES",
    "Asset",
    "Body",
    "Coupling",
    "Document",
    "Feature",
    "FeatureKind",
    "FileNote",
    "Geom",
    "Hull",
    "Inertial",
    "Joint",
    "JointKind",
    "Label",
    "LabelFile",
    "LabelSource",
    "LabelTransfer",
    "Mechanism",
    "Mentions",
    "NameProblem",
    "Opaque",
    "Rgba",
    "Surface",
    "SymbolicMesh",
    "Texture",
    "bits_of",
    "descriptors",
    "features_of",
    "format_labels",
    "mask_of",
    "match_labels",
    "parse_labels_text",
    "read_labels",
    "split_by_body",
    "split_by_contact",
    "transfer_labels",
    "unique_names",
    "unit_vector",
    "write_labels",
]
