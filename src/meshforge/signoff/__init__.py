"""How probable it is that each edit of a family is right, why it may not be, and what to ask a person next."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "assessment": (
            "THRESHOLD Assessment GoalStatus Reason ReasonKind ReviewState ResultStatus ResultState ResultStatusWord"
        ),
        "outliers": "EditMeasures describe_outliers measure_edit",
        "question": "ExclusionReason HullPlace ReviewChoice ReviewQuestion ReviewReply question_of",
        "review": "assess_asset review_family",
    },
)
