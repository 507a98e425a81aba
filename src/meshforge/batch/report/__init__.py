"""The report of a batch as one HTML page."""

from meshforge.batch.report.asset import Kept, Labelling, ReportAsset, Status
from meshforge.batch.report.chosen import Chosen
from meshforge.batch.report.figures import Figures
from meshforge.batch.report.page import PICTURED, write_report
from meshforge.batch.report.reading import PATIENCE, Reader, read_again, read_job

__all__ = [
    "PATIENCE",
    "PICTURED",
    "Chosen",
    "Figures",
    "Kept",
    "Labelling",
    "Reader",
    "ReportAsset",
    "Status",
    "read_again",
    "read_job",
    "write_report",
]
