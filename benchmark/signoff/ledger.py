"""What a person spends on a family: seconds by the keystroke-level model, and acts, by what they are."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Sequence

from benchmark.study.keystrokes import DEMONSTRATION, HULL, INSPECTION, PAINT, RULE, STROKE, price_selection
from benchmark.study.propagation import HandLabels


class Ledger:
    """seconds, by_keys, acts: by name; seconds: by the mouse; by_keys: by keys and look-alikes."""

    def __init__(self) -> None:
        self.seconds, self.by_keys = defaultdict[str, float](float), defaultdict[str, float](float)
        self.acts = Counter[str]()

    @property
    def total(self) -> float:
        """Seconds so far."""
        return sum(self.seconds.values())

    def add(self, what: str, seconds: float, by_keys: float | None = None) -> None:
        """Note one act; by_keys: None for the same seconds."""
        self.seconds[what] += seconds
        self.by_keys[what] += seconds if by_keys is None else by_keys
        self.acts[what] += 1

    def add_labels(self, done: HandLabels) -> None:
        """Note labels that were looked at and painted."""
        if seconds := done.inspected * INSPECTION + done.strokes * STROKE + done.typed * PAINT:
            self.add("labels by hand", seconds, done.by_keys)


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


def price_of_mend_by_keys(
    done: Sequence[frozenset[str]] | None, wanted: Sequence[frozenset[str]], alike: Callable[[str], frozenset[str]]
) -> float:
    """The same by keys; alike: the look-alikes of a hull."""
    anew = price_of_hand_by_keys(wanted, alike)
    if done is None:
        return anew
    wrong: list[frozenset[str]] = [one ^ other for one, other in zip(done, wanted, strict=True)]
    mended = sum(RULE + price_selection(some, alike) for some in wrong if some)
    return min(anew, mended)


def price_of_hand_by_keys(selections: Iterable[Iterable[str]], alike: Callable[[str], frozenset[str]]) -> float:
    """The same by keys; alike: the look-alikes of a hull."""
    steps = [RULE + price_selection(select, alike) for select in selections if select]
    return DEMONSTRATION + sum(steps)
