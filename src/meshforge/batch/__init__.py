"""Programs run over many assets: which assets, in worker processes, with outcomes, resuming and outputs in place."""

from meshforge.batch.apply import apply
from meshforge.batch.assets.digests import (
    asset_digests,
    file_digest,
    program_digest,
    same_files,
    software,
    source_files,
    text_digest,
)
from meshforge.batch.assets.expand import Found, asset_id, common_folder, expand
from meshforge.batch.assets.folder import OWN_FOLDERS, SETTINGS, STATE
from meshforge.batch.assets.job import AssetJob, Task, jobs, labels_for
from meshforge.batch.assets.plan import Plan, plan, size_text
from meshforge.batch.checking.examination import Examined, Wanted, examine, examine_all
from meshforge.batch.checking.journal import Journal, journal
from meshforge.batch.correction import Correction, replay
from meshforge.batch.edit import inputs_of
from meshforge.batch.outcome import Edited, Failed, Outcome, RuleLine, Skipped, Unchanged, json_line, status
from meshforge.batch.outputs.lock import locked
from meshforge.batch.outputs.stamp import Inputs, Stamp, read_stamp
from meshforge.batch.report import (
    PATIENCE,
    Chosen,
    Figures,
    Kept,
    Labelling,
    Reader,
    ReportAsset,
    Status,
    read_again,
    read_job,
    write_report,
)
from meshforge.batch.summary import Summary
from meshforge.batch.templates import load_templates, named_templates, read_template, template_folders
from meshforge.batch.workers.pool import Lost, isolated
from meshforge.batch.workers.spread import HERE, TIMEOUT, Backend, Spread

__all__ = [
    "HERE",
    "OWN_FOLDERS",
    "PATIENCE",
    "SETTINGS",
    "STATE",
    "TIMEOUT",
    "AssetJob",
    "Backend",
    "Chosen",
    "Correction",
    "Edited",
    "Examined",
    "Failed",
    "Figures",
    "Found",
    "Inputs",
    "Journal",
    "Kept",
    "Labelling",
    "Lost",
    "Outcome",
    "Plan",
    "Reader",
    "ReportAsset",
    "RuleLine",
    "Skipped",
    "Spread",
    "Stamp",
    "Status",
    "Summary",
    "Task",
    "Unchanged",
    "Wanted",
    "apply",
    "asset_digests",
    "asset_id",
    "common_folder",
    "examine",
    "examine_all",
    "expand",
    "file_digest",
    "inputs_of",
    "isolated",
    "jobs",
    "journal",
    "json_line",
    "labels_for",
    "load_templates",
    "locked",
    "named_templates",
    "plan",
    "program_digest",
    "read_again",
    "read_job",
    "read_stamp",
    "read_template",
    "replay",
    "same_files",
    "size_text",
    "software",
    "source_files",
    "status",
    "template_folders",
    "text_digest",
    "write_report",
]
