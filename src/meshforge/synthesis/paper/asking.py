"""Surfaces corrections for confirmation, one at a time, and none twice."""

from __future__ import annotations

from collections.abc import Callable, Container, Sequence

from meshforge.synthesis.correction import Correction


class Asking:
    """Remembers what was answered; without `confirm` every correction that was not rejected is agreed to."""

    def __init__(
        self, confirm: Callable[[Correction], bool] | None = None, rejected: Container[Correction] = ()
    ) -> None:
        self._confirm, self._rejected = confirm, rejected
        self._answers: dict[Correction, bool] = {}

    def are_confirmed(self, corrections: Sequence[Correction]) -> bool:
        """Whether all are right; nothing is asked about a repair of which one is known to be wrong."""
        return not any(map(self._is_refused, corrections)) and all(map(self._is_confirmed, corrections))

    def _is_refused(self, correction: Correction) -> bool:
        return correction in self._rejected or not self._answers.get(correction, True)

    def _is_confirmed(self, correction: Correction) -> bool:
        if self._confirm and correction not in self._answers:
            self._answers[correction] = self._confirm(correction)
        return self._answers.get(correction, True)
