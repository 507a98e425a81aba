"""Whether free space that can be reached stays free and reachable."""

from meshforge.checks.clearance.clearance import Clearance, Region, clearance

__all__ = ["Clearance", "Region", "clearance"]
