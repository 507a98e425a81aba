"""What can go wrong when a model is asked: faults that pass, and those after which asking on is of no use."""

from __future__ import annotations

from meshforge.errors import MeshForgeError


class AskingError(MeshForgeError):
    """A question that got no answer; others may get one."""


class RefusedError(AskingError):
    """A question that the server does not take as it stands."""


class EndError(AskingError):
    """No further question would get an answer: a wrong key, no such model, nobody there, no money left, or stopped."""


class PassingError(Exception):
    """A fault of one attempt, after which another one is worth it.

    after: what the server wants waited [s], None where it does not say; charged: whether the attempt may have been
    charged for all the same; unreachable: whether there was no server at all.
    """

    def __init__(
        self, problem: str, after: float | None = None, *, charged: bool = False, unreachable: bool = False
    ) -> None:
        super().__init__(problem)
        self.after = after
        self.charged = charged
        self.unreachable = unreachable
