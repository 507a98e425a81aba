"""Errors that pages are told in a way of their own."""

from __future__ import annotations

from meshforge.errors import ProjectError, UsageError


class ConflictError(ProjectError):
    """Something else changed first: another page, or a command in a terminal. Nothing was written."""


class NotHereError(ProjectError):
    """Something that was asked for is not in the project."""


class TooLargeError(UsageError):
    """An upload beyond what is taken."""
