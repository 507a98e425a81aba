"""What the report is told about each asset."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from meshforge.checks import Examination
from meshforge.language import RuleTrace
from meshforge.symbolic import SymbolicMesh

Status = Literal["edited", "unchanged", "failed", "skipped"]


@dataclass(frozen=True, eq=False, slots=True)
class ReportAsset:
    """One asset of a batch.

    before: None where the file could not be read; after: None where the program could not run on it.
    trace: of every rule; error: the whole message of a failed asset; demonstrated: whether a person edited it.
    notes: what the format had to write in another form; checked: what was measured of it after, where that was asked
    for.
    """

    name: str
    before: SymbolicMesh | None
    after: SymbolicMesh | None = None
    trace: tuple[RuleTrace, ...] = ()
    status: Status = "edited"
    error: str | None = None
    demonstrated: bool = False
    notes: tuple[str, ...] = ()
    checked: Examination | None = None

    @property
    def counts(self) -> tuple[int, int] | None:
        """Numbers of hulls before and after, None unless both are known."""
        return (len(self.before.hulls), len(self.after.hulls)) if self.before and self.after else None

    @property
    def doubtful(self) -> bool:
        """Whether anything was found when it was checked."""
        return bool(self.checked and self.checked.findings)

    @property
    def broken(self) -> bool:
        """Whether it failed, or an error was found when it was checked."""
        errors = self.checked and any(finding.severity == "error" for finding in self.checked.findings)
        return self.status == "failed" or bool(errors)
