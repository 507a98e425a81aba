"""The project folder: labels, demonstrations, the learned program, its outputs, and how far everything is."""

from meshforge.project.accepting import Standing
from meshforge.project.advice import Advice
from meshforge.project.answers_file import AnswerLine, AnswersFile, ConfirmedLine, RepairLine
from meshforge.project.beginning import first_to_show
from meshforge.project.family import Family, looked_at
from meshforge.project.labels.from_files.points import Reading
from meshforge.project.labels.from_files.reading import Filing
from meshforge.project.labels.labelling import Labelled
from meshforge.project.labels.offering import Offered, Offers
from meshforge.project.labels.propagation.propagating import Carried
from meshforge.project.labels.proposing import Proposal, Proposals
from meshforge.project.labels.tallying import SURE, Share, Tally
from meshforge.project.labels.vlm.forecast import VlmForecast
from meshforge.project.labels.vlm.labelling import VlmLabelled
from meshforge.project.labels.vlm.settings import VlmSettings
from meshforge.project.layout import Layout
from meshforge.project.preparing import Prepared
from meshforge.project.project import Project
from meshforge.project.reviewing import Review, Verdict
from meshforge.project.settings import Settings
from meshforge.project.status import AssetStatus, Status
from meshforge.project.steps import action_text, parse_action_text
from meshforge.project.survey import geometry_digest

__all__ = [
    "SURE",
    "Advice",
    "AnswerLine",
    "AnswersFile",
    "AssetStatus",
    "Carried",
    "ConfirmedLine",
    "Family",
    "Filing",
    "Labelled",
    "Layout",
    "Offered",
    "Offers",
    "Prepared",
    "Project",
    "Proposal",
    "Proposals",
    "Reading",
    "RepairLine",
    "Review",
    "Settings",
    "Share",
    "Standing",
    "Status",
    "Tally",
    "Verdict",
    "VlmForecast",
    "VlmLabelled",
    "VlmSettings",
    "action_text",
    "first_to_show",
    "geometry_digest",
    "looked_at",
    "parse_action_text",
]
