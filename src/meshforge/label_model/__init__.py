"""The one model of what labels are: all that is said of a family weighed into a probability for each hull and label."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "asset_pieces": "AssetPieces SurfacePieces piece_mesh",
        "consensus": "EVIDENCE",
        "describe": "MeshDescriber ShapeDescriptor remember_descriptor",
        "odds": "LabelBeliefs LabelOdds is_human",
        "posterior": "MOST_LIKELY FamilyModel FamilyPosterior model_family to_confidence",
        "sides": "correct_upright find_doubtful_sides",
        "similar": "choose_exemplars find_similar",
        "spans": "RebuiltHull SpanModel SpanPosterior",
        "table": "FamilyTable Observations evidence_beside_rebuilt evidence_of read_weights reference_label",
    },
)
