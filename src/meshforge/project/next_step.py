"""A step that is sensible next, and the lines by which commands name it: all of them come from here."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from meshforge.common import quote_path

StepKind = Literal[
    "wait",
    "decompose",
    "label-all",
    "label",
    "check-labels",
    "demonstrate",
    "learn",
    "answer",
    "fix-program",
    "apply",
    "review",
    "correct",
    "export",
]


@dataclass(frozen=True, slots=True)
class NextStep:
    """What to do next, in words. asset: the one to open; command: what to type; note: what helps to type it."""

    kind: StepKind
    text: str
    asset: str | None = None
    command: str | None = None
    note: str | None = None


Done = Literal["made", "demonstrated", "forgot", "learned", "left open", "signed off", "prepared", "prepared all"]
"""What a command did: it learned a program, or left a question open; it prepared assets beside a program, or all that
there is to do without one."""
_AFTER: Mapping[Done, tuple[str, str]] = {
    "made": ("status", ""),
    "demonstrated": ("synthesize", ""),
    "forgot": ("synthesize", ""),
    "learned": ("apply", ""),
    "left open": ("review", ""),
    "signed off": ("apply", ""),
    "prepared": ("apply", " runs the program on it"),
    "prepared all": ("apply", " writes what is prepared, also without a program"),
}


def format_next(done: Done, folder: str | Path) -> str:
    """Return the line by which a command names the one that follows it, without a look at the whole family."""
    command, what = _AFTER[done]
    return f"Next: meshforge {command} {quote_path(Path(folder))}{what}"


def format_first(family: str, pattern: Path) -> str:
    """Return the line that names the command which makes a project of a bundled family."""
    return f"Next: meshforge new {family} {quote_path(pattern)}"


def format_step(step: NextStep) -> str:
    """Return the step that is chosen for a whole family, with what to type."""
    lines = (step.command, *(step.note or "").splitlines())
    return "\n  ".join([f"Next: {step.text}", *(line for line in lines if line)])
