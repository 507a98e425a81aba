"""How probable it is that each edit of a family is right, why it may not be, and what to ask a person next.

Workers measure edits with this package: what else it offers is imported when it is first used, since that needs
learning, half a second of imports.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from meshforge.signoff.alarms import Alarm, AlarmKind, describe_odd_results, find_alarms
from meshforge.signoff.measures import EditMeasures, measure_edit

if TYPE_CHECKING:
    from meshforge.signoff.assessment import BAR, Assessment, AssetConfidence, Doubt, DoubtKind
    from meshforge.signoff.question import (
        HullPlace,
        QuestionKind,
        ReviewChoice,
        ReviewQuestion,
        ReviewReply,
        ReviewState,
    )
    from meshforge.signoff.reply import apply_reply, list_answers
    from meshforge.signoff.review import review_family

__all__ = [
    "BAR",
    "Alarm",
    "AlarmKind",
    "Assessment",
    "AssetConfidence",
    "Doubt",
    "DoubtKind",
    "EditMeasures",
    "HullPlace",
    "QuestionKind",
    "ReviewChoice",
    "ReviewQuestion",
    "ReviewReply",
    "ReviewState",
    "apply_reply",
    "describe_odd_results",
    "find_alarms",
    "list_answers",
    "measure_edit",
    "review_family",
]

_MODULES = {
    "assessment": ("BAR", "Assessment", "AssetConfidence", "Doubt", "DoubtKind"),
    "question": ("HullPlace", "QuestionKind", "ReviewReply", "ReviewChoice", "ReviewQuestion", "ReviewState"),
    "reply": ("apply_reply", "list_answers"),
    "review": ("review_family",),
}
_HOMES = {name: module for module, names in _MODULES.items() for name in names}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'meshforge.signoff' has no attribute {name!r}")
    value = getattr(import_module(f"meshforge.signoff.{_HOMES[name]}"), name)
    globals()[name] = value
    return value
