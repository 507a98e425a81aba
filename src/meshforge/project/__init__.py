"""The project folder: labels, demonstrations, the learned program, its outputs, and how far everything is."""

from meshforge.project.advice import Advice
from meshforge.project.answers_file import AnswerLine, AnswersFile, ConfirmedLine, RepairLine
from meshforge.project.family import Family, looked_at
from meshforge.project.labelling import Labelled
from meshforge.project.layout import Layout
from meshforge.project.preparing import Prepared
from meshforge.project.project import Project
from meshforge.project.reviewing import Review, Verdict
from meshforge.project.settings import Settings
from meshforge.project.status import AssetStatus, Status

__all__ = [
    "Advice",
    "AnswerLine",
    "AnswersFile",
    "AssetStatus",
    "ConfirmedLine",
    "Family",
    "Labelled",
    "Layout",
    "Prepared",
    "Project",
    "RepairLine",
    "Review",
    "Settings",
    "Status",
    "Verdict",
    "looked_at",
]
