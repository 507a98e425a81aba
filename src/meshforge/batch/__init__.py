"""Work on many assets: which they are, preparations, programs and checks run in worker processes, outcomes, outputs
in place, and the report."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "ask_engines": "ENGINES_TO_ASK",
        "baseline": "Baseline",
        "check": "CheckOutcome CheckTask check_asset check_assets examine_file",
        "manual_edits": (
            "ManualEdit RuleSelection action_text action_text_without_each replay_manual_edits selections_of"
        ),
        "discovery": "ADDED OWN_FOLDERS SETTINGS STATE AssetSet asset_id expand find_assets_in",
        "edit": "apply",
        "execution": "execute",
        "goals": "GOAL_EXECUTION AssetGoals GoalTask recall_goals try_goals",
        "jobs": (
            "APPLY_DEFAULTS ApplyOptions ApplyTask AssetJob inputs_of load_templates make_jobs "
            "describe_jobs template_folders"
        ),
        "lock": "hold_lock",
        "outcome": (
            "MOST_SHOWN AssetOutcome Failed NeedsReview RuleEffect RunSummary Skipped describe_alarms to_json_line"
        ),
        "preparation.cut": "HullParts cut_hull replace_hulls",
        "preparation.decompose": "Concave DecompositionResult decompose_asset replace_concave",
        "preparation.record": "Preparation Replacement apply_preparation find_sources find_surfaces replay_preparation",
        "preparation.storage": (
            "RECORD_FILE list_preparation_writes read_preparation read_prepared read_steps record_digest "
            "write_preparation"
        ),
        "provenance": (
            "OutputInputs Stamp asset_digests content_digest has_same_files program_digest read_stamp "
            "software_version source_files stamp_path template_digests text_digest value_digest"
        ),
        "report.build_files": "CheckCase list_check_cases list_goal_cases make_edit_case write_build_files",
        "report.contents": "MeshReader ReportAsset RunFigures read_job",
        "report.outcomes": "choose_outcomes compare_outcomes",
        "report.page": "ReportHeader ReportOptions write_report",
        "workers": (
            "EXECUTION_DEFAULTS IN_PROCESS TIMEOUT ExecutionOptions WorkerFailure count_processors "
            "raise_if_stopped run_isolated"
        ),
    },
)
