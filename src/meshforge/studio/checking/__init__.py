"""Outputs measured beside the assets they were made from: in worker processes, kept by content; its door: `Checks`."""

from meshforge.studio.checking.checks import Checks
from meshforge.studio.checking.key import check_key

__all__ = ["Checks", "check_key"]
