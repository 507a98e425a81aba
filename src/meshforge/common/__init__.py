"""What every package needs and what knows nothing of meshes: errors, atomic files, words for messages."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "files": (
            "DISK_ERRORS FileState FileStates confine_reads do_at_once expand_glob file_digest file_state "
            "file_states find_drafts is_beyond_reach is_file is_link_cycle plain_path quote_path relative_name "
            "replace_atomically write_all_atomically write_atomically"
        ),
        "messages": (
            "AssetError CollisionLossError DemonstrationError GeometryError HullNotFoundError MeshForgeError "
            "MissingFilesError PluginError ProgramError ProjectError StoppedError UsageError describe_error "
            "escape_name escape_text explain_refusal format_share is_text join_and join_names nearest_name pluralize "
            "suggest_among "
            "suggest_match suggest_name to_text"
        ),
        "plugins": (
            "PLUGIN_KINDS Plugin PluginKind Registry adopt_plugins blame collect_plugins find_plugins import_extra "
            "require_mujoco"
        ),
        "validation": "describe_invalid_field first_validation_error",
    },
)
