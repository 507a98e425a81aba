"""signoffs.jsonl: which assets are signed off, and what that rests on; and what the last look found."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Literal, Self

from pydantic import AliasChoices, Field

from meshforge import signoff
from meshforge.batch import OutputInputs
from meshforge.store.events import Probability, list_lines, parse_line, read_lines
from meshforge.store.layout import JsonFile

ANSWERS = "what people showed and said"
"""How demonstrations, answers and verdicts are called where they changed."""


class SignOffBasis(OutputInputs):
    """Digests of all that a sign-off rests on: of all that decides the edit, where `settings` are those of the project
    that decide labels and program.

    answers: of what people showed and answered (`said` in files of earlier versions), None where it was not kept;
    output: of the files that were written, None where they are not there as they were.
    """

    answers: str | None = Field(default=None, validation_alias=AliasChoices("answers", "said"))
    output: str | None = None

    @classmethod
    def of(cls, edit: OutputInputs, settings: str, answers: str, output: str | None) -> Self:
        fields = dict(edit) | {"settings": settings, "software": "", "answers": answers, "output": output}
        return cls.model_construct(**fields)

    def changes(self, other: OutputInputs) -> tuple[str, ...]:
        """Return what differs between the two, in words."""
        if isinstance(other, SignOffBasis) and other.answers is None:
            return ("how sign-offs are kept",)
        return tuple(ANSWERS if one == "answers" else one for one in super().changes(other))


class SignOff(JsonFile):
    """One asset that is signed off. by: the tool, for its probability, or a person; when: ISO 8601, UTC."""

    asset: str
    by: Literal["tool", "person"]
    when: str
    probability: Probability
    rests_on: SignOffBasis

    def meets(self, threshold: float) -> bool:
        """Return whether a person signed it off, or the tool at this probability at least."""
        return self.by == "person" or self.probability >= threshold


def load_sign_offs(path: Path) -> dict[str, SignOff]:
    """Read the sign-offs of a file by asset. Raises ProjectError, naming the line, for one that is none."""
    lines = list_lines(read_lines(path))
    found = (parse_line(SignOff.model_validate_json, line, number, str(path)) for number, line in lines)
    return {one.asset: one for one in found}


class ConfidenceLine(JsonFile):
    """How an asset stood when the family was looked at last; rests_on: digests of all that decides its edit; looked_at:
    whether a person showed its edit, or accepted it; is_outlier: whether its output has alarms that the probability
    does not know; measures: of its edit, None where it has none."""

    probability: Probability
    reasons: tuple[signoff.Reason, ...] = ()
    rests_on: OutputInputs
    looked_at: bool = False
    is_outlier: bool = False
    measures: signoff.EditMeasures | None = None

    def passes(self, threshold: float) -> bool:
        """Return whether it may be signed off."""
        return self.looked_at or (self.probability >= threshold and not self.is_outlier)

    def with_alarms(self, alarms: Sequence[str]) -> Self:
        """Return the same where these alarms are none besides those it knows, or a person looked; else an outlier."""
        if self.looked_at or len(alarms) <= sum(reason.kind == "alarm" for reason in self.reasons):
            return self
        others = tuple(reason for reason in self.reasons if reason.kind != "alarm")
        reasons = tuple(signoff.Reason("alarm", text) for text in alarms)
        return self.model_copy(update={"reasons": (*reasons, *others), "is_outlier": True})

    def with_goals(self, goals: Sequence[signoff.GoalStatus]) -> Self:
        """Return the same with what is known of goals since."""
        if not goals:
            return self
        status = signoff.ResultStatus(self.probability, self.reasons).with_goals(goals)
        return self.model_copy(update={"probability": status.probability, "reasons": status.reasons})


class AssessmentFile(JsonFile):
    """What was found last. threshold: the probability from which on an asset is signed off; inputs_digest: of what was
    learned from and of all verdicts; wrong: assets of which a person said that the result is wrong.
    """

    threshold: float
    inputs_digest: str
    wrong: tuple[str, ...] = ()
    assets: dict[str, ConfidenceLine] = Field(default_factory=dict)

    def with_alarms(self, alarms: Mapping[str, Sequence[str]]) -> Self:
        """Return the same, and what stands out among outputs that were written since; alarms: sentences by asset."""
        lines = {name: line.with_alarms(alarms.get(name, ())) for name, line in self.assets.items()}
        return self.model_copy(update={"assets": lines})

    def holds(self, inputs_digest: str, inputs: Mapping[str, OutputInputs]) -> bool:
        """Return whether nothing changed since; inputs: of the edits of all assets that can be read, or of some."""
        return inputs_digest == self.inputs_digest and all(
            name in self.assets and not find_changes(now, self.assets[name].rests_on) for name, now in inputs.items()
        )


def find_changes(now: OutputInputs, then: OutputInputs) -> tuple[str, ...]:
    """Return what changed of all that an edit rests on; not how outputs are written, nor this software."""
    kept: Mapping[str, object] = {"settings": then.settings, "software": then.software}
    return now.model_copy(update=dict(kept)).changes(then)
