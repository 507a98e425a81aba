"""Looks for the orientation under which every rule has an extractor, and the extractors are smallest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from meshforge.language import All, Base, LandmarkPair, Orient, Program, Template, show_label
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.agreement import Agreed
from meshforge.synthesis.demonstration import Demonstration
from meshforge.synthesis.frames.directives import Directives
from meshforge.synthesis.frames.lesson import Lesson
from meshforge.synthesis.frames.trials import Fit, Trials
from meshforge.synthesis.options import Options
from meshforge.synthesis.watch import Watch
from meshforge.words import counted

SAVES = 3
"""Nodes that another frame must save where the present one will do: an orientation costs the reader a line."""

EXTENDED = 4
"""How many of the pairs that come farthest a second one is added to: the others are no nearer to a common frame."""


@dataclass(frozen=True, slots=True)
class Suggested:
    """An orientation that makes the demonstrations consistent, or the program clearly smaller.

    sizes: nodes of each rule's smallest extractor in that frame; why: one sentence for the user.
    """

    orient: Orient
    sizes: tuple[int, ...]
    why: str


def suggest_orientation(
    demos: Sequence[Demonstration],
    rules: Sequence[Agreed],
    frame: Program,
    templates: Mapping[str, Template],
    options: Options,
    watch: Watch,
    sizes: Sequence[int] | None,
    batch: Sequence[SymbolicMesh] = (),
) -> Suggested | None:
    """The directive under which the extractors of all rules have the fewest nodes, if it is clearly better than now.

    frame: the program without its rules; sizes: what learning found in the present frame, None where some rule has
    no extractor. A pair that is given is kept where a second one, or `snap`, is enough. Raises OutOfTime.
    """
    limit = len(rules) * options.max_size if sizes is None else sum(sizes) - SAVES
    if "G" not in options.layers:
        return None
    lesson = Lesson(demos, rules, frame, templates, options, watch, sizes)
    if limit < sum(lesson.floors):
        return None
    trials = Trials(lesson, options.max_size)
    directives = Directives([demo.mesh for demo in demos], batch, frame.labels)
    best = _varied(trials, directives, frame.orient, limit) if frame.orient else None
    if not best and not (frame.orient and len(frame.orient.pairs) == 2):
        best = _fresh(trials, directives, limit)
    return Suggested(*best, _why(*best, sizes)) if best else None


def _varied(trials: Trials, directives: Directives, given: Orient, limit: int) -> Fit | None:
    """The best directive that keeps the pairs that are given."""
    toggled = replace(given, snap=not given.snap)
    return trials.best([toggled, *(directives.with_two_pairs(given.pairs) if len(given.pairs) == 1 else [])], limit)


def _fresh(trials: Trials, directives: Directives, limit: int) -> Fit | None:
    """The best directive of all: of one pair, or of two where that saves further."""
    ones = directives.with_one_pair()
    one = trials.best_of_small(ones, limit)
    if one and trials.is_optimal(one):
        return one
    return trials.best([*ones, *directives.with_two_pairs(trials.farthest_pairs(ones, EXTENDED))], limit)


def _why(orient: Orient, found: Sequence[int], before: Sequence[int] | None) -> str:
    """`in the frame where +Z points from the leg hulls to the panel hulls, every rule has an extractor, of ...`."""
    nearly = "of quarter turns where, as nearly as can be," if orient.snap else "where"
    frame = " and ".join(map(_pointing, orient.pairs))
    fewer = f", {counted(sum(before) - sum(found), 'node')} fewer in all than now" if before else ""
    rules = "the rule" if len(found) == 1 else "every rule"
    return f"in the frame {nearly} {frame}, {rules} has an extractor, of {_nodes(found)}{fewer}"


def _pointing(pair: LandmarkPair) -> str:
    return f"{pair.axis} points from {_hulls(pair.start)} to {_hulls(pair.end)}"


def _hulls(base: Base) -> str:
    return "the middle of all hulls" if isinstance(base, All) else f"the {show_label(base.label)} hulls"


def _nodes(sizes: Sequence[int]) -> str:
    """`1 node`, `1, 2 and 4 nodes`."""
    *others, last = sizes
    return f"{', '.join(map(str, others))} and {last} nodes" if others else counted(last, "node")
