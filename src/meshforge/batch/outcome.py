"""What became of one asset in a batch: a closed union of plain data, which pickles and prints as one JSON line."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, assert_never


@dataclass(frozen=True, slots=True)
class RuleLine:
    """What one rule did on one asset: names of the hulls it selected and made; rule counts from 1."""

    rule: int
    selected: tuple[str, ...]
    made: tuple[str, ...] = ()
    note: str | None = None


@dataclass(frozen=True, slots=True)
class Ran:
    """What the outcomes of a run that came to its end have in common.

    out: the file that was written, or that would be on a dry run; before, after: numbers of hulls;
    notes: what the format had to write in another form; flags: edits by hand whose hulls are gone.
    """

    asset: str
    out: str
    rules: tuple[RuleLine, ...]
    before: int
    after: int
    seconds: float
    notes: tuple[str, ...] = ()
    flags: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Edited(Ran):
    """The program changed the hulls of the asset."""


@dataclass(frozen=True, slots=True)
class Unchanged(Ran):
    """The program ran and changed nothing; the asset is written as it was."""


@dataclass(frozen=True, slots=True)
class Skipped(Ran):
    """The output of an earlier run is up to date; rules, counts and notes are those of that run."""


@dataclass(frozen=True, slots=True)
class Failed:
    """The asset was not written; error: the whole message."""

    asset: str
    error: str
    seconds: float


Outcome = Edited | Unchanged | Failed | Skipped


Word = Literal["edited", "unchanged", "failed", "skipped"]


def status(outcome: Outcome) -> Word:
    """The word for an outcome: `edited`, `unchanged`, `failed` or `skipped`."""
    match outcome:
        case Edited():
            return "edited"
        case Unchanged():
            return "unchanged"
        case Skipped():
            return "skipped"
        case Failed():
            return "failed"
        case _:
            assert_never(outcome)


def json_line(outcome: Outcome) -> dict[str, Any]:
    """The line of `apply --json` for an outcome; what a failed asset has not is null or empty."""
    ran = None if isinstance(outcome, Failed) else outcome
    return {
        "asset": outcome.asset,
        "status": status(outcome),
        "out": ran.out if ran else None,
        "error": outcome.error if isinstance(outcome, Failed) else None,
        "rules": [_rule(line) for line in ran.rules] if ran else [],
        "hulls": {"before": ran.before if ran else None, "after": ran.after if ran else None},
        "seconds": round(outcome.seconds, 3),
    }


def _rule(line: RuleLine) -> dict[str, Any]:
    return {"rule": line.rule, "selected": list(line.selected), "made": list(line.made), "note": line.note}
