"""Convex decomposition by CoACD and V-HACD: cached, cancellable, verified."""

from meshforge.geometry.decompose.cache import cache_folder
from meshforge.geometry.decompose.child import DecompositionCancelledError, Progress
from meshforge.geometry.decompose.holes import enclosed_volume
from meshforge.geometry.decompose.run import decompose
from meshforge.geometry.decompose.settings import CoacdSettings, DecomposeSettings, VhacdSettings
from meshforge.geometry.decompose.sheet import is_line, is_sheet, sheet_hulls

__all__ = [
    "CoacdSettings",
    "DecomposeSettings",
    "DecompositionCancelledError",
    "Progress",
    "VhacdSettings",
    "cache_folder",
    "decompose",
    "enclosed_volume",
    "is_line",
    "is_sheet",
    "sheet_hulls",
]
