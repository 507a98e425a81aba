"""What a person can do next: the question worth asking, and the asset worth demonstrating."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from meshforge.symbolic import bits
from meshforge.synthesis.asking import Choice, Hint, Question
from meshforge.synthesis.readings import Weighed
from meshforge.words import counted


def reading_id(rule: int, place: int) -> str:
    """The id of a reading by its place among those of its rule, from 0."""
    return f"{rule}.{place + 1}"


BALKED = 4
"""After so many answers that neither choice is right a rule is not asked about: what is meant is none of its readings,
or too many labels are wrong."""


def question(
    rule: int, weighed: Weighed, names: Sequence[str], trust: Mapping[str, float], declined: Collection[str]
) -> Question | None:
    """The question about one rule that is worth a person's time, None where there is none.

    names: of the meshes of the field; trust: how much an answer about each is worth; declined: those for which a person
    said that neither choice is right.
    """
    doubt = weighed.question_value
    if len(declined) >= BALKED:
        return None
    split = weighed.best_question({k: trust[name] for k, name in enumerate(names) if name not in declined})
    if not split or not split.is_worth_asking:
        return None
    choices = tuple(
        Choice(reading_id(rule, reading), _hulls(weighed, reading, split.asset)) for reading in split.choices
    )
    return Question(rule, names[split.asset], choices, doubt.harm, split.left)


def hint(learned: Sequence[tuple[Weighed, Sequence[str]]]) -> Hint | None:
    """The asset on which the readings of all rules differ most; else the one with most hulls unlike those shown.

    learned: for each rule its readings, and the names of the meshes of their field.
    """
    gains: dict[str, float] = {}
    for weighed, names in learned:
        for place, gain in weighed.question_value.gains(len(weighed.examples)).items():
            gains[names[place]] = gains.get(names[place], 0.0) + gain
    if gains:
        most = max(gains, key=lambda name: (gains[name], name))
        return Hint(most, "believable readings of the rules differ there")
    return _strangest(*learned[0]) if learned else None


def _strangest(weighed: Weighed, names: Sequence[str]) -> Hint | None:
    field, count = weighed.field, len(weighed.examples)
    shown = (1 << field.width_of(count)) - 1
    fresh = {
        name: sum(not shown >> group & 1 for group in field.groups[place])
        for place, name in enumerate(names[count:], count)
    }
    asset = max(fresh, key=lambda name: (fresh[name], name), default=None)
    if asset is None or not fresh[asset]:
        return None
    return Hint(asset, f"it has {counted(fresh[asset], 'hull')} unlike any that was demonstrated")


def _hulls(weighed: Weighed, reading: int, mesh: int) -> tuple[str, ...]:
    chosen = weighed.field.on(weighed.terms[reading].bits, mesh)
    hulls = weighed.field.meshes[mesh].hulls
    return tuple(hulls[index].name for index in sorted(bits(chosen)))
