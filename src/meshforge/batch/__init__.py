"""Work on many assets: which they are, preparations, programs and checks run in worker processes, outcomes, outputs
in place, and the report."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.batch.archive import write_archive
    from meshforge.batch.check import CheckJournal, CheckOutcome, CheckTask, check_asset, check_assets, open_journal
    from meshforge.batch.corrections import Correction, replay_corrections
    from meshforge.batch.discovery import (
        ADDED,
        OWN_FOLDERS,
        SETTINGS,
        STATE,
        AssetSet,
        asset_id,
        expand,
        find_assets_in,
    )
    from meshforge.batch.edit import apply
    from meshforge.batch.engine_trial import ENGINES_TO_ASK, examine_file
    from meshforge.batch.execution import execute
    from meshforge.batch.inputs import inputs_of
    from meshforge.batch.jobs import (
        APPLY_DEFAULTS,
        ApplyOptions,
        ApplyTask,
        AssetJob,
        load_named_templates,
        load_templates,
        make_jobs,
        plan_run,
        read_template,
        template_folders,
    )
    from meshforge.batch.lock import hold_lock
    from meshforge.batch.outcome import (
        MOST_SHOWN,
        AssetOutcome,
        Failed,
        Held,
        RuleEffect,
        RunSummary,
        Skipped,
        describe_alarms,
        status_of,
        to_json_line,
    )
    from meshforge.batch.preparation.decompose import DecompositionResult, decompose_asset
    from meshforge.batch.preparation.fine import find_surfaces
    from meshforge.batch.preparation.record import (
        Preparation,
        Replacement,
        apply_preparation,
        find_sources,
        replay_preparation,
    )
    from meshforge.batch.preparation.split import HullDivision, cut_hull, divide_hulls, split_hull
    from meshforge.batch.preparation.storage import (
        RECORD_FILE,
        read_preparation,
        read_prepared,
        record_digest,
        remove_preparation,
        write_preparation,
    )
    from meshforge.batch.provenance import (
        OutputInputs,
        Stamp,
        asset_digests,
        file_digest,
        has_same_files,
        program_digest,
        read_stamp,
        software_version,
        source_files,
        stamp_path,
        template_digests,
        text_digest,
    )
    from meshforge.batch.report.contents import (
        READ_TIMEOUT,
        AssetStanding,
        EarlierExamination,
        LabelStatus,
        MeshReader,
        ReportAsset,
        ReportStatus,
        RunFigures,
        StandingWord,
        TopItems,
        read_again,
        read_job,
    )
    from meshforge.batch.report.outcomes import choose_outcomes, compare_outcomes
    from meshforge.batch.report.page import MOST_PICTURED, REPORT_DEFAULTS, ReportHeader, ReportOptions, write_report
    from meshforge.batch.workers import (
        EXECUTION_DEFAULTS,
        IN_PROCESS,
        TIMEOUT,
        ExecutionOptions,
        WorkerFailure,
        count_processors,
        memory_share,
        raise_if_stopped,
        run_isolated,
        server_context,
        worker_context,
    )
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "ADDED",
    "APPLY_DEFAULTS",
    "ENGINES_TO_ASK",
    "EXECUTION_DEFAULTS",
    "IN_PROCESS",
    "MOST_PICTURED",
    "MOST_SHOWN",
    "OWN_FOLDERS",
    "READ_TIMEOUT",
    "RECORD_FILE",
    "REPORT_DEFAULTS",
    "SETTINGS",
    "STATE",
    "TIMEOUT",
    "ApplyOptions",
    "ApplyTask",
    "AssetJob",
    "AssetOutcome",
    "AssetSet",
    "AssetStanding",
    "CheckJournal",
    "CheckOutcome",
    "CheckTask",
    "Correction",
    "DecompositionResult",
    "EarlierExamination",
    "ExecutionOptions",
    "Failed",
    "Held",
    "HullDivision",
    "LabelStatus",
    "MeshReader",
    "OutputInputs",
    "Preparation",
    "Replacement",
    "ReportAsset",
    "ReportHeader",
    "ReportOptions",
    "ReportStatus",
    "RuleEffect",
    "RunFigures",
    "RunSummary",
    "Skipped",
    "Stamp",
    "StandingWord",
    "TopItems",
    "WorkerFailure",
    "apply",
    "apply_preparation",
    "asset_digests",
    "asset_id",
    "check_asset",
    "check_assets",
    "choose_outcomes",
    "compare_outcomes",
    "count_processors",
    "cut_hull",
    "decompose_asset",
    "describe_alarms",
    "divide_hulls",
    "examine_file",
    "execute",
    "expand",
    "file_digest",
    "find_assets_in",
    "find_sources",
    "find_surfaces",
    "has_same_files",
    "hold_lock",
    "inputs_of",
    "load_named_templates",
    "load_templates",
    "make_jobs",
    "memory_share",
    "open_journal",
    "plan_run",
    "program_digest",
    "raise_if_stopped",
    "read_again",
    "read_job",
    "read_preparation",
    "read_prepared",
    "read_stamp",
    "read_template",
    "record_digest",
    "remove_preparation",
    "replay_corrections",
    "replay_preparation",
    "run_isolated",
    "server_context",
    "software_version",
    "source_files",
    "split_hull",
    "stamp_path",
    "status_of",
    "template_digests",
    "template_folders",
    "text_digest",
    "to_json_line",
    "worker_context",
    "write_archive",
    "write_preparation",
    "write_report",
]
