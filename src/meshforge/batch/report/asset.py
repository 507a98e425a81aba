"""What the report is told about each asset."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from meshforge.checks import Examination, Finding
from meshforge.language import RuleTrace
from meshforge.symbolic import SymbolicMesh

Edit = Literal["edited", "unchanged", "written", "skipped", "failed"]
"""What a program or a conversion made of an asset."""
Check = Literal["clean", "warnings", "errors", "failed"]
"""What checks found of one; failed: it could not be checked, or not be written."""
Labelling = Literal["labelled", "doubtful", "problems"]
"""How the labels of one are: of all hulls, lacking or unsure for some, or not all to be taken."""
Status = Edit | Check | Labelling
ORDINARY: frozenset[Status] = frozenset({"edited", "written", "clean", "labelled"})
"""What is expected of an asset, so that its card does not say it."""
BROKEN: frozenset[Status] = frozenset({"failed", "errors", "problems"})
REMARKABLE = BROKEN | {"warnings", "doubtful"}


@dataclass(frozen=True, slots=True)
class Kept:
    """What is kept of an earlier examination: findings, and sentences about what was measured."""

    findings: tuple[Finding, ...]
    descriptions: tuple[str, ...]


@dataclass(frozen=True, eq=False, slots=True)
class ReportAsset:
    """One asset of a batch.

    before: None where the file could not be read; after: None where the program could not run on it, `before` itself
    where nothing was to be changed.
    trace: of every rule; error: the whole message of a failed asset; demonstrated: whether a person edited it.
    notes: what else there is to say, as what the format had to write in another form; checked: what was measured of it
    after, where that was asked for.
    """

    name: str
    before: SymbolicMesh | None
    after: SymbolicMesh | None = None
    trace: tuple[RuleTrace, ...] = ()
    status: Status = "edited"
    error: str | None = None
    demonstrated: bool = False
    notes: tuple[str, ...] = ()
    checked: Examination | Kept | None = None

    @property
    def counts(self) -> tuple[int, int] | None:
        """Numbers of hulls before and after, None unless both are known."""
        return (len(self.before.hulls), len(self.after.hulls)) if self.before and self.after else None

    @property
    def has_findings(self) -> bool:
        """Whether anything was found when it was checked."""
        return bool(self.checked and self.checked.findings)

    @property
    def is_broken(self) -> bool:
        """Whether it failed, or an error was found when it was checked."""
        errors = self.checked and any(finding.severity == "error" for finding in self.checked.findings)
        return self.status in BROKEN or bool(errors)

    @property
    def hulls_to_blame(self) -> frozenset[str]:
        """The hulls that findings name: those of errors, where there are any."""
        found = self.checked.findings if self.checked else ()
        errors = [finding for finding in found if finding.severity == "error"]
        return frozenset(hull for finding in errors or found for hull in finding.hulls)
