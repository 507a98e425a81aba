"""What became of a new asset before the program: hulls that were split, those that were left though they likely span
parts, and labels by likeness; in words, as JSON, and as doubts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from meshforge.common import join_names, pluralize
from meshforge.labels import HullSpan
from meshforge.signoff import Doubt
from meshforge.symbolic import Label

_DIGITS = 3


@dataclass(frozen=True, slots=True)
class HullSplit:
    """A hull that was split. chance: that it spans parts; told: in words; parts: the label of each by its name."""

    hull: str
    chance: float
    told: str
    parts: Mapping[str, Label]

    def __str__(self) -> str:
        """`base holds wall and handle, 94%: split in 3, wall (99%) and 2 handle (97%)`; of a label the least sure."""
        names = dict.fromkeys(label.name for label in self.parts.values())
        return f"{self.told}: split in {len(self.parts)}, {' and '.join(map(self._describe_label, names))}"

    def _describe_label(self, name: str) -> str:
        sure = [label.confidence for label in self.parts.values() if label.name == name]
        return f"{f'{len(sure)} ' if len(sure) > 1 else ''}{name} ({min(sure):.0%})"


@dataclass(frozen=True, slots=True)
class NewAssetResult:
    """What became of a new asset before the program.

    splits: hulls that were split; spanning: those that likely span parts and were not; guesses: labels that the family
    gave to hulls that had none; notes: all else; problem: why it could not be prepared.
    """

    asset: str
    splits: tuple[HullSplit, ...] = ()
    spanning: tuple[HullSpan, ...] = ()
    guesses: Mapping[str, Label] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    problem: str | None = None

    @property
    def doubts(self) -> tuple[Doubt, ...]:
        """All that was guessed, with the probability that it is wrong, the least sure first."""
        parts = {name: label for split in self.splits for name, label in split.parts.items()}
        words = [
            (f"{name} is called {one.name} as a part that was split off", one, name) for name, one in parts.items()
        ]
        words += [(f"{name} is called {one.name} by its likeness", one, name) for name, one in self.guesses.items()]
        labels = [Doubt("label", text, (name,), share=1 - one.confidence) for text, one, name in words]
        return tuple(sorted([*self.split_doubts, *labels], key=lambda one: -one.share))

    @property
    def split_doubts(self) -> tuple[Doubt, ...]:
        """Those about which hulls span parts: whether one that was split does not, or one that was left does."""
        splits = [Doubt("label", str(one), (one.hull,), share=1 - one.chance) for one in self.splits]
        return (*splits, *(Doubt("label", f"{one}: not split", (one.hull,), share=one.chance) for one in self.spanning))

    @property
    def probability(self) -> float:
        """That all of it is right, at most: that of the least sure guess, 1 where nothing was guessed."""
        return 1 - max((one.share for one in self.doubts), default=0.0)

    def describe(self) -> tuple[str, ...]:
        """A sentence on each split, each hull that was left, and on the labels."""
        rows = [*map(str, self.splits), *(f"{span}: not split" for span in self.spanning)]
        if self.guesses:
            name, least = min(self.guesses.items(), key=lambda row: row[1].confidence)
            rows.append(
                f"{pluralize(len(self.guesses), 'label')} by likeness to the family; "
                f"least sure: {name} is {least.name}, {least.confidence:.0%}"
            )
        return (*rows, *self.notes)

    def to_json(self) -> dict[str, Any]:
        """What the line of `apply --json` says of it."""
        return {
            "split": [
                {
                    "hull": one.hull,
                    "chance": round(one.chance, _DIGITS),
                    "into": [
                        {"hull": name, "label": label.name, "confidence": label.confidence}
                        for name, label in one.parts.items()
                    ],
                }
                for one in self.splits
            ],
            "spanning": [
                {"hull": one.hull, "chance": round(one.chance, _DIGITS), "holds": list(one.shares)}
                for one in self.spanning
            ],
            "guessed": {name: {"label": one.name, "confidence": one.confidence} for name, one in self.guesses.items()},
            "sure_at_most": round(self.probability, _DIGITS),
        }


def describe_new(results: Sequence[NewAssetResult]) -> str | None:
    """How many hulls of new assets were split, and how many likely span parts and were not; None where none."""
    splits, left = sum(len(one.splits) for one in results), sum(len(one.spanning) for one in results)
    split = [one.asset for one in results if one.splits]
    parts = [f"{pluralize(splits, 'hull')} of new assets split ({join_names(split)})"] if splits else []
    parts += [f"{pluralize(left, 'hull')} likely {'spans' if left == 1 else 'span'} parts, not split"] if left else []
    return "; ".join(parts) or None
