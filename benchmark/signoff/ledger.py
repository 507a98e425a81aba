"""What a person spends on a family: seconds by the keystroke-level model, and acts, by what they are."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence

from benchmark.study.keystrokes import DEMONSTRATION, HULL, INSPECTION, PAINT, RULE, STROKE
from benchmark.study.propagation import HandLabels


class Ledger:
    """seconds, acts: by name."""

    def __init__(self) -> None:
        self.seconds: defaultdict[str, float] = defaultdict(float)
        self.acts = Counter[str]()

    @property
    def total(self) -> float:
        """Seconds so far."""
        return sum(self.seconds.values())

    def add(self, what: str, seconds: float) -> None:
        """Note one act."""
        self.seconds[what] += seconds
        self.acts[what] += 1

    def add_labels(self, done: HandLabels) -> None:
        """Note labels that were looked at and painted."""
        if seconds := done.inspected * INSPECTION + done.strokes * STROKE + done.typed * PAINT:
            self.add("labels by hand", seconds)


def price_of_mend(done: Sequence[frozenset[str]] | None, wanted: Sequence[frozenset[str]]) -> float:
    """Seconds for a wrong result that is mended: each rule that failed is named, and each hull clicked that it should
    have selected or left out; or all is made by hand, where that is less."""
    anew = price_of_hand(wanted)
    if done is None:
        return anew
    wrong = [len(one ^ other) for one, other in zip(done, wanted, strict=True)]
    return min(anew, RULE * sum(map(bool, wrong)) + HULL * sum(wrong))


def price_of_hand(selections: Iterable[Iterable[str]]) -> float:
    """Seconds for an edit that is made, or shown, by hand: what each step selects."""
    sizes = [len(set(select)) for select in selections]
    return DEMONSTRATION + RULE * sum(map(bool, sizes)) + HULL * sum(sizes)
