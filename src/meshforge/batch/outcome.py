"""What became of each asset: a closed union of plain data, which pickles and prints as one JSON line; and the sums
of a run, counted as outcomes come."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

from meshforge import language, signoff
from meshforge.common import format_share, pluralize, suggest_match

StatusWord = Literal["edited", "unchanged", "failed", "skipped"]

MOST_SHOWN = 120
"""Outcomes of either kind that are kept for a report."""
_MOST_NAMED = 20
_MOST_ALARMED = 5


@dataclass(frozen=True, slots=True)
class RuleEffect:
    """What one rule did on one asset: names of the hulls it selected and made; rule counts from 1.

    gone: names of hulls that it replaced, which no hull has any more.
    """

    rule: int
    selected: tuple[str, ...]
    made: tuple[str, ...] = ()
    note: str | None = None
    gone: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class RunOutcome:
    """What the outcomes of a run that came to its end have in common.

    out: the file that was written, or that would be on a dry run; before, after: numbers of hulls;
    notes: what the format had to write in another form; flags: edits by hand whose hulls are gone;
    measures: of the edit; labels: all that its hulls had before it; both None for what an earlier version has written.
    """

    asset: str
    out: str
    rules: tuple[RuleEffect, ...]
    before: int
    after: int
    seconds: float
    notes: tuple[str, ...] = ()
    flags: tuple[str, ...] = ()
    measures: signoff.EditMeasures | None = None
    labels: tuple[str, ...] | None = None


@dataclass(frozen=True, slots=True)
class Edited(RunOutcome):
    """The program changed the hulls of the asset."""

    status: ClassVar[StatusWord] = "edited"


@dataclass(frozen=True, slots=True)
class Unchanged(RunOutcome):
    """The program ran and changed nothing; the asset is written as it was."""

    status: ClassVar[StatusWord] = "unchanged"


@dataclass(frozen=True, slots=True)
class Skipped(RunOutcome):
    """The output of an earlier run is up to date; rules, counts and notes are those of that run."""

    status: ClassVar[StatusWord] = "skipped"


@dataclass(frozen=True, slots=True)
class Failed:
    """The asset was not written; error: the whole message."""

    status: ClassVar[StatusWord] = "failed"
    asset: str
    error: str
    seconds: float


AssetOutcome = Edited | Unchanged | Failed | Skipped


@dataclass(frozen=True, slots=True)
class NeedsReview:
    """An asset that was not written in a run, since its edit is less sure than was asked for.

    out: an output of an earlier run, which stays as it is.
    """

    status: ClassVar[Literal["needs review"]] = "needs review"
    seconds: ClassVar[float] = 0.0
    asset: str
    result_status: signoff.ResultStatus
    out: str | None = None

    def describe(self) -> str:
        """Return how sure it is, and why not surer, in one sentence."""
        reason = next((one.text for one in self.result_status.reasons), "no single doubt stands out")
        kept = "; the output of an earlier run stays as it is" if self.out else ""
        return f"{format_share(self.result_status.confidence)} sure; {reason}{kept}"


def to_json_line(outcome: AssetOutcome | NeedsReview, alarms: Sequence[str] | None = None) -> dict[str, Any]:
    """Return the line of `apply --json` for an outcome; what an asset that was not written has not is null or empty.

    alarms: sentences about it, None where nobody looks for any: then the line does not speak of them.
    """
    ran = outcome if isinstance(outcome, RunOutcome) else None
    return {
        "asset": outcome.asset,
        "status": outcome.status,
        "out": None if isinstance(outcome, Failed) else outcome.out,
        "error": outcome.error if isinstance(outcome, Failed) else None,
        "rules": [
            {"rule": line.rule, "selected": list(line.selected), "made": list(line.made), "note": line.note}
            | ({"gone": list(line.gone)} if line.gone else {})
            for line in (ran.rules if ran else ())
        ],
        "hulls": {"before": ran.before if ran else None, "after": ran.after if ran else None},
        "seconds": round(outcome.seconds, 3),
        **({} if alarms is None else {"alarms": list(alarms)}),
        **(outcome.result_status.to_json() if isinstance(outcome, NeedsReview) else {}),
    }


@dataclass(eq=False, slots=True)
class RunSummary:
    """counts: by status; before, after: hulls of all that ran; failed, ran: the first outcomes of either kind;
    measures: of all edits, by asset; labels: all that hulls had before, None where that is not known of some asset that
    ran; need_review: those that were not written for it; shown: measures of edits by this program that a person saw.
    """

    counts: Counter[StatusWord] = field(default_factory=Counter)
    before: int = 0
    after: int = 0
    failed: list[Failed] = field(default_factory=list)
    ran: list[Edited | Unchanged | Skipped] = field(default_factory=list)
    measures: dict[str, signoff.EditMeasures] = field(default_factory=dict)
    labels: set[str] | None = field(default_factory=set)
    need_review: Sequence[NeedsReview] = ()
    shown: Sequence[signoff.EditMeasures] = ()

    def add(self, outcome: AssetOutcome) -> None:
        """Count one more."""
        self.counts[outcome.status] += 1
        if isinstance(outcome, Failed):
            if len(self.failed) < MOST_SHOWN:
                self.failed.append(outcome)
            return
        self.before += outcome.before
        self.after += outcome.after
        if outcome.measures:
            self.measures[outcome.asset] = outcome.measures
        if self.labels is not None:
            self.labels = None if outcome.labels is None else self.labels.union(outcome.labels)
        if len(self.ran) < MOST_SHOWN:
            self.ran.append(outcome)

    @property
    def total(self) -> int:
        """How many assets there were."""
        return self.counts.total()

    def find_alarms(self) -> dict[str, tuple[str, ...]]:
        """Return sentences about the results that stand out of all so far, the weightiest first, by asset."""
        return signoff.describe_outliers(self.measures, self.shown)

    def describe_absent_labels(self, program: language.Program) -> list[str]:
        """Return a sentence on each label that a program asks for, no rule gives and no asset that ran has.

        None is absent where no asset that ran has any label, nor where labels are not known of all of them.
        """
        made, present = {rule.label for rule in program.rules}, self.labels or set()
        absent = [label for label in program.labels_asked if present and label not in present | made]
        those = " that was edited" if self.counts["failed"] or self.need_review else ""
        problem = f"a label that no asset{those} has"
        return [f"the program asks for {one!r}, {problem}{suggest_match(one, present)}" for one in absent]

    @property
    def outcomes_to_show(self) -> tuple[AssetOutcome, ...]:
        """Those that a report shows: failed ones first, then the first of the others."""
        return (*self.failed, *self.ran)[:MOST_SHOWN]

    def __str__(self) -> str:
        counts = ", ".join(f"{n:,} {word}" for word, n in self.counts.items()) or "nothing to do"
        counts += f", {len(self.need_review):,} need review" if self.need_review else ""
        total = pluralize(self.total + len(self.need_review), "asset")
        text = f"{total}: {counts}; hulls {self.before:,} -> {self.after:,}"
        more = self.counts["failed"] - len(self.failed[:_MOST_NAMED])
        names = [outcome.asset for outcome in self.failed[:_MOST_NAMED]]
        if self.total <= _MOST_NAMED or not names:  # they are on the screen
            return text
        return f"{text}\nfailed: {', '.join(names)}{f' and {more:,} more' if more else ''}"


def describe_alarms(alarms: Mapping[str, Sequence[str]]) -> str:
    """Return which results stand out, and the weightiest reason of each; alarms: sentences by asset, at least one."""
    named = [f"{asset} ({alarms[asset][0]})" for asset in list(alarms)[:_MOST_ALARMED]]
    more = len(alarms) - len(named)
    verb = "stands" if len(alarms) == 1 else "stand"
    return f"{pluralize(len(alarms), 'result')} {verb} out: {', '.join(named)}{f' and {more:,} more' if more else ''}"
