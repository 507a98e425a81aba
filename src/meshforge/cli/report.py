"""Writing the page that `--report` asks for."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from meshforge.batch import ReportAsset


def report(path: Path, assets: Sequence[ReportAsset], **more: Any) -> None:
    """Write it with a bar on stderr, and say where it is; more: as of `write_report`."""
    from meshforge.batch import write_report
    from meshforge.cli.output import progress, remark

    with progress(len(assets), "drawing") as advance:
        write_report(path, assets=assets, progress=advance, **more)
    remark(f"report: {path}")
