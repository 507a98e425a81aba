"""The page about assets that were converted: each as it was read and as it was written."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from meshforge.batch import AssetJob, Summary


def write_convert_report(
    path: Path, out: Path, suffix: str, jobs: Sequence[AssetJob], summary: Summary, seconds: float
) -> None:
    """Write it; out: the folder, and suffix the format, that all were written in."""
    from meshforge.batch import Figures, read_job
    from meshforge.cli.compared import compared
    from meshforge.cli.report import report
    from meshforge.language import Program

    known = {job.id: job for job in jobs}
    readers = [partial(read_job, known[outcome.asset]) for outcome in summary.outcomes_to_show]
    shown = compared(summary.outcomes_to_show, Program(), readers)
    report(
        path,
        [replace(asset, status="written") if asset.status == "unchanged" else asset for asset in shown],
        title=f"{out.resolve().name} as {suffix}",
        about="Each asset as it was read, and as what was written of it reads.",
        figures=Figures.of_run(summary, {"unchanged": "written"}),
        seconds=seconds,
        changes=False,  # the target may have other names
    )
