"""How probable it is that each edit of a family is right, why it may not be, and what to ask a person next."""

from meshforge.signoff.alarms import Alarm, AlarmKind, find_alarms
from meshforge.signoff.assessment import BAR, Assessment, AssetConfidence, Doubt, DoubtKind
from meshforge.signoff.measures import EditMeasures, measure_edit
from meshforge.signoff.question import HullPlace, QuestionKind, Reply, ReviewChoice, ReviewQuestion, ReviewState
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
    "Reply",
    "ReviewChoice",
    "ReviewQuestion",
    "ReviewState",
    "apply_reply",
    "find_alarms",
    "list_answers",
    "measure_edit",
    "review_family",
]
