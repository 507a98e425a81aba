"""What a run came to, counted as its outcomes come, so that a hundred thousand of them need not be kept."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from meshforge.batch.outcome import Edited, Failed, Outcome, Skipped, Unchanged, Word, status
from meshforge.words import counted

SHOWN = 120
"""Outcomes of either kind that are kept for a report."""
_NAMED = 20


@dataclass(eq=False, slots=True)
class Summary:
    """counts: by status; before, after: hulls of all that ran; failed, ran: the first outcomes of either kind."""

    counts: Counter[Word] = field(default_factory=Counter)
    before: int = 0
    after: int = 0
    failed: list[Failed] = field(default_factory=list)
    ran: list[Edited | Unchanged | Skipped] = field(default_factory=list)

    def add(self, outcome: Outcome) -> None:
        """Count one more."""
        self.counts[status(outcome)] += 1
        if isinstance(outcome, Failed):
            if len(self.failed) < SHOWN:
                self.failed.append(outcome)
            return
        self.before += outcome.before
        self.after += outcome.after
        if len(self.ran) < SHOWN:
            self.ran.append(outcome)

    @property
    def total(self) -> int:
        """How many assets there were."""
        return self.counts.total()

    @property
    def outcomes_to_show(self) -> tuple[Outcome, ...]:
        """Those that a report shows: failed ones first, then the first of the others."""
        return (*self.failed, *self.ran)[:SHOWN]

    def __str__(self) -> str:
        counts = ", ".join(f"{n:,} {word}" for word, n in self.counts.items()) or "nothing to do"
        told = f"{counted(self.total, 'asset')}: {counts}; hulls {self.before:,} -> {self.after:,}"
        more = self.counts["failed"] - len(self.failed[:_NAMED])
        names = [outcome.asset for outcome in self.failed[:_NAMED]]
        if self.total <= _NAMED or not names:  # they are on the screen
            return told
        return f"{told}\nfailed: {', '.join(names)}{f' and {more:,} more' if more else ''}"
