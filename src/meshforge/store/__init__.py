"""The project folder on disk: its layout, settings, every file read and written, and the lock. It knows no use case."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "events": (
            "NO_ORIGIN AnswerEvent Event ExclusionEvent LabelBefore LabelFixEvent LabelsEvent Origin ReplyEvent "
            "SnoozeEvent Verdict VerdictEvent WithdrawalEvent format_lines"
        ),
        "feedback": "Feedback load_events",
        "history": "FileConflict ConflictError NotHereError History",
        "history_entries": "HistoryEntry",
        "layout": (
            "Effect JsonFile Layout PreparationPlanFile ProjectFile identify_file json_text list_files read_json "
            "write_json"
        ),
        "mesh_cache": "MeshCache",
        "meshes": "AssetFacts AssetFiles geometry_digest hull_digests iterate_asset_index",
        "outputs": "AssetOutput find_outputs",
        "program": "ManualEditsFile DemonstrationFile ProgramRecord StepLine parse_action_text",
        "settings": (
            "Settings Up VlmSettings add_assets change_goal create_folder edit_settings find_assets orientation "
            "orientation_text set_value toml_value"
        ),
        "sign_off": "ANSWERS AssessmentFile ConfidenceLine SignOff SignOffBasis find_changes",
        "store": "Store",
    },
)
