"""Errors as the page is told them: a status of HTTP, and the message in its parts."""

from __future__ import annotations

from meshforge.errors import MeshForgeError, told
from meshforge.studio.errors import ConflictError, NotHereError, TooLargeError
from meshforge.studio.wire.events import Problem


def status_of(error: Exception) -> int:
    """The status of HTTP for an error."""
    match error:
        case ConflictError():
            return 409
        case NotHereError():
            return 404
        case TooLargeError():
            return 413
        case MeshForgeError():
            return 400
        case _:
            return 500


def problem_of(error: Exception) -> Problem:
    """An error in its parts; one of our own faults in one sentence."""
    if isinstance(error, MeshForgeError):
        return Problem(
            message=error.problem,
            where=error.where,
            remedy=error.remedy,
            conflict=isinstance(error, ConflictError),
        )
    return Problem(message=told(error, fault="start the studio with --debug to see where it comes from"))
