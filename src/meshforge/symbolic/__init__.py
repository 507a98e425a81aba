"""The collision mesh as the language sees it: labelled hulls, AABBs and the contact graph."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "asset": (
            "Asset Body Coupling Document FileNote Geom Inertial Joint JointKind MISSING_REMEDY Mechanism Mentions "
            "NameProblem NonConvexPiece Rgba Surface Texture unique_names unit_vector"
        ),
        "descriptor": "DESCRIPTOR_NAMES descriptors",
        "features": "PRIMITIVE_FEATURES Feature FeatureKind features_of",
        "hull": (
            "CERTAIN_SOURCES CLASS_SOURCES GIVEN_SOURCES HUMAN_SOURCES INFERRED_SOURCES LABEL_SOURCES NO_PART Hull "
            "Label LabelSource is_class_name name_class refuse_class_names"
        ),
        "label_file": (
            "LabelFile LabelTransfer format_labels match_labels parse_labels_text read_classes read_labels "
            "transfer_labels write_labels"
        ),
        "mesh": (
            "EPSILON NEAR_MISS SymbolicMesh bits_of contact_graph find_unchanged mask_of split_by_body split_by_contact"
        ),
    },
)
