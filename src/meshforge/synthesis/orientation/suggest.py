"""Looks for the orientation under which every rule has an extractor, and the extractors are smallest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from meshforge.common import pluralize
from meshforge.language import All, BaseExtractor, LandmarkPair, Orient, Program, Template, show_label
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.demonstration import Demonstration, RuleSpec
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.orientation.attempts import OrientationSearch
from meshforge.synthesis.orientation.directives import Directives

MIN_SAVING = 3
"""Nodes that another frame must save where the present one will do: an orientation costs the reader a line."""

MAX_EXTENDED = 4
"""How many of the pairs that come farthest a second one is added to: the others are no nearer to a common frame."""

OrientationFit = tuple[Orient, tuple[int, ...]]
"""A directive, and the nodes of each rule's smallest extractor in its frame."""

_STEPS = (5, 9)
"""Sizes up to which all frames are searched before one is searched further: a good frame shows early."""


@dataclass(frozen=True, slots=True)
class OrientationSuggestion:
    """An orientation that makes the demonstrations consistent, or the program clearly smaller.

    sizes: nodes of each rule's smallest extractor in that frame; why: one sentence for the user.
    """

    orient: Orient
    sizes: tuple[int, ...]
    why: str


def suggest_orientation(
    demos: Sequence[Demonstration],
    rules: Sequence[RuleSpec],
    frame: Program,
    templates: Mapping[str, Template],
    options: Options,
    budget: TimeBudget,
    sizes: Sequence[int] | None,
    batch: Sequence[SymbolicMesh] = (),
) -> OrientationSuggestion | None:
    """The directive under which the extractors of all rules have the fewest nodes, if it is clearly better than now.

    frame: the program without its rules; sizes: what learning found in the present frame, None where some rule has
    no extractor. A pair that is given is kept where a second one, or `snap`, is enough. Raises OutOfTime.
    """
    limit = len(rules) * options.max_size if sizes is None else sum(sizes) - MIN_SAVING
    if "G" not in options.layers:
        return None
    search = OrientationSearch(demos, rules, frame, templates, options, budget, sizes)
    if limit < sum(search.floors):
        return None
    trials = Trials(search, options.max_size)
    directives = Directives([demo.mesh for demo in demos], batch, frame.labels)
    best = _vary(trials, directives, frame.orient, limit) if frame.orient else None
    if not best and not (frame.orient and len(frame.orient.pairs) == 2):
        best = _search_all(trials, directives, limit)
    return OrientationSuggestion(*best, _explain(*best, sizes)) if best else None


def _vary(trials: Trials, directives: Directives, given: Orient, limit: int) -> OrientationFit | None:
    """The best directive that keeps the pairs that are given."""
    toggled = replace(given, snap=not given.snap)
    return trials.best([toggled, *(directives.with_two_pairs(given.pairs) if len(given.pairs) == 1 else [])], limit)


def _search_all(trials: Trials, directives: Directives, limit: int) -> OrientationFit | None:
    """The best directive of all: of one pair, or of two where that saves further."""
    ones = directives.with_one_pair()
    one = trials.best_of_small(ones, limit)
    if one and trials.is_optimal(one):
        return one
    return trials.best([*ones, *directives.with_two_pairs(trials.farthest_pairs(ones, MAX_EXTENDED))], limit)


def _explain(orient: Orient, found: Sequence[int], before: Sequence[int] | None) -> str:
    """`in the frame where +Z points from the leg hulls to the panel hulls, every rule has an extractor, of ...`."""
    nearly = "of quarter turns where, as nearly as can be," if orient.snap else "where"
    frame = " and ".join(map(_describe_pair, orient.pairs))
    fewer = f", {pluralize(sum(before) - sum(found), 'node')} fewer in all than now" if before else ""
    rules = "the rule" if len(found) == 1 else "every rule"
    return f"in the frame {nearly} {frame}, {rules} has an extractor, of {_describe_sizes(found)}{fewer}"


def _describe_pair(pair: LandmarkPair) -> str:
    return f"{pair.axis} points from {_describe_base(pair.start)} to {_describe_base(pair.end)}"


def _describe_base(base: BaseExtractor) -> str:
    return "the middle of all hulls" if isinstance(base, All) else f"the {show_label(base.label)} hulls"


def _describe_sizes(sizes: Sequence[int]) -> str:
    """`1 node`, `1, 2 and 4 nodes`."""
    *others, last = sizes
    return f"{', '.join(map(str, others))} and {last} nodes" if others else pluralize(last, "node")


class Trials:
    """What became of the directives that were tried; most: nodes that an extractor may have."""

    def __init__(self, search: OrientationSearch, most: int) -> None:
        self._search = search
        self._steps = sorted({min(step, most) for step in (*_STEPS, most)})

    def best(self, orients: Sequence[Orient], limit: int) -> OrientationFit | None:
        """The directive with the fewest nodes in all, at most `limit`; of equals the first. Raises OutOfTime."""
        return self._best(orients, limit, self._steps)

    def best_of_small(self, orients: Sequence[Orient], limit: int) -> OrientationFit | None:
        """The directive with the fewest nodes, where every extractor is small. Raises OutOfTime."""
        return self._best(orients, limit, self._steps[:1])

    def _best(self, orients: Sequence[Orient], limit: int, steps: Sequence[int]) -> OrientationFit | None:
        found: dict[tuple[int, int], OrientationFit] = {}
        for most in steps:
            for place, orient in enumerate(orients):
                if found:
                    total, first = min(found)
                    limit = total - (place > first)
                attempt = self._search.attempt(orient) if limit >= sum(self._search.floors) else None
                if attempt and attempt.learn(limit, most):
                    found[sum(attempt.sizes), place] = orient, tuple(attempt.sizes)
        return found[min(found)] if found else None

    def is_optimal(self, fit: OrientationFit) -> bool:
        """Whether no directive can need fewer nodes."""
        return sum(fit[1]) <= sum(self._search.floors)

    def farthest_pairs(self, orients: Sequence[Orient], count: int) -> list[LandmarkPair]:
        """The pairs of the directives that came farthest, of equals the first."""
        tried = [(orient, attempt) for orient in orients if (attempt := self._search.attempt(orient))]
        tried.sort(key=lambda row: (-len(row[1].sizes), row[1].strays))
        return list(dict.fromkeys(orient.pairs[0] for orient, _ in tried))[:count]
