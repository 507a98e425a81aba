"""What is done with a project folder: demonstrate, learn, ask, review, apply, and how far everything is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.project.learn import (
        ProgramState,
        program_by_hand,
        sees_whole_family,
        select_assets,
        suggest_first_demonstration,
    )
    from meshforge.project.new_asset_result import NewAssetResult, assess_new_assets, describe_new
    from meshforge.project.new_assets import NewAsset, NewAssetOptions, list_new, prepare_aside
    from meshforge.project.preparation_plan import SPLIT_DEFAULTS, SplitSettings, forget_plan, read_preparation_plan
    from meshforge.project.prepare import PreparationResult
    from meshforge.project.project import Project
    from meshforge.project.replies import has_agreed_labels
    from meshforge.project.review import FamilyAssessment, ProjectReview, assess_family
    from meshforge.project.run import make_correction, output_digest, run_with_corrections
    from meshforge.project.run_report import add_standings, build_run_report, summarize_outputs
    from meshforge.project.sign_off_text import format_review, format_standing, format_status
    from meshforge.project.sign_offs import AssessmentBasis, digest_lesson
    from meshforge.project.span_questions import can_ask_about_spans, list_span_questions
    from meshforge.project.span_search import MADE_ANEW
    from meshforge.project.span_splits import LIKELY, Split
    from meshforge.project.status import AssetStatus, Status
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "LIKELY",
    "MADE_ANEW",
    "SPLIT_DEFAULTS",
    "AssessmentBasis",
    "AssetStatus",
    "FamilyAssessment",
    "NewAsset",
    "NewAssetOptions",
    "NewAssetResult",
    "PreparationResult",
    "ProgramState",
    "Project",
    "ProjectReview",
    "Split",
    "SplitSettings",
    "Status",
    "add_standings",
    "assess_family",
    "assess_new_assets",
    "build_run_report",
    "can_ask_about_spans",
    "describe_new",
    "digest_lesson",
    "forget_plan",
    "format_review",
    "format_standing",
    "format_status",
    "has_agreed_labels",
    "list_new",
    "list_span_questions",
    "make_correction",
    "output_digest",
    "prepare_aside",
    "program_by_hand",
    "read_preparation_plan",
    "run_with_corrections",
    "sees_whole_family",
    "select_assets",
    "suggest_first_demonstration",
    "summarize_outputs",
]
