"""Fits the weights of `readings/belief.py` and of the leaf extractors anew, and judges them on other families.

The nats of a reading are linear in the weights. So what a weight multiplies is what the product's own `beliefs` gives
with this weight 1 and all others 0, up to what is equal for all readings of a rule; nothing is copied from there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from itertools import chain, pairwise
from types import ModuleType
from unittest.mock import patch

import numpy as np
from scipy.optimize import minimize

from benchmark.learning.cases import Case, cases
from benchmark.learning.rule_courses import percent
from benchmark.learning.task_cases import QUICK, task_cases
from benchmark.report import Cell, Result, Table, Tell
from meshforge.geometry import Floats
from meshforge.language.extractors import attach, bases, geo
from meshforge.synthesis.candidates import belief
from meshforge.synthesis.candidates.belief import count_idle, measure_evidence
from meshforge.synthesis.candidates.rank import enumerate_consistent
from meshforge.synthesis.search.smallest import Hit
from meshforge.synthesis.search.terms import Term

WEIGHTS: dict[str, ModuleType] = {
    "NODE": belief,
    "ALL": bases,
    "UPRIGHT": geo,
    "SIDEWAYS": geo,
    "SELF": attach,
    "UNTRIED": belief,
    "UNNEEDED": belief,
    "IDLE": belief,
    "STRANGE": belief,
}
"""The modules that they stand in."""
FITTED, JUDGED = range(3), range(3, 5)
COUNTS = (1, 2, 3)
_BOUNDS = (-9.0, 9.0)  # a weight that nothing speaks against would grow without end
_BINS = (0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 0.99, 1.0)


@dataclass(frozen=True, slots=True)
class Rule:
    """The readings of a rule that has several, and which of them is right; features: (readings, weights)."""

    terms: tuple[Term, ...]
    features: Floats
    right: int

    def shares(self, weights: Floats) -> Floats:
        """The belief in each reading."""
        nats = self.features @ weights
        weighed = np.exp(nats.min() - nats)
        shares: Floats = weighed / weighed.sum()
        return shares


def measure(tell: Tell, quick: bool) -> Result:
    """Fit on the rules of some families, judge on others, and hold the weights in use against it."""
    only = {"only": ("lamp",)} if quick else {}
    sets = []
    for seeds in (FITTED[:1], JUDGED[:1]) if quick else (FITTED, JUDGED):
        drawn = (case for count in COUNTS for case in cases(seeds, count, **only))
        shown = task_cases(seeds, COUNTS[:2], QUICK if quick else None)
        sets.append([rule for case in chain(drawn, shown) if (rule := _rule(case))])
        tell(f"calibrate: {len(sets[-1])} rules with several readings")
    fitting, judging = sets
    used = np.array([float(getattr(module, name)) for name, module in WEIGHTS.items()])
    fitted, by_size = _fit(fitting), _fit(fitting, [0])
    choices = {"size only": by_size, "fitted": fitted, "in use": used}
    return Result(
        "calibrate",
        "Beliefs, fitted anew",
        (
            Table(
                "Weights, nats",
                ("", "in use", "fitted"),
                tuple(zip(WEIGHTS, used.tolist(), fitted.tolist(), strict=True)),
            ),
            Table(
                "How well they do",
                ("weights", "surprise, fitted", "surprise, judged", "most believed right, %", "taken right, %"),
                tuple(_judge(name, weights, fitting, judging) for name, weights in choices.items()),
            ),
            _reliability("Beliefs in use, judged: every reading", judging, used),
        ),
        notes=(
            f"Fitted on {len(fitting)} rules with several readings one of which is right, judged on {len(judging)} of "
            "other seeds: families of boxes, shown blindly, and the tasks of the benchmark on its calibration set, as "
            "its demonstrators show them. *Surprise*: mean nats of the right reading.",
            "UNTRIED is set higher than it is fitted: a person shows what is wanted on a mesh that has it.",
        ),
    )


def _rule(case: Case) -> Rule | None:
    """What the weights multiply, None where there is nothing to choose or none is right."""
    search = case.search()
    found = search.run()
    assert isinstance(found, Hit)
    terms = enumerate_consistent(search, found.extractor, search.options.above).terms
    truth = search.field.bits(case.hidden)
    right = next((k for k, term in enumerate(terms) if term.bits == truth), None)
    if right is None or len(terms) == 1:
        return None
    facts = measure_evidence(search.field, search.selections, [term.bits for term in terms])
    shown = (1 << search.width) - 1
    idle = [count_idle(term, shown, search.field) for term in terms]

    def column(name: str) -> Floats:
        with ExitStack() as patches:
            for other, module in WEIGHTS.items():
                patches.enter_context(patch.object(module, other, float(other == name)))
            shares = belief.compute_beliefs(terms, facts, shown, len(case.rest()), None, idle)
        nats: Floats = -np.log(np.array(shares))
        return nats

    features = np.stack([column(name) for name in WEIGHTS], axis=1)
    return Rule(terms, features, right)


def _surprise(weights: Floats, rules: Sequence[Rule]) -> float:
    """The mean nats of the right reading."""
    return float(np.mean([-np.log(max(rule.shares(weights)[rule.right], 1e-300)) for rule in rules]))


def _fit(rules: Sequence[Rule], columns: Sequence[int] | None = None) -> Floats:
    """The most likely weights; columns: of which weights, all others staying 0."""
    free = list(range(len(WEIGHTS)) if columns is None else columns)

    def whole(some: Floats) -> Floats:
        weights = np.zeros(len(WEIGHTS))
        weights[free] = some
        return weights

    def surprise(some: Floats) -> float:
        return _surprise(whole(some), rules)

    return whole(minimize(surprise, np.ones(len(free)), method="L-BFGS-B", bounds=[_BOUNDS] * len(free)).x)


def _judge(name: str, weights: Floats, fitting: Sequence[Rule], judging: Sequence[Rule]) -> tuple[Cell, ...]:
    believed = [int(rule.shares(weights).argmax()) == rule.right for rule in judging]
    taken = [belief.choose_candidate(rule.terms, rule.shares(weights).tolist()) == rule.right for rule in judging]
    return (name, _surprise(weights, fitting), _surprise(weights, judging), percent(believed), percent(taken))


def _reliability(title: str, rules: Sequence[Rule], weights: Floats) -> Table:
    """Of the readings believed so much, how many are right."""
    shares = np.concatenate([rule.shares(weights) for rule in rules])
    right = np.concatenate([np.arange(len(rule.terms)) == rule.right for rule in rules])
    return Table(
        title, ("belief, from", "to", "candidates", "believed, mean", "right, share"), tuple(_bins(shares, right))
    )


def _bins(shares: Floats, right: Floats) -> Iterator[tuple[Cell, ...]]:
    for low, high in pairwise(_BINS):
        here = (shares >= low) & ((shares < high) | (high == 1.0))
        if here.any():
            yield (low, high, int(here.sum()), float(shares[here].mean()), float(right[here].mean()))
