"""The fourteen tables. One program must be right for all: see `script/samples/__init__.py`."""

from __future__ import annotations

from script.samples.family_desks import DESKS
from script.samples.family_tables import TABLES

FAMILY = tuple(sorted([*DESKS, *TABLES], key=lambda made: made().name))
"""Makers of the tables, in the order of their names."""
