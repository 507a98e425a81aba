"""What is done with a project folder: demonstrate, learn, ask, review, apply, and how far everything is."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "goals": "try_goals_as_shown",
        "learn": (
            "ProgramState learn_program program_by_hand sees_whole_family select_assets suggest_first_demonstration"
        ),
        "new_asset_result": "NewAssetResult assess_new_assets describe_new",
        "new_assets": "NewAsset NewAssetOptions list_new prepare_new_assets",
        "overview": "compute_status find_offers",
        "preparation_plan": (
            "REBUILD_DEFAULTS DecompositionPlan RebuildSettings forget_plan keep_rebuilt read_piece_engine "
            "read_preparation_plan"
        ),
        "prepare": "PreparationResult",
        "project": "Project create_tour_project",
        "rebuild": "MADE_ANEW",
        "rename": "list_renamed_files",
        "replies": "has_agreed_labels",
        "review": "FamilyAssessment ProjectReview assess_family",
        "run": "make_manual_edit output_digest run_with_manual_edits",
        "run_report": "add_result_status build_run_report format_review format_status summarize_outputs",
        "sign_offs": "AssessmentBasis digest_inputs",
        "family_step": "choose_next_step",
        "status": (
            "GIVEN NO_LABEL SOURCE_WORDS AssetStatus FamilyState LastRun LearnStatus NextStep OpenQuestion OutputState "
            "PropagationState Status StepKind format_next format_step"
        ),
    },
)
