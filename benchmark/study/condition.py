"""The conditions under which tasks are taught."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from meshforge.synthesis import Layers, Options

TUNING, REPORTED = range(5), range(100, 105)
"""Seeds of the demonstrators: what anything may be tuned on, and what is reported."""

MOST = 5
"""Demonstrations that a person gives at most (paper, protocol)."""
SEEN = 12
"""Meshes of which a person looks at the result before accepting it."""
Labels = Literal["true", "noisy", "propagated"]


@dataclass(frozen=True, slots=True)
class Condition:
    """How a task is taught.

    labels: true ones, those of the noisy labeller, or those that propagation carries over from demonstrated meshes and
    from as many as `labelled` before, which a person labels as advised; questions: whether the tool's questions are
    answered; layers, repair: ablations of the tool; errs: the share of answers and confirmations that are wrong;
    advised: whether a person who has several meshes in mind to begin with takes the one of them that the tool proposes;
    guided: whether the results that are looked at are those that the tool proposes, and what is right there is told to
    it.
    """

    name: str
    labels: Labels = "true"
    questions: bool = True
    layers: Layers = "S+T+G"
    repair: bool = True
    errs: float = 0.0
    advised: bool = True
    guided: bool = True
    labelled: int = 0

    @property
    def options(self) -> Options:
        return Options(layers=self.layers, repair=self.repair)


FULL = Condition("true labels")
NOISY = Condition("noisy labels", "noisy")
CONDITIONS = {
    condition.name: condition
    for condition in (
        FULL,
        Condition("true labels, own choice", advised=False),
        Condition("true labels, random dozen", guided=False),
        Condition("true labels, no questions", questions=False),
        NOISY,
        Condition("noisy labels, random dozen", "noisy", guided=False),
        Condition("noisy labels, no questions", "noisy", questions=False),
        Condition("noisy labels, no repair", "noisy", repair=False),
        Condition("noisy labels, errs in 5%", "noisy", errs=0.05),
        Condition("propagated labels, 1 labelled", "propagated", labelled=1),
        Condition("propagated labels, 3 labelled", "propagated", labelled=3),
        Condition("S", layers="S"),
        Condition("S+T", layers="S+T"),
        Condition("S+G", layers="S+G"),
    )
}
"""All conditions by name; S+T+G is `true labels`."""
