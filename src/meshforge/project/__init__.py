"""The project folder: labels, demonstrations, the learned program, its outputs, and how far everything is."""

from meshforge.project.accepting import Standing
from meshforge.project.advice import Advice
from meshforge.project.answers_file import AnswerLine, AnswersFile, ConfirmedLine, RepairLine
from meshforge.project.beginning import first_to_show
from meshforge.project.family import Family, looked_at
from meshforge.project.filing import Filing
from meshforge.project.labelling import Labelled
from meshforge.project.layout import Layout
from meshforge.project.offering import Offered, Offers
from meshforge.project.point_labels import Reading
from meshforge.project.preparing import Prepared
from meshforge.project.project import Project
from meshforge.project.propagating import Carried
from meshforge.project.proposing import Proposal, Proposals
from meshforge.project.reviewing import Review, Verdict
from meshforge.project.settings import Settings
from meshforge.project.status import AssetStatus, Status
from meshforge.project.steps import action_text, parse_action_text
from meshforge.project.survey import geometry_digest
from meshforge.project.tallying import SURE, Share, Tally
from meshforge.project.vlm_forecast import VlmForecast
from meshforge.project.vlm_labelling import VlmLabelled
from meshforge.project.vlm_settings import VlmSettings

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
