"""Which assets are signed off, and what that rests on; and what was found when the family was looked at last."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field

from meshforge.batch import OutputInputs
from meshforge.signoff import AssetConfidence, Doubt, DoubtKind
from meshforge.store.layout import JsonFile

Probability = Annotated[float, Field(ge=0, le=1)]


class SignOff(JsonFile):
    """One asset that is signed off. by: the tool, for its probability, or a person; when: ISO 8601, UTC; rests_on: the
    digests of all that decides its edit.
    """

    by: Literal["tool", "person"]
    when: str
    probability: Probability
    rests_on: OutputInputs


class SignOffFile(JsonFile):
    """signoff.json: sign-offs by asset, and the ids of questions that were put off."""

    assets: dict[str, SignOff] = Field(default_factory=dict)
    later: tuple[str, ...] = ()


class DoubtLine(JsonFile):
    """One doubt about an edit, as `signoff.Doubt` has it."""

    kind: DoubtKind
    text: str
    hulls: tuple[str, ...] = ()
    rule: int | None = None
    share: float = 0.0


class ConfidenceLine(JsonFile):
    """How an asset stood when the family was looked at last; rests_on: as of `SignOff`."""

    probability: Probability
    doubts: tuple[DoubtLine, ...] = ()
    rests_on: OutputInputs

    @staticmethod
    def of(found: AssetConfidence, rests_on: OutputInputs) -> ConfidenceLine:
        doubts = tuple(
            DoubtLine(kind=one.kind, text=one.text, hulls=one.hulls, rule=one.rule, share=one.share)
            for one in found.doubts
        )
        return ConfidenceLine(probability=found.probability, doubts=doubts, rests_on=rests_on)

    def to_confidence(self, asset: str) -> AssetConfidence:
        doubts = tuple(Doubt(one.kind, one.text, one.hulls, one.rule, one.share) for one in self.doubts)
        return AssetConfidence(asset, self.probability, doubts)


class AssessmentFile(JsonFile):
    """What was found last; bar: the probability from which on an asset was signed off."""

    bar: float
    assets: dict[str, ConfidenceLine] = Field(default_factory=dict)


def find_changes(now: OutputInputs, then: OutputInputs) -> tuple[str, ...]:
    """What changed of all that an edit rests on; not how outputs are written, nor the version of this software."""
    kept: Mapping[str, object] = {"settings": then.settings, "software": then.software}
    return now.model_copy(update=dict(kept)).changes(then)
