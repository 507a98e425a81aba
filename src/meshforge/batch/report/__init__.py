"""The report of a batch as one HTML page."""

from meshforge.batch.report.asset import ReportAsset, Status
from meshforge.batch.report.page import PICTURED, write_report

__all__ = ["PICTURED", "ReportAsset", "Status", "write_report"]
