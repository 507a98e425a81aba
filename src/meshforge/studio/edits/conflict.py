"""The error of a change that was made on a state which is no more."""

from __future__ import annotations

from meshforge.errors import ProjectError


class ConflictError(ProjectError):
    """Something else changed first: another page, or a command in a terminal. Nothing was written."""
