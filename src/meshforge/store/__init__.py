"""The project folder on disk: its layout, its settings, every file of it read and written, and the lock. It knows no
use case."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.store.feedback import (
        AnswerLine,
        AnswersFile,
        ConfirmationLine,
        LabelBefore,
        RepairLine,
        Review,
        RuleSelection,
        Verdict,
        repair_id,
    )
    from meshforge.store.layout import JsonFile, json_text, read_json, write_json
    from meshforge.store.meshes import AssetFacts, AssetFiles, geometry_digest, hull_digests, iterate_survey, survey
    from meshforge.store.outputs import AssetOutput, find_outputs
    from meshforge.store.preparation_plan import PreparationPlanFile
    from meshforge.store.program import (
        CorrectionsFile,
        DemonstrationFile,
        ProgramRecord,
        StepLine,
        action_text,
        action_text_without_each,
        parse_action_text,
    )
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
    from meshforge.store.sign_off import (
        SAID,
        AssessmentFile,
        ConfidenceLine,
        SignOff,
        SignOffBasis,
        SignOffFile,
        find_changes,
    )
    from meshforge.store.spans import MOST_TOLD, SpanLine, SpanPart, SpansFile, SplitHull, describe_parts
    from meshforge.store.store import Store
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "MOST_TOLD",
    "SAID",
    "AnswerLine",
    "AnswersFile",
    "AssessmentFile",
    "AssetFacts",
    "AssetFiles",
    "AssetOutput",
    "ConfidenceLine",
    "ConfirmationLine",
    "CorrectionsFile",
    "DemonstrationFile",
    "JsonFile",
    "LabelBefore",
    "PreparationPlanFile",
    "ProgramRecord",
    "RepairLine",
    "Review",
    "RuleSelection",
    "Settings",
    "SignOff",
    "SignOffBasis",
    "SignOffFile",
    "SpanLine",
    "SpanPart",
    "SpansFile",
    "SplitHull",
    "StepLine",
    "Store",
    "Verdict",
    "VlmSettings",
    "action_text",
    "action_text_without_each",
    "add_assets",
    "create_folder",
    "describe_parts",
    "edit_settings",
    "find_assets",
    "find_changes",
    "find_outputs",
    "geometry_digest",
    "hull_digests",
    "iterate_survey",
    "json_text",
    "orientation",
    "orientation_text",
    "parse_action_text",
    "read_json",
    "repair_id",
    "set_value",
    "survey",
    "toml_value",
    "write_json",
]
