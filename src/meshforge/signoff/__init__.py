"""How probable it is that each edit of a family is right, why it may not be, and what to ask a person next."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.signoff.alarms import describe_odd_results
    from meshforge.signoff.assessment import BAR, Assessment, AssetConfidence, Doubt, DoubtKind
    from meshforge.signoff.measures import EditMeasures, measure_edit
    from meshforge.signoff.question import (
        DemonstrationQuestion,
        ExclusionReason,
        GroupQuestion,
        HullPlace,
        OrientationQuestion,
        ReadingQuestion,
        RepairQuestion,
        ResultQuestion,
        ReviewChoice,
        ReviewQuestion,
        ReviewReply,
        SlipQuestion,
        SpanQuestion,
        question_of,
    )
    from meshforge.signoff.review import assess_asset, review_family
    from meshforge.signoff.state import ReviewState
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "BAR",
    "Assessment",
    "AssetConfidence",
    "DemonstrationQuestion",
    "Doubt",
    "DoubtKind",
    "EditMeasures",
    "ExclusionReason",
    "GroupQuestion",
    "HullPlace",
    "OrientationQuestion",
    "ReadingQuestion",
    "RepairQuestion",
    "ResultQuestion",
    "ReviewChoice",
    "ReviewQuestion",
    "ReviewReply",
    "ReviewState",
    "SlipQuestion",
    "SpanQuestion",
    "assess_asset",
    "describe_odd_results",
    "measure_edit",
    "question_of",
    "review_family",
]
