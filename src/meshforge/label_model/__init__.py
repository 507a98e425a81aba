"""What is believed about labels: by their source, by hulls that look alike, by hulls that touch."""

from meshforge.label_model.odds import LabelBeliefs, LabelOdds, is_human
from meshforge.label_model.posterior import (
    EQUAL,
    NO_LABEL,
    ColumnScale,
    FamilyTable,
    first_greatest,
    greatest_first,
    pick_evenly,
    reference_label,
    refine_by_neighbors,
    share_ranks,
    vote_by_similarity,
)

__all__ = [
    "EQUAL",
    "NO_LABEL",
    "ColumnScale",
    "FamilyTable",
    "LabelBeliefs",
    "LabelOdds",
    "first_greatest",
    "greatest_first",
    "is_human",
    "pick_evenly",
    "reference_label",
    "refine_by_neighbors",
    "share_ranks",
    "vote_by_similarity",
]
