"""The project folder on disk: its layout, its settings, every file of it read and written, and the lock. It knows no
use case."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.store.event_log import load_events
    from meshforge.store.events import (
        NO_ORIGIN,
        AnswerEvent,
        Event,
        ExclusionEvent,
        LabelBefore,
        LabelFixEvent,
        LabelsEvent,
        Origin,
        ReplyEvent,
        SnoozeEvent,
        Verdict,
        VerdictEvent,
        WithdrawalEvent,
        format_lines,
    )
    from meshforge.store.feedback import Feedback
    from meshforge.store.layout import JsonFile, json_text, read_json, write_json
    from meshforge.store.mesh_cache import MeshCache
    from meshforge.store.meshes import AssetFacts, AssetFiles, geometry_digest, hull_digests, iterate_survey
    from meshforge.store.outputs import AssetOutput, find_outputs
    from meshforge.store.preparation_plan import PreparationPlanFile
    from meshforge.store.program import CorrectionsFile, DemonstrationFile, ProgramRecord, StepLine, parse_action_text
    from meshforge.store.settings import (
        Settings,
        VlmSettings,
        add_assets,
        create_folder,
        edit_settings,
        find_assets,
        orientation,
        orientation_text,
        set_value,
        toml_value,
    )
    from meshforge.store.sign_off import SAID, AssessmentFile, ConfidenceLine, SignOff, SignOffBasis, find_changes
    from meshforge.store.spans import MOST_TOLD, SpanLine, SpanPart, SpansFile, describe_parts
    from meshforge.store.store import Store
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "MOST_TOLD",
    "NO_ORIGIN",
    "SAID",
    "AnswerEvent",
    "AssessmentFile",
    "AssetFacts",
    "AssetFiles",
    "AssetOutput",
    "ConfidenceLine",
    "CorrectionsFile",
    "DemonstrationFile",
    "Event",
    "ExclusionEvent",
    "Feedback",
    "JsonFile",
    "LabelBefore",
    "LabelFixEvent",
    "LabelsEvent",
    "MeshCache",
    "Origin",
    "PreparationPlanFile",
    "ProgramRecord",
    "ReplyEvent",
    "Settings",
    "SignOff",
    "SignOffBasis",
    "SnoozeEvent",
    "SpanLine",
    "SpanPart",
    "SpansFile",
    "StepLine",
    "Store",
    "Verdict",
    "VerdictEvent",
    "VlmSettings",
    "WithdrawalEvent",
    "add_assets",
    "create_folder",
    "describe_parts",
    "edit_settings",
    "find_assets",
    "find_changes",
    "find_outputs",
    "format_lines",
    "geometry_digest",
    "hull_digests",
    "iterate_survey",
    "json_text",
    "load_events",
    "orientation",
    "orientation_text",
    "parse_action_text",
    "read_json",
    "set_value",
    "toml_value",
    "write_json",
]
