"""Errors with an HTTP status of their own, and every error as the page gets it."""

from meshforge.common import MeshForgeError, ProjectError, UsageError, describe_error
from meshforge.store import ConflictError
from meshforge.studio.wire.events import Problem


class NotHereError(ProjectError):
    """There is no such thing in the project."""


class TooLargeError(UsageError):
    """An upload is larger than the limit."""


_STATUSES = {ConflictError: 409, NotHereError: 404, TooLargeError: 413, MeshForgeError: 400}


def status_of(error: Exception) -> int:
    """Return the HTTP status of an error."""
    return next((status for kind, status in _STATUSES.items() if isinstance(error, kind)), 500)


def problem_of(error: Exception) -> Problem:
    """Return an error in its parts; a fault of the studio in one sentence."""
    if isinstance(error, MeshForgeError):
        return Problem(
            message=error.problem,
            where=error.where,
            remedy=error.remedy,
            conflict=isinstance(error, ConflictError),
        )
    return Problem(message=describe_error(error, fault="start the studio with --debug to see where it comes from"))
