"""What the report is told about each asset."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from meshforge.language import RuleTrace
from meshforge.symbolic import SymbolicMesh

Status = Literal["edited", "unchanged", "failed", "skipped"]


@dataclass(frozen=True, eq=False, slots=True)
class ReportAsset:
    """One asset of a batch.

    before: None where the file could not be read; after: None where the program could not run on it.
    trace: of every rule; error: the whole message of a failed asset; demonstrated: whether a person edited it.
    notes: what the format had to write in another form.
    """

    name: str
    before: SymbolicMesh | None
    after: SymbolicMesh | None = None
    trace: tuple[RuleTrace, ...] = ()
    status: Status = "edited"
    error: str | None = None
    demonstrated: bool = False
    notes: tuple[str, ...] = ()

    @property
    def counts(self) -> tuple[int, int] | None:
        """Numbers of hulls before and after, None unless both are known."""
        return (len(self.before.hulls), len(self.after.hulls)) if self.before and self.after else None
