"""What is kept of one person who teaches one task: every act, every round of the tool, and how good the result is."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass(slots=True)
class Round:
    """One look of the tool at all that it was told; differs: meshes, of those not demonstrated, on which its program
    selects something else than the reference; seconds: of the tool."""

    demonstrations: int
    answers: int
    differs: int
    status: str = ""
    program: str | None = None
    settled: bool = False
    seconds: dict[str, float] = field(default_factory=dict)

    @property
    def right(self) -> bool:
        return not self.differs


@dataclass(slots=True)
class Session:
    """All that happened.

    typed, strokes, inspected: labels that were given by hand, different ones of these a mesh, and labels that were
    looked at; glances: results that were looked at; approvals: those that were reported as right; accepted: whether the
    person saw nothing wrong in the end; right: on the meshes that were not demonstrated, under the same labels;
    right_on_true: there under true labels; right_elsewhere: under true labels on the other decompositions of those
    assets, None where there are none; failures: of the judged meshes those that do not meet the criterion, and why;
    reference_failed, ceiling_failed: how many of these fail by the reference program, under the same labels, and under
    true ones; labels_right: the share of labels that are right on the judged meshes in the end.
    """

    task: str
    condition: str
    seed: int
    setting: str = ""
    rounds: list[Round] = field(default_factory=list)
    shown: list[str] = field(default_factory=list)
    steps_shown: int = 0
    hulls_shown: int = 0
    answers: int = 0
    neither: int = 0
    taken_back: int = 0
    set_aside: int = 0
    confirmed: int = 0
    refused: int = 0
    rightly: int = 0
    typed: int = 0
    strokes: int = 0
    inspected: int = 0
    glances: int = 0
    approvals: int = 0
    accepted: bool = False
    settled: bool = False
    right: bool = False
    right_on_true: bool = False
    right_elsewhere: bool | None = None
    program: str | None = None
    f1: float = 0.0
    failures: dict[str, str] = field(default_factory=dict)
    judged: int = 0
    judged_pure: int = 0
    failed_pure: int = 0
    reference_failed: int = 0
    ceiling_failed: int = 0
    labels_right: float = 1.0
    known_among: list[bool] = field(default_factory=list)

    @property
    def k(self) -> int:
        """Demonstrations plus answers."""
        return len(self.shown) + self.answers

    def to_json(self) -> dict[str, Any]:
        return asdict(self)

    def summarize(self) -> dict[str, Any]:
        """The same, short enough to be kept: of a round only what it was about and whether it was right, of a failure
        only which check fails, no times, and nothing that is as it is by default."""
        rounds = [{key: asdict(row)[key] for key in ("demonstrations", "answers", "differs")} for row in self.rounds]
        failures = {name: why.split(":")[0] for name, why in self.failures.items()}
        told = {**asdict(self), "rounds": rounds, "failures": failures}
        default = asdict(Session(self.task, self.condition, self.seed, self.setting))
        required = ("task", "condition", "seed", "setting")
        return {key: value for key, value in told.items() if key in required or value != default[key]}

    @staticmethod
    def of_json(data: dict[str, Any]) -> Session:
        return Session(**{**data, "rounds": [Round(**row) for row in data["rounds"]]})
