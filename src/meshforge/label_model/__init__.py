"""The one model of what labels are: all that is said of a family weighed into a probability for each hull and label."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.label_model.asset_pieces import AssetPieces, SurfacePieces, piece_mesh
    from meshforge.label_model.cells import AssetCells, CellModel, cut_into_cells
    from meshforge.label_model.consensus import EVIDENCE
    from meshforge.label_model.describe import MeshDescriber, ShapeDescriptor, remember_descriptor
    from meshforge.label_model.odds import LabelBeliefs, LabelOdds, is_human
    from meshforge.label_model.posterior import FamilyModel, FamilyPosterior, model_family
    from meshforge.label_model.sides import correct_upright, find_doubtful_sides
    from meshforge.label_model.similar import find_similar
    from meshforge.label_model.spans import WHOLE, SpanModel, SpanPosterior
    from meshforge.label_model.table import (
        FamilyTable,
        Observations,
        evidence_beside_splits,
        evidence_of,
        metric_weights,
        reference_label,
    )
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "EVIDENCE",
    "WHOLE",
    "AssetCells",
    "AssetPieces",
    "CellModel",
    "FamilyModel",
    "FamilyPosterior",
    "FamilyTable",
    "LabelBeliefs",
    "LabelOdds",
    "MeshDescriber",
    "Observations",
    "ShapeDescriptor",
    "SpanModel",
    "SpanPosterior",
    "SurfacePieces",
    "correct_upright",
    "cut_into_cells",
    "evidence_beside_splits",
    "evidence_of",
    "find_doubtful_sides",
    "find_similar",
    "is_human",
    "metric_weights",
    "model_family",
    "piece_mesh",
    "reference_label",
    "remember_descriptor",
]
