"""How probable it is that each edit of a family is right, why it may not be, and what to ask a person next."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.signoff.alarms import describe_odd_results
    from meshforge.signoff.assessment import BAR, Assessment, AssetConfidence, Doubt, DoubtKind
    from meshforge.signoff.measures import EditMeasures, measure_edit
    from meshforge.signoff.question import (
        HullPlace,
        ReviewChoice,
        ReviewQuestion,
        ReviewReply,
        ReviewState,
    )
    from meshforge.signoff.reply import apply_reply, list_answers
    from meshforge.signoff.review import assess_asset, review_family
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "BAR",
    "Assessment",
    "AssetConfidence",
    "Doubt",
    "DoubtKind",
    "EditMeasures",
    "HullPlace",
    "ReviewChoice",
    "ReviewQuestion",
    "ReviewReply",
    "ReviewState",
    "apply_reply",
    "assess_asset",
    "describe_odd_results",
    "list_answers",
    "measure_edit",
    "review_family",
]
